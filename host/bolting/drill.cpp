#include "host/bolting/drill.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real most_bolts = 1e6;
constexpr Real rounding = 1e-9;  // of the number of spacings
constexpr Real grazing = 0.05;   // sine of the least angle between a given direction and the face

/// The nodes of one row or of the rows: first + i·spacing, in [low, high].
struct Nodes {
  Real first = 0, spacing = 1;
  Index count = 0;
  Real operator[](Index i) const { return first + static_cast<Real>(i) * spacing; }
};

Nodes nodes(const std::array<Real, 2>& range, Real anchor, Real spacing) {
  const Real low = std::ceil((range[0] - anchor) / spacing - rounding);
  const Real high = std::floor((range[1] - anchor) / spacing + rounding);
  return {anchor + low * spacing, spacing,
          high < low ? 0 : static_cast<Index>(std::min(high - low + 1, 2 * most_bolts))};
}

/// A grid centred on the range: a node in its middle, or two beside it.
Real centred(const std::array<Real, 2>& range, Real spacing) {
  const Real middle = 0.5 * (range[0] + range[1]);
  // A range that is a whole multiple of the spacing is one, whatever its last digit says.
  const Real count = std::max(Real{1}, std::floor((range[1] - range[0]) / spacing + rounding));
  return std::fmod(count, 2) == 1 ? middle : middle + spacing / 2;
}

bool wanted(const BoltPattern& pattern, const Vec3& into_rock) {
  const Real level = std::hypot(into_rock[0], into_rock[1]);
  const Real rise = std::atan2(into_rock[2], level) * 180 / std::numbers::pi;
  constexpr Real slack = 1e-6;  // deg
  return rise >= pattern.inclination[0] - slack && rise <= pattern.inclination[1] + slack;
}

void check_count(const WallPanel& panel, const BoltPattern& pattern) {
  const Real count = (panel.u[1] - panel.u[0]) / pattern.spacing[0] *
                     ((panel.v[1] - panel.v[0]) / pattern.spacing[1]);
  if (count > most_bolts)
    refuse(pattern.place, pattern.place.key + ".spacing",
           fmt::format("would lay {:.2g} bolts on {}: at most a million are drilled; a larger "
                       "spacing would be right",
                       count, panel.name));
}

}  // namespace

std::vector<Bolt> pattern_collars(const Wall& wall, const BlockArrays& blocks,
                                  const BoltPattern& pattern) {
  std::vector<Bolt> bolts;
  for (const WallPanel& panel : wall.panels()) {
    check_count(panel, pattern);
    const Real u0 = (panel.around ? 0 : centred(panel.u, pattern.spacing[0])) + pattern.offset[0];
    const Real v0 = (panel.around ? panel.v[0] + pattern.spacing[1] / 2
                                  : centred(panel.v, pattern.spacing[1])) +
                    pattern.offset[1];
    const Nodes rows = nodes(panel.v, v0, pattern.spacing[1]);
    for (Index j = 0; j < rows.count; ++j) {
      const bool moved = pattern.staggered && j % 2 == 1;
      // Round an axis both ends of the sheet are one line.
      const std::array<Real, 2> u{panel.u[0], panel.u[1] - (panel.around ? 1e-6 * panel.u[1] : 0)};
      const Nodes row = nodes(u, u0 + (moved ? pattern.spacing[0] / 2 : 0), pattern.spacing[0]);
      for (Index i = 0; i < row.count; ++i) {
        const auto hit = wall.at(panel, row[i], rows[j]);
        if (!hit) continue;
        const Vec3 into_rock = Vec3{} - blocks.face_normal[hit->face];
        const Vec3 direction = pattern.direction.value_or(into_rock);
        if (!wanted(pattern, into_rock) || dot(direction, into_rock) < grazing) continue;
        bolts.push_back({none,
                         static_cast<Index>(bolts.size()) + 1,
                         hit->point,
                         direction,
                         pattern.length,
                         {row[i], rows[j]},
                         {}});
      }
    }
  }
  return bolts;
}

std::vector<Wall> walls_of(const BlockArrays& blocks, const Model& model,
                           const BoltPattern& pattern) {
  std::vector<Wall> walls;
  for (const WallFaces& faces : pattern.on) walls.emplace_back(blocks, model, faces, pattern.place);
  return walls;
}

std::vector<Bolt> pattern_collars(const std::vector<Wall>& walls, const BlockArrays& blocks,
                                  const BoltPattern& pattern) {
  std::vector<Bolt> all;
  for (const Wall& wall : walls) {
    const auto bolts = pattern_collars(wall, blocks, pattern);
    all.insert(all.end(), bolts.begin(), bolts.end());
  }
  for (std::size_t i = 0; i < all.size(); ++i) all[i].number = static_cast<Index>(i) + 1;
  return all;
}

void drill(const RockLines& lines, std::vector<Bolt>& bolts) {
  parallel_for(static_cast<std::int64_t>(bolts.size()), 64, [&](std::int64_t i) {
    Bolt& bolt = bolts[static_cast<std::size_t>(i)];
    bolt.rock = lines.along(bolt.collar, bolt.direction, bolt.length);
  });
}

namespace {

void drill_pattern(const BlockArrays& blocks, const Model& model, const BoltPattern& pattern,
                   DrilledBolts& drilled) {
  const std::vector<Wall> walls = walls_of(blocks, model, pattern);
  auto bolts = pattern_collars(walls, blocks, pattern);
  std::string names;
  Real area = 0;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    names += (w == 0 ? "" : ", ") + pattern.on[w].name;
    area += walls[w].area();
  }
  if (bolts.empty())
    refuse(pattern.place, pattern.place.key,
           "lays no bolt on \"" + names +
               "\": inclination or direction leave out all of its faces, or its spacing and offset "
               "miss them");
  for (Bolt& bolt : bolts) bolt.group = static_cast<Index>(drilled.groups.size());
  drilled.groups.push_back({pattern.name, pattern.type, true, std::move(names),
                            static_cast<Index>(bolts.size()), area, pattern.install});
  drilled.bolts.insert(drilled.bolts.end(), bolts.begin(), bolts.end());
}

}  // namespace

DrilledBolts drill_model(const BlockArrays& blocks, const Model& model) {
  DrilledBolts drilled;
  for (const SpotBolt& bolt : model.bolts) {
    drilled.bolts.push_back({static_cast<Index>(drilled.groups.size()),
                             1,
                             bolt.collar,
                             bolt.direction,
                             bolt.length,
                             {},
                             {}});
    drilled.groups.push_back({bolt.name, bolt.type, false, "", 1, 0, bolt.install});
  }
  for (const BoltPattern& pattern : model.bolt_patterns)
    drill_pattern(blocks, model, pattern, drilled);
  const Vec3 down = norm(model.gravity) > 0 ? model.gravity : Vec3{0, 0, -1};
  drill(RockLines(blocks, down), drilled.bolts);
  return drilled;
}

void require_rock(const Model& model, const DrilledBolts& drilled) {
  for (const Bolt& bolt : drilled.bolts) {
    if (!bolt.rock.empty() || drilled.groups[bolt.group].is_pattern) continue;
    const auto& spot = model.bolts[bolt.group];
    refuse(spot.place, spot.place.key + ".collar",
           "the bolt meets no rock from here over its length");
  }
}

}  // namespace rockfold
