#include "host/cover/points/joint_water.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "host/cover/points/loads.hpp"
#include "host/cover/points/locate.hpp"
#include "host/cover/points/surface_split.hpp"
#include "host/cover/points/triangle_rule.hpp"
#include "host/keyblock/water/water.hpp"
#include "host/keyblock/water/wet_faces.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

/// Which face of a block an area of the complex lies on.
class FacesOfBlocks {
 public:
  explicit FacesOfBlocks(const BlockArrays& blocks) : blocks_(blocks) {
    for (Index b = 0; b < blocks.block_count(); ++b)
      for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
        faces_[{b, blocks.face_plane[f], blocks.face_up[f]}].push_back(f);
  }

  /// Of several in one plane the one around x; none: the area is not shown.
  Index find(Index block, Index plane, bool up, const Vec3& x) const {
    const auto found = faces_.find({block, plane, up ? 1 : 0});
    if (found == faces_.end()) return none;
    if (found->second.size() == 1) return found->second.front();
    for (const Index f : found->second)
      if (is_around(f, x)) return f;
    return found->second.front();
  }

 private:
  /// By the angle that the loops turn about x, which lies in their plane.
  bool is_around(Index face, const Vec3& x) const {
    const Vec3& n = blocks_.face_normal[face];
    Real turn = 0;
    for (const auto& loop : face_loops(blocks_, face))
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 a = loop[i] - x, b = loop[(i + 1) % loop.size()] - x;
        turn += std::atan2(dot(n, cross(a, b)), dot(a, b));
      }
    return turn > 1;  // of 0 and 2 pi
  }

  const BlockArrays& blocks_;
  std::map<std::tuple<Index, Index, int>, std::vector<Index>> faces_;
};

Vec3 middle_of(const std::vector<Vec3>& corner) {
  Vec3 sum{};
  for (const Vec3& x : corner) sum += x;
  return (1 / static_cast<Real>(corner.size())) * sum;
}

std::vector<Vec3> in_place(const Polygon& polygon, const Vec3& centre) {
  std::vector<Vec3> corner;
  for (const Vertex& v : polygon.corner) corner.push_back(v.x + centre);
  return corner;
}

/// What of a convex polygon lies where p is not below `than`; of two that are the same everywhere, nothing where `strictly`.
std::vector<Vec3> part_above(const std::vector<Vec3>& corner, const LinearPressure& p,
                             const LinearPressure& than, bool strictly) {
  std::vector<Real> excess;
  Real most = 0, size = 0;
  for (const Vec3& x : corner) {
    excess.push_back(p.unclipped(x) - than.unclipped(x));
    most = std::max(most, excess.back());
    size = std::max(size, std::abs(p.unclipped(x)));
  }
  constexpr Real rounding = 1e-12;
  if (strictly && most <= rounding * size) return {};
  std::vector<Vec3> part;
  for (std::size_t i = 0; i < corner.size(); ++i) {
    const std::size_t next = (i + 1) % corner.size();
    const Real a = excess[i], b = excess[next];
    if (a >= 0) part.push_back(corner[i]);
    if ((a > 0 && b < 0) || (a < 0 && b > 0))
      part.push_back(corner[i] + a / (a - b) * (corner[next] - corner[i]));
  }
  return part;
}

/// The waters as they stand at a time.
std::vector<Water> waters_at(const std::vector<Water>& waters, Real t) {
  std::vector<Water> now = waters;
  for (Water& water : now) {
    if (water.course.empty()) continue;
    if (auto* head = std::get_if<WaterHead>(&water.level)) head->elevation = water.course.at(t)[0];
    if (auto* pressure = std::get_if<WaterPressure>(&water.level))
      pressure->value = water.course.at(t)[0];
  }
  return now;
}

}  // namespace

JointWater::JointWater(const Cutting& cutting, const Covering& covering, const BlockArrays& blocks,
                       const Model& model)
    : blocks_(blocks), model_(model) {
  const bool everywhere = model.support && model.support->water_pressure > 0;
  if (model.waters.empty() && !everywhere) return;
  const Complex& complex = *cutting.complex;
  for (const std::uint8_t there : complex.block_is_analysed) gone_.push_back(there != 0 ? 0 : 1);
  const FacesOfBlocks faces(blocks);
  SurfaceSplitter splitter(complex, covering);
  const Locator locator(covering);
  const auto is_wet = [&](Index origin) {
    return origin != none && complex.origins[origin].kind == FaceOrigin::Kind::joint &&
           (everywhere || water_of(model.waters, complex.origins[origin].name));
  };
  const auto is_between = [&](const Index(&cell)[2]) {
    return complex.is_analysed(cell[0]) && complex.is_analysed(cell[1]) &&
           complex.cell_block[cell[0]] != complex.cell_block[cell[1]];
  };
  // The smaller face of the two sides, side 0 being below the plane.
  const auto smaller_face = [&](const Index(&block)[2], Index plane, const Vec3& x) {
    const Index lower = faces.find(block[0], plane, true, x),
                upper = faces.find(block[1], plane, false, x);
    if (lower == none || upper == none) return lower == none ? upper : lower;
    const Real a = blocks.face_area[lower], b = blocks.face_area[upper];
    constexpr Real alike = 1e-6;  // then that of the smaller block
    if (std::abs(a - b) > alike * (a + b)) return b < a ? upper : lower;
    return blocks.volume[block[1]] < blocks.volume[block[0]] ? upper : lower;
  };
  for (const Fragment& fragment : complex.fragments) {
    if (!is_wet(fragment.joint) || !is_between(fragment.cell) || complex.touches_sliver(fragment))
      continue;
    const Polygon polygon = complex.polygon_of(fragment);
    const Index block[2] = {complex.cell_block[fragment.cell[0]],
                            complex.cell_block[fragment.cell[1]]};
    const Index face =
        smaller_face(block, polygon.plane, middle_of(in_place(polygon, complex.planes.centre())));
    if (face == none) continue;
    const Vec3 up = complex.planes.normal(polygon.plane);
    for (int side = 0; side < 2; ++side)
      splitter.split(polygon, fragment.cell[side], fragment.face[side],
                     [&](const Holder& holder, const Polygon& part) {
                       add(in_place(part, complex.planes.centre()), side == 0 ? up : -up,
                           block[side], fragment.joint, holder.element, face);
                     });
  }
  // Through slivers, each from its own side.
  for (const Beam& beam : complex.beams) {
    if (beam.narrow || beam.cell[1] == none || !is_wet(beam.joint) || !is_between(beam.cell))
      continue;
    std::vector<Vec3> corner = beam.polygon;
    for (Vec3& x : corner) x += complex.planes.centre();
    const HalfSpaceId inside = complex.cells[beam.cell[0]].faces[beam.face[0]].inside;
    const Index own = complex.cell_block[beam.cell[0]];
    const Index face = faces.find(own, plane_of(inside), !is_above(inside), middle_of(corner));
    const Holder holder = locator.find_firm(middle_of(corner), own);
    if (face == none || !holder.found()) continue;
    const Vec3 up = complex.planes.normal(plane_of(inside));
    add(std::move(corner), is_above(inside) ? -up : up, own, beam.joint, holder.element, face);
  }
}

void JointWater::add(std::vector<Vec3> corner, const Vec3& outward, Index block, Index origin,
                     Index element, Index face) {
  if (corner.size() < 3) return;
  Index side = side_of(block, origin, outward);
  if (side == none) {
    side = static_cast<Index>(sides_.size());
    sides_.push_back(
        {block, origin, outward, 0, water_of(model_.waters, blocks_.origins[origin].name)});
    sides_of_[{block, origin}].push_back(side);
  }
  for (std::size_t k = 1; k + 1 < corner.size(); ++k)
    sides_[side].area += 0.5 * norm(cross(corner[k] - corner[0], corner[k + 1] - corner[0]));
  const auto [number, is_new] = number_of_face_.emplace(face, static_cast<Index>(faces_.size()));
  if (is_new) faces_.push_back(face);
  areas_.push_back({std::move(corner), outward, element, side, number->second});
}

Index JointWater::side_of(Index block, Index origin, const Vec3& outward) const {
  const auto found = sides_of_.find({block, origin});
  if (found == sides_of_.end()) return none;
  for (const Index side : found->second)
    if (dot(sides_[side].outward, outward) > 0) return side;
  return none;
}

bool JointWater::changes_after(Real t) const {
  return std::any_of(model_.waters.begin(), model_.waters.end(), [&](const Water& water) {
    return !water.course.empty() && water.course.time.back() > t;
  });
}

LoadPoints JointWater::at(Real t, const CoverArrays& covers) const {
  LoadPoints loads;
  const std::vector<Water> waters = waters_at(model_.waters, t);
  const auto pressures = water_on_faces(blocks_, model_, waters, gone_, faces_);
  // The pressure is linear on each part, the functions of the elements are of the degree that their tractions take.
  const auto rule = triangle_rule(function_degree(covers) + 1);
  const auto press = [&](const Area& area, const std::vector<Vec3>& part,
                         const LinearPressure& pressure) {
    for (std::size_t k = 1; k + 1 < part.size(); ++k) {
      const Real size = 0.5 * norm(cross(part[k] - part[0], part[k + 1] - part[0]));
      for (const auto& [at, weight] : rule) {
        const Vec3 x = at[0] * part[0] + at[1] * part[k] + at[2] * part[k + 1];
        add_material_point(covers, x, area.element, loads.points);
        loads.force.emplace_back();
        loads.table.push_back(none);
        loads.scale.push_back(1);
        loads.area.push_back(weight * size * area.outward);
        loads.pressure.push_back(pressure.unclipped(x));
        loads.side.push_back(area.side);
      }
    }
  };
  for (const Area& area : areas_) {
    const auto& all = pressures[area.face];
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::vector<Vec3> part = part_above(area.corner, all[i], {}, false);
      for (std::size_t j = 0; j < all.size() && part.size() >= 3; ++j)
        if (j != i) part = part_above(part, all[j], all[i], j < i);
      press(area, part, all[i]);
    }
  }
  return loads;
}

}  // namespace rockfold
