#include "host/stability/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <variant>

#include "host/cut/cells/complex.hpp"
#include "host/keyblock/bodies.hpp"
#include "host/keyblock/face_shape.hpp"
#include "host/keyblock/water/joint_pressure.hpp"
#include "host/keyblock/water/wet_faces.hpp"
#include "host/stability/bolt_ties.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Of the model's size: what comes that close to a region touches it.
constexpr Real relative_slack = 1e-9;

bool is_gone(const BlockArrays& blocks, Index block) {
  return blocks.stage[block] > 0;
}

Real size_of(const BlockArrays& blocks) {
  Vec3 low = blocks.vertex.front(), high = low;
  for (const Vec3& x : blocks.vertex)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  return norm(high - low);
}

/// Finds the blocks that regions of [[fixed]] touch.
class Touch {
 public:
  explicit Touch(const BlockArrays& blocks)
      : blocks_(blocks), slack_(relative_slack * size_of(blocks)) {}

  /// Calls visit(block) for each, in ascending order.
  template <class Visit>
  void each(const Region& region, const Visit& visit) const {
    const std::optional<Vec3> point = point_of(region);
    const Index holder = point ? block_at(blocks_, *point) : none;
    for (Index b = 0; b < blocks_.block_count(); ++b)
      if (point ? b == holder : touches(region, b)) visit(b);
  }

 private:
  static std::optional<Vec3> point_of(const Region& region) {
    if (const auto* point = std::get_if<PointRegion>(&region)) return point->point;
    if (const auto* block = std::get_if<BlockRegion>(&region)) return block->point;
    return {};
  }

  bool touches(const Region& region, Index block) const {
    if (const auto* face = std::get_if<FaceRegion>(&region)) return has_face(*face, block);
    if (const auto* plane = std::get_if<PlaneRegion>(&region)) return meets(*plane, block);
    return meets(std::get<BoxRegion>(region), block);
  }

  bool has_face(const FaceRegion& region, Index block) const {
    for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f)
      if (region.holds(blocks_.origins[blocks_.face_origin[f]])) return true;
    return false;
  }

  /// Whether the block has vertices in the slab about the plane, or on both sides of it.
  bool meets(const PlaneRegion& plane, Index block) const {
    const Real reach = std::max(plane.tolerance, slack_);
    bool above = false, below = false;
    for (Index v = blocks_.vertex_begin[block]; v < blocks_.vertex_begin[block + 1]; ++v) {
      const Real distance = dot(plane.normal, blocks_.vertex[v] - plane.point);
      above = above || distance >= -reach;
      below = below || distance <= reach;
    }
    return above && below;
  }

  /// Whether a vertex or a part of a face lies in the box, or the box in the block.
  bool meets(const BoxRegion& box, Index block) const {
    for (Index v = blocks_.vertex_begin[block]; v < blocks_.vertex_begin[block + 1]; ++v)
      if (holds(box, blocks_.vertex[v])) return true;
    const LinearPressure one{.at_origin = 1, .gradient = {}};
    for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f)
      if (pressure_force(blocks_, f, one, &box, slack_).force > slack_ * slack_) return true;
    return winding_number(blocks_, block, 0.5 * (box.min + box.max)) > 0.5;
  }

  bool holds(const BoxRegion& box, const Vec3& x) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (x[d] < box.min[d] - slack_ || x[d] > box.max[d] + slack_) return false;
    return true;
  }

  const BlockArrays& blocks_;
  Real slack_;
};

/// m²; counter-clockwise against the normal.
Real area_of(const std::vector<Vec3>& corner, const Vec3& normal) {
  Real area = 0;
  for (std::size_t k = 2; k < corner.size(); ++k)
    area += 0.5 * dot(normal, cross(corner[k - 1] - corner[0], corner[k] - corner[0]));
  return area;
}

using Corners = std::vector<Vec3>;

/// The hull of polygons that do not overlap, if they fill it.
std::optional<Corners> convex_union(const Vec3& normal, const std::vector<Corners>& polygons) {
  constexpr Real rounding = 1e-9;  // of the area
  Corners all;
  Real area = 0;
  for (const Corners& corner : polygons) {
    area += area_of(corner, normal);
    all.insert(all.end(), corner.begin(), corner.end());
  }
  Corners hull = hull_in_plane(normal, all);
  if (std::abs(area_of(hull, normal) - area) > rounding * area) return {};
  return hull;
}

/// Joins polygon i with the first one behind it that is convex together with it; false where there is none.
bool join_one(const Vec3& normal, std::vector<Corners>& polygons, std::size_t i) {
  for (std::size_t k = i + 1; k < polygons.size(); ++k)
    if (auto both = convex_union(normal, {polygons[i], polygons[k]})) {
      polygons[i] = std::move(*both);
      polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(k));
      return true;
    }
  return false;
}

/// Convex polygons of one plane as fewer ones, each without corners between straight edges: one if they are convex together, else
/// pairs are joined as long as there are any, in O(n²) for n polygons. Polygons without area (to 1e-9 of their size) are left out.
std::vector<Corners> joined(const Vec3& normal, const std::vector<Corners>& polygons) {
  std::vector<Corners> parts;
  for (const Corners& corner : polygons)
    if (Corners hull = hull_in_plane(normal, corner); hull.size() >= 3)
      parts.push_back(std::move(hull));
  if (parts.size() < 2) return parts;
  if (auto whole = convex_union(normal, parts)) return {std::move(*whole)};
  for (bool any = true; any;) {
    any = false;
    for (std::size_t i = 0; i < parts.size(); ++i)
      while (join_one(normal, parts, i)) any = true;
  }
  return parts;
}

/// What two blocks share of one plane of a joint.
struct SharedArea {
  std::array<Index, 2> body{none, none};  ///< as in ContactArea
  Index plane = none;
  Index origin = none;
  bool is_above = false;                   ///< the first body lies above the plane
  std::array<Index, 2> block{none, none};  ///< of the bodies, or of the rock that is held
  auto order() const { return std::tie(body, plane, origin, is_above, block); }
  bool operator<(const SharedArea& other) const { return order() < other.order(); }
};

/// The areas that bodies share, with each other or with rock that is held.
class SharedAreas {
 public:
  /// `body_of` [B]: none = held or gone.
  SharedAreas(const Complex& complex, const BlockArrays& blocks, const std::vector<Index>& body_of)
      : complex_(complex), blocks_(blocks), body_of_(body_of) {
    for (const Fragment& fragment : complex.fragments)
      if (!complex.touches_sliver(fragment)) add(fragment);
    for (const Beam& beam : complex.beams)
      if (!beam.narrow && beam.cell[1] != none) add(beam);
  }

  /// m, the corners of each as the complex has them.
  const std::map<SharedArea, std::vector<Corners>>& polygons() const { return polygons_; }

 private:
  void add(const Fragment& fragment) {
    const Index below = complex_.cell_block[fragment.cell[0]],
                above = complex_.cell_block[fragment.cell[1]];
    if (!is_contact(fragment.joint, below, above)) return;
    const Polygon polygon = complex_.polygon_of(fragment);
    Corners corner;
    for (const Vertex& v : polygon.corner) corner.push_back(v.x);
    add({{}, polygon.plane, fragment.joint, true, {above, below}}, std::move(corner));
  }

  /// Of the two that see the same area from its two sides, that of the block with the lower number, as in BlockArrays.
  void add(const Beam& beam) {
    const Index from = complex_.cell_block[beam.cell[0]], to = complex_.cell_block[beam.cell[1]];
    if (from > to || !is_contact(beam.joint, from, to)) return;
    const HalfSpaceId inside = complex_.cells[beam.cell[0]].faces[beam.face[0]].inside;
    add({{}, plane_of(inside), beam.joint, is_above(inside), {from, to}}, beam.polygon);
  }

  bool is_contact(Index origin, Index one, Index other) const {
    return origin != none && complex_.origins[origin].kind == FaceOrigin::Kind::joint &&
           one != other && !is_gone(blocks_, one) && !is_gone(blocks_, other) &&
           (body_of_[one] != none || body_of_[other] != none);
  }

  /// `corner`: m about the table's centre.
  void add(SharedArea area, Corners corner) {
    for (Vec3& x : corner) x += complex_.planes.centre();
    for (std::size_t i = 0; i < 2; ++i) area.body[i] = body_of_[area.block[i]];
    if (area.body[0] == none || (area.body[1] != none && area.body[1] < area.body[0])) {
      std::swap(area.body[0], area.body[1]);
      std::swap(area.block[0], area.block[1]);
      area.is_above = !area.is_above;
    }
    polygons_[area].push_back(std::move(corner));
  }

  const Complex& complex_;
  const BlockArrays& blocks_;
  const std::vector<Index>& body_of_;
  std::map<SharedArea, std::vector<Corners>> polygons_;
};

/// The strength of a joint; of one without material there is none.
ContactArea contact_of(const FaceOrigin& origin, const Model& model) {
  ContactArea contact;
  contact.joint = origin.name;
  if (origin.joint_material == none) return contact;
  const JointMaterial& material = model.joint_materials[origin.joint_material];
  contact.friction = std::tan(material.friction_angle * std::numbers::pi / 180);
  contact.cohesion = material.cohesion;
  contact.tension = material.tensile_strength;
  return contact;
}

/// How often a face's loops turn about a point of its plane, rad: 0 or 2 π.
Real turn_about(const BlockArrays& blocks, Index face, const Vec3& x) {
  Real turn = 0;
  for (const auto& loop : face_loops(blocks, face))
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 a = loop[i] - x, b = loop[(i + 1) % loop.size()] - x;
      turn += std::atan2(dot(blocks.face_normal[face], cross(a, b)), dot(a, b));
    }
  return turn;
}

/// A block's face on a plane, of several the one around x; `up`: its outward normal is the plane's own. None: the block is not finite,
/// or does not show it.
Index face_around(const BlockArrays& blocks, Index block, Index plane, bool up, const Vec3& x) {
  if (blocks.finite[block] == 0) return none;
  Index first = none;
  for (Index f = blocks.face_begin[block]; f < blocks.face_begin[block + 1]; ++f) {
    if (blocks.face_plane[f] != plane || (blocks.face_up[f] != 0) != up) continue;
    if (turn_about(blocks, f, x) > 1) return f;
    if (first == none) first = f;
  }
  return first;
}

/// Of two faces the smaller one; of two of one area that of the smaller block.
Index smaller_face(const BlockArrays& blocks, const SharedArea& area, const Vec3& x) {
  const Index first = face_around(blocks, area.block[0], area.plane, !area.is_above, x),
              second = face_around(blocks, area.block[1], area.plane, area.is_above, x);
  if (first == none || second == none) return first == none ? second : first;
  const Real a = blocks.face_area[first], b = blocks.face_area[second];
  constexpr Real alike = 1e-6;
  if (std::abs(a - b) > alike * (a + b)) return b < a ? second : first;
  return blocks.volume[area.block[1]] < blocks.volume[area.block[0]] ? second : first;
}

/// Makes the mass.
class RockMass {
 public:
  RockMass(const Cutting& cutting, const BlockArrays& blocks, const Model& model)
      : complex_(*cutting.complex), blocks_(blocks), model_(model) {
    for (Index b = 0; b < blocks.block_count(); ++b) gone_.push_back(is_gone(blocks, b) ? 1 : 0);
  }

  RigidMass run() {
    add_bodies();
    add_contacts();
    press_by_water();
    mass_.ties = bolt_ties(blocks_, model_, body_of_);
    return std::move(mass_);
  }

 private:
  /// With all loads but water: block theory's bodies in a dry model.
  void add_bodies() {
    const std::vector<std::uint8_t> held = held_blocks(blocks_, model_).held;
    SupportSpec spec = model_.support.value_or(SupportSpec{});
    spec.water_pressure = 0;
    const std::vector<Water> dry;
    const Bodies bodies(blocks_, model_, spec, dry);
    body_of_.assign(gone_.size(), none);
    for (Index b = 0; b < blocks_.block_count(); ++b) {
      if (gone_[b] != 0 || held[b] != 0) continue;
      const RockBody body = bodies.body({b}, gone_);
      body_of_[b] = static_cast<Index>(mass_.bodies.size());
      mass_.bodies.push_back({b, body.centroid, body.load, body.moment});
    }
  }

  void add_contacts() {
    const SharedAreas shared(complex_, blocks_, body_of_);
    for (const auto& [area, polygons] : shared.polygons()) {
      ContactArea contact = contact_of(complex_.origins[area.origin], model_);
      contact.body = area.body;
      const Vec3 up = complex_.planes.normal(area.plane);
      contact.normal = area.is_above ? up : -up;
      for (Corners& corner : joined(contact.normal, polygons)) {
        contact.corner = std::move(corner);
        mass_.contacts.push_back(contact);
        shared_.push_back(area);
      }
    }
  }

  void press_by_water() {
    const bool everywhere = model_.support && model_.support->water_pressure > 0;
    if (model_.waters.empty() && !everywhere) return;
    std::vector<Index> face;  // [contacts] whose pressure it has
    for (std::size_t c = 0; c < shared_.size(); ++c) {
      const Corners& corner = mass_.contacts[c].corner;
      Vec3 middle{};
      for (const Vec3& x : corner) middle += (1 / static_cast<Real>(corner.size())) * x;
      face.push_back(smaller_face(blocks_, shared_[c], middle));
    }
    std::vector<Index> wanted = face;
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    std::erase(wanted, none);
    const auto pressures = water_on_faces(blocks_, model_, model_.waters, gone_, wanted);
    for (std::size_t c = 0; c < face.size(); ++c) {
      if (face[c] == none) continue;
      const auto at = std::lower_bound(wanted.begin(), wanted.end(), face[c]) - wanted.begin();
      press(mass_.contacts[c], pressures[static_cast<std::size_t>(at)]);
    }
  }

  /// The two bodies apart, by the least of the pressures.
  void press(const ContactArea& contact, const std::vector<LinearPressure>& pressures) {
    if (pressures.empty()) return;
    const PressureForce push = least_pressure_force({contact.corner}, contact.normal, pressures);
    for (std::size_t i = 0; i < 2; ++i) {
      if (contact.body[i] == none) continue;
      RigidBody6& body = mass_.bodies[contact.body[i]];
      const Vec3 inward = i == 0 ? contact.normal : -contact.normal;
      body.force += push.force * inward;
      body.moment += cross(push.first_moment - push.force * body.centre, inward);
    }
  }

  const Complex& complex_;
  const BlockArrays& blocks_;
  const Model& model_;
  std::vector<Index> gone_;     // [B] 1: excavated
  std::vector<Index> body_of_;  // [B]
  RigidMass mass_;
  std::vector<SharedArea> shared_;  // [contacts]
};

}  // namespace

HeldBlocks held_blocks(const BlockArrays& blocks, const Model& model) {
  HeldBlocks result;
  for (Index b = 0; b < blocks.block_count(); ++b)
    result.held.push_back(!is_gone(blocks, b) && blocks.finite[b] == 0 ? 1 : 0);
  std::vector<std::uint8_t> touched(result.held.size(), 0);
  const Touch touch(blocks);
  for (const Fixed& fixed : model.fixed) {
    const auto held = std::count(fixed.components.begin(), fixed.components.end(), true);
    touch.each(fixed.where, [&](Index b) {
      if (held == 0 || is_gone(blocks, b)) return;
      (held == 3 ? result.held : touched)[b] = 1;
    });
  }
  for (Index b = 0; b < blocks.block_count(); ++b)
    if (touched[b] != 0 && result.held[b] == 0) result.partly_held.push_back(b);
  return result;
}

RigidMass rigid_mass(const Cutting& cutting, const BlockArrays& blocks, const Model& model) {
  return RockMass(cutting, blocks, model).run();
}

}  // namespace rockfold
