// Two faults that cross, each given as triangles whose corners are rounded, part the rock as the two planes do that they are meant to
// be: the same blocks, which touch each other over the same areas and slide with the same factor of safety.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/flatten/lost_contact.hpp"
#include "host/keyblock/keyblock.hpp"
#include "tests/cut/models/draw.hpp"
#include "tests/cut/models/model_text.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/random/seeded_runs.hpp"
#include "tests/reference/sanitized.hpp"

namespace rockfold::test {
namespace {

// As a file has it: 3 to 17 decimals, or single precision.
struct Rounding {
  int decimals;  // 0 = single precision

  Vec3 operator()(const Vec3& x) const {
    if (decimals == 0) return {Real(float(x[0])), Real(float(x[1])), Real(float(x[2]))};
    return decimals > 12 ? x : to_decimals(x, decimals);
  }
};

// Where the model is made: turned about the vertical, then moved.
struct Frame {
  Real turn = 0;
  Vec3 shift{};

  Vec3 direction(const Vec3& v) const {
    const Real c = std::cos(turn), s = std::sin(turn);
    return {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
  }
  Vec3 point(const Vec3& x) const { return direction(x) + shift; }
};

struct Fault {
  std::string name;
  Vec3 normal, point;  // in the frame's own coordinates
  std::shared_ptr<TriangleSurface> surface = std::make_shared<TriangleSurface>();
  int decimals = 0;
  bool as_mesh = true;
};

struct Crossing {
  std::string kind;
  Frame frame;
  std::array<Fault, 2> fault;
  Real cohesion = 0;
};

constexpr Real reach = 30;  // m, of the meshes: beyond the rock's faces

// The two triangles of a square of a grid, along either diagonal.
void add_square(TriangleSurface& surface, Index a, Index b, Index c, Index d, Draw& draw) {
  if (draw.chance(0.5)) {
    surface.triangles.push_back({a, b, d});
    surface.triangles.push_back({b, c, d});
  } else {
    surface.triangles.push_back({a, b, c});
    surface.triangles.push_back({a, c, d});
  }
}

// Squares whose inner corners are shifted within the plane.
void make_grid(Fault& fault, const Vec3& u, const Vec3& v, Draw& draw) {
  const int n = draw.integer(1, 6), m = draw.integer(1, 6);
  const Real jitter = draw.pick({0.0, 0.3});
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) {
      const Real di = i > 0 && i < n ? jitter * draw.uniform(-1, 1) : 0,
                 dj = j > 0 && j < m ? jitter * draw.uniform(-1, 1) : 0;
      fault.surface->vertices.push_back(fault.point + reach * (2 * (i + di) / n - 1) * u +
                                        reach * (2 * (j + dj) / m - 1) * v);
    }
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i;
      add_square(*fault.surface, a, a + 1, a + n + 2, a + n + 1, draw);
    }
}

// Triangles about one corner in the rock.
void make_fan(Fault& fault, const Vec3& u, const Vec3& v, Draw& draw) {
  const int n = draw.integer(4, 12);
  const Real x = draw.uniform(-8, 8), y = draw.uniform(-8, 8);
  fault.surface->vertices.push_back(fault.point + x * u + y * v);
  for (int i = 0; i < n; ++i) {
    const Real angle = 2 * 3.141592653589793 * i / n;
    fault.surface->vertices.push_back(fault.point + 2 * reach * std::cos(angle) * u +
                                      2 * reach * std::sin(angle) * v);
    fault.surface->triangles.push_back({0, Index(1 + i), Index(1 + (i + 1) % n)});
  }
}

// Rows of squares on both sides of the line in which the faults cross, whose corners both share.
void make_rows(Fault& fault, const std::vector<Vec3>& line, Draw& draw) {
  const Vec3 along = normalized(line.back() - line.front()), up = cross(fault.normal, along);
  const auto length = static_cast<Index>(line.size());
  const int rows = draw.integer(1, 3);
  for (int j = -rows; j <= rows; ++j)
    for (const Vec3& x : line) {
      const Real bump = std::abs(j) > 0 && std::abs(j) < rows ? draw.uniform(-2, 2) : 0;
      fault.surface->vertices.push_back(x + (reach * j / rows + bump) * up);
    }
  for (Index j = 0; j < 2 * rows; ++j)
    for (Index i = 0; i + 1 < length; ++i) {
      const Index a = j * length + i;
      add_square(*fault.surface, a, a + 1, a + length + 1, a + length, draw);
    }
}

std::vector<Vec3> points_of_line(const std::array<Fault, 2>& fault, Draw& draw) {
  const Vec3 along = normalized(cross(fault[0].normal, fault[1].normal));
  std::vector<Real> at{-reach, reach};
  const int inner = draw.integer(0, 8);
  for (int i = 0; i < inner; ++i) at.push_back(draw.uniform(-12, 12));
  std::sort(at.begin(), at.end());
  std::vector<Vec3> line;
  for (const Real s : at) line.push_back(fault[0].point + s * along);
  return line;
}

Vec3 normal_of(Real dip, Real direction) {
  constexpr Real radians = 3.141592653589793 / 180;
  return {std::sin(dip * radians) * std::sin(direction * radians),
          std::sin(dip * radians) * std::cos(direction * radians), std::cos(dip * radians)};
}

Crossing draw_crossing(Draw& draw) {
  Crossing crossing;
  crossing.frame.turn = draw.chance(0.5) ? 0 : draw.uniform(0, 6.28);
  crossing.frame.shift =
      draw.pick({Vec3{}, Vec3{100.1, 200.2, 50.5}, Vec3{412300.5, 4823100.25, 310}});
  crossing.cohesion = draw.pick({0.0, 5e3});
  const bool in_map = crossing.frame.shift[0] > 1e3, shared = draw.chance(0.4);
  crossing.kind = shared ? "shared line" : draw.pick({"grids", "fans"});
  const Real steeper = draw.pick({0.0, draw.uniform(-4, 4)});
  crossing.fault[0] = {"east", normal_of(45 + steeper, 135), {0, 7.5, 10}};
  crossing.fault[1] = {"west", normal_of(45, 225 + steeper), {0, 7.5, 10}};
  const int decimals = draw.pick({0, 3, 4, 6, 9, 12, 17});
  const std::vector<Vec3> line = points_of_line(crossing.fault, draw);
  for (Fault& fault : crossing.fault) {
    // In a plane that is turned about its normal, so that nothing is parallel to the rock.
    const Vec3 u = draw.normal_to(fault.normal), v = cross(fault.normal, u);
    if (shared)
      make_rows(fault, line, draw);
    else if (crossing.kind == "grids")
      make_grid(fault, u, v, draw);
    else
      make_fan(fault, u, v, draw);
    fault.decimals = shared ? decimals : draw.pick({0, 3, 4, 6, 9, 12, 17});
    // Half a metre in map coordinates is no rounding.
    if (in_map && fault.decimals == 0) fault.decimals = 3;
    const Rounding round{fault.decimals};
    for (Vec3& x : fault.surface->vertices) x = round(crossing.frame.point(x));
  }
  if (draw.chance(0.15)) crossing.fault[draw.integer(0, 1)].as_mesh = false;
  return crossing;
}

// A slope of 10 m whose face the line of the two faults daylights in: a wedge of 148 m³ slides.
Model slope(const Crossing& crossing) {
  Model model;
  model.gravity = {0, 0, -9.81};
  model.support.emplace().rotation = false;
  model.materials.resize(1);
  model.materials[0].density = 2700;
  model.joint_materials.resize(1);
  model.joint_materials[0].friction_angle = 30;
  model.joint_materials[0].cohesion = crossing.cohesion;
  const Frame& frame = crossing.frame;
  const auto solid = [&](const char* name, const std::vector<std::pair<Vec3, Vec3>>& planes) {
    std::vector<std::pair<Vec3, Vec3>> turned;
    for (const auto& [normal, point] : planes)
      turned.emplace_back(frame.direction(normal), frame.point(point));
    return convex_solid(name, turned);
  };
  model.solids.push_back(solid("rock", {{{-1, 0, 0}, {-10, 0, 0}},
                                        {{1, 0, 0}, {10, 0, 0}},
                                        {{0, -1, 0}, {0, -5, 0}},
                                        {{0, 1, 0}, {0, 15, 0}},
                                        {{0, 0, -1}, {0, 0, 0}},
                                        {{0, 0, 1}, {0, 0, 10}}}));
  model.solids.back().continues = {true, true, true, true, true, false};
  model.solids.push_back(solid("face", {{-1 * normal_of(65, 180), {0, 0, 10}}}));
  model.solids.back().add = false;
  return model;
}

Model with_planes(const Crossing& crossing) {
  Model model = slope(crossing);
  for (const Fault& fault : crossing.fault) {
    add_joint(model, crossing.frame.direction(fault.normal), crossing.frame.point(fault.point));
    model.joints.back().name = fault.name;
  }
  return model;
}

Model with_meshes(const Crossing& crossing) {
  Model model = slope(crossing);
  for (const Fault& fault : crossing.fault) {
    if (!fault.as_mesh) {
      add_joint(model, crossing.frame.direction(fault.normal), crossing.frame.point(fault.point));
      model.joints.back().name = fault.name;
      continue;
    }
    JointMesh mesh;
    mesh.name = fault.name;
    mesh.surface = fault.surface;
    model.joint_meshes.push_back(mesh);
  }
  return model;
}

// What may differ from the planes: corners are off by 1e-3 m at most, which turns triangles of 10 m by some 1e-4.
constexpr Real tolerance = 1e-2;

// Thin remains between triangles are no blocks of anybody's. m³
constexpr Real least_volume = 1e-3;

std::vector<Index> blocks_of(const BlockArrays& a) {
  std::vector<Index> blocks;
  for (Index b = 0; b < a.block_count(); ++b)
    if (a.volume[b] > least_volume) blocks.push_back(b);
  return blocks;
}

// [blocks] of the model with planes, the one with its centroid nearest to that of each block; none for blocks that do not count.
std::vector<Index> partners(const BlockArrays& mesh, const BlockArrays& plane) {
  std::vector<Index> partner(mesh.block_count(), none);
  for (const Index b : blocks_of(mesh)) {
    const auto apart = [&](Index other) { return norm(plane.centroid[other] - mesh.centroid[b]); };
    for (const Index other : blocks_of(plane))
      if (partner[b] == none || apart(other) < apart(partner[b])) partner[b] = other;
  }
  return partner;
}

// m²: by pair of blocks and joint, the blocks as in the model with planes.
using Contacts = std::map<std::string, Real>;
Contacts contacts(const BlockArrays& a, const std::vector<Index>& partner) {
  Contacts areas;
  for (const auto& shared : a.interfaces) {
    const auto [one, two] = std::minmax(partner[shared.block[0]], partner[shared.block[1]]);
    if (one == none) continue;
    const std::string names[2] = {a.origins[a.face_origin[shared.face[0]]].name,
                                  a.origins[a.face_origin[shared.face[1]]].name};
    areas[fmt::format("blocks {} and {}, {}", one + 1, two + 1,
                      names[0] == names[1] ? names[0] : names[0] + " on " + names[1])] +=
        shared.area;
  }
  return areas;
}

void compare_blocks(const BlockArrays& mesh, const BlockArrays& plane, Faults& faults) {
  const std::vector<Index> partner = partners(mesh, plane);
  for (const Index b : blocks_of(mesh)) {
    const Real expected = plane.volume[partner[b]];
    if (std::abs(mesh.volume[b] - expected) > tolerance * expected)
      faults.push_back(fmt::format("volume: {} instead of {} m3", mesh.volume[b], expected));
  }
  Contacts found = contacts(mesh, partner), expected = contacts(plane, partners(plane, plane));
  for (const auto& [between, area] : found) expected.try_emplace(between, 0);
  for (const auto& [between, area] : expected)
    if (std::abs(found[between] - area) > tolerance * std::max(area, 10.0))
      faults.push_back(
          fmt::format("contact: {}: {} m2 instead of {}", between, found[between], area));
}

std::vector<Keyblock> moving(const BlockArrays& blocks, const Model& model) {
  const KeyblockReport report = find_keyblocks(blocks, model);
  std::vector<Keyblock> list = report.keyblocks;
  list.insert(list.end(), report.stable.begin(), report.stable.end());
  std::erase_if(list, [](const Keyblock& k) { return k.volume < least_volume; });
  std::sort(list.begin(), list.end(),
            [](const Keyblock& a, const Keyblock& b) { return a.volume > b.volume; });
  return list;
}

void compare_key_blocks(const std::vector<Keyblock>& mesh, const std::vector<Keyblock>& plane,
                        Faults& faults) {
  if (mesh.size() != plane.size()) {
    faults.push_back(fmt::format("key blocks: {} instead of {}", mesh.size(), plane.size()));
    return;
  }
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Real found = mesh[i].factor_of_safety, expected = plane[i].factor_of_safety;
    if (!(std::abs(found - expected) <= tolerance * expected))
      faults.push_back(fmt::format("factor: {} instead of {}", found, expected));
    auto names = mesh[i].planes, wanted = plane[i].planes;
    std::sort(names.begin(), names.end()), std::sort(wanted.begin(), wanted.end());
    if (names != wanted) faults.push_back(fmt::format("planes: {}", fmt::join(names, ", ")));
  }
}

// Of the first 10,000 seeds the one where a block shows both sides of a sliver of 3.8 m² too. The program warns of it.
constexpr unsigned shows_a_sliver = 2058;

SeededCase check(unsigned seed) {
  Draw draw(seed);
  const Crossing crossing = draw_crossing(draw);
  const Model meshes = with_meshes(crossing), planes = with_planes(crossing);
  SeededCase result{crossing.kind, {}, [meshes, crossing] {
                      std::string text = to_toml(meshes);
                      for (const Fault& fault : crossing.fault)
                        if (fault.as_mesh) text += surface_text(*fault.surface);
                      return text;
                    }};
  const BlockArrays mesh = cut(meshes).arrays, plane = cut(planes).arrays;
  const std::vector<Index> found = blocks_of(mesh), expected = blocks_of(plane);
  if (found.size() != expected.size()) {
    result.faults.push_back(fmt::format("blocks: {} instead of {}", found.size(), expected.size()));
    return result;
  }
  const auto lost = lost_contact(mesh);
  if (seed == shows_a_sliver && lost.empty()) result.faults.push_back("lost: no warning any more");
  if (seed != shows_a_sliver)
    for (const LostContact& l : lost)
      result.faults.push_back(
          fmt::format("lost: {} of {} m2 on block {}", l.lost, l.area, l.block + 1));
  compare_blocks(mesh, plane, result.faults);
  compare_key_blocks(moving(mesh, meshes), moving(plane, planes), result.faults);
  return result;
}

TEST(CrossingMeshes, ActAsTheirPlanes) {
  check_seeds(0, reference::cases(300u, 20u), check);
}
TEST(SlowCrossingMeshes, ActAsTheirPlanes) {
  check_seeds(from_environment("ROCKFOLD_FIRST_SEED", 1000),
              from_environment("ROCKFOLD_MESH_CASES", 3000), check);
}

}  // namespace
}  // namespace rockfold::test
