#include "host/keyblock/theory/slope_block.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/joints/disc.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// n·x ≤ at, n unit.
struct HalfSpaceSide {
  Vec3 normal;
  Real at;
};

/// Areas of the sides and the volume of the polytope that they bound.
struct Polytope {
  std::vector<Real> area;                  ///< [sides]
  std::vector<std::vector<Vec3>> polygon;  ///< [sides] counter-clockwise seen from outside
  std::vector<Vec3> corners;
  Real volume = 0;
};

/// For a handful of sides: corners by triples, faces by the angle about their middle.
Polytope polytope(std::span<const HalfSpaceSide> sides) {
  Polytope made;
  Real size = 0;
  for (const auto& side : sides) size = std::max(size, std::abs(side.at));
  const Real tolerance = 1e-9 * size;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j)
      for (std::size_t k = j + 1; k < sides.size(); ++k) {
        const Vec3 jk = cross(sides[j].normal, sides[k].normal);
        const Real determinant = dot(sides[i].normal, jk);
        if (std::abs(determinant) <= direction_tolerance) continue;
        const Vec3 x = (1 / determinant) *
                       (sides[i].at * jk + sides[j].at * cross(sides[k].normal, sides[i].normal) +
                        sides[k].at * cross(sides[i].normal, sides[j].normal));
        const Real slack = tolerance + 1e-9 * norm(x);
        const bool inside = std::all_of(sides.begin(), sides.end(), [&](const HalfSpaceSide& s) {
          return dot(s.normal, x) <= s.at + slack;
        });
        const bool known = std::any_of(made.corners.begin(), made.corners.end(),
                                       [&](const Vec3& c) { return norm(c - x) <= slack; });
        if (inside && !known) made.corners.push_back(x);
      }
  for (const auto& side : sides) {
    std::vector<Vec3> on;
    for (const Vec3& c : made.corners)
      if (std::abs(dot(side.normal, c) - side.at) <= 2 * (tolerance + 1e-9 * norm(c)))
        on.push_back(c);
    Real area = 0;
    if (on.size() >= 3) {
      Vec3 middle{};
      for (const Vec3& c : on) middle += (1.0 / static_cast<Real>(on.size())) * c;
      const Vec3 e = normalized(on[0] - middle), f = cross(side.normal, e);
      std::sort(on.begin(), on.end(), [&](const Vec3& a, const Vec3& b) {
        return std::atan2(dot(a - middle, f), dot(a - middle, e)) <
               std::atan2(dot(b - middle, f), dot(b - middle, e));
      });
      for (std::size_t c = 1; c + 1 < on.size(); ++c)
        area += 0.5 * dot(side.normal, cross(on[c] - on[0], on[c + 1] - on[0]));
    }
    made.area.push_back(area);
    made.polygon.push_back(on);
    made.volume += area * (side.at - dot(side.normal, made.corners.front())) / 3;
  }
  return made;
}

/// `toe`: the point of the polytope that becomes the origin.
TheoryShape shape_of(const Polytope& block, std::span<const Vec3> normals, const Vec3& toe,
                     Real scale) {
  const std::size_t joints = normals.size();
  TheoryShape shape;
  shape.volume = scale * scale * scale * block.volume;
  Outlets outlets;
  std::vector<std::vector<Vec3>> polygons = block.polygon;
  for (auto& polygon : polygons)
    for (Vec3& x : polygon) x = scale * (x - toe);
  for (std::size_t i = joints; i < polygons.size(); ++i) {
    shape.free_area += scale * scale * block.area[i];
    outlets.add(polygons[i], 1, {});
  }
  for (std::size_t i = 0; i < joints; ++i) {
    shape.joint_area.push_back(scale * scale * block.area[i]);
    shape.joint_outline.push_back(
        joint_outline(outlets, polygons[i], normals[i], straightness_of_planes));
  }
  return shape;
}

std::vector<HalfSpaceSide> joint_sides(std::span<const Vec3> normals, Real at) {
  std::vector<HalfSpaceSide> sides;
  for (const Vec3& n : normals) sides.push_back({n, at});
  return sides;
}

}  // namespace

SlopeFrame slope_frame(const TheorySlope& slope, Real dip_direction) {
  const Real turn = dip_direction - slope.face.dip_direction;
  const auto normal = [](Real dip, Real direction) {
    const Real turned = direction - 360 * std::floor(direction / 360);
    return plane_frame(DipOrientation{dip, turned}).normal;
  };
  return {normal(slope.face.dip, slope.face.dip_direction + turn),
          normal(slope.upper.dip, slope.upper.dip_direction + turn), slope.height};
}

std::vector<Vec3> excavation_normals(const SlopeFrame& slope) {
  return {slope.face, slope.upper};
}

std::optional<TheoryShape> largest_block(const SlopeFrame& slope, std::span<const Vec3> normals) {
  if (!is_removable(normals, excavation_normals(slope))) return {};
  // Up the face from the toe to the crest.
  const Vec3 up_face = normalized(Vec3{0, 0, 1} - slope.face[2] * slope.face);
  const Vec3 crest = (slope.height / up_face[2]) * up_face;
  auto sides = joint_sides(normals, 0);
  if (normals.size() == 2) {
    sides.push_back({slope.face, 0});
    sides.push_back({slope.upper, dot(slope.upper, crest)});
    const Polytope wedge = polytope(sides);
    if (wedge.corners.size() < 4 || !(wedge.volume > 0)) return {};
    return shape_of(wedge, normals, {}, 1);
  }
  // The pyramid with its apex at the origin, cut by the face alone at a distance of 1, then scaled.
  if (!is_removable(normals, std::vector<Vec3>{slope.face})) return {};
  sides.push_back({slope.face, 1});
  const Polytope block = polytope(sides);
  if (block.corners.size() < 4 || !(block.volume > 1e-12)) return {};
  std::vector<Vec3> on_face;
  for (const Vec3& c : block.corners)
    if (std::abs(dot(slope.face, c) - 1) <= 1e-9 * (1 + norm(c))) on_face.push_back(c);
  const auto [low, high] = std::minmax_element(
      on_face.begin(), on_face.end(), [](const Vec3& a, const Vec3& b) { return a[2] < b[2]; });
  if (on_face.empty() || !((*high)[2] > (*low)[2])) return {};
  return shape_of(block, normals, *low, slope.height / ((*high)[2] - (*low)[2]));
}

}  // namespace rockfold
