#include "host/keyblock/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <variant>

#include <fmt/format.h>

#include "host/keyblock/motions/pyramid.hpp"
#include "host/keyblock/water/joint_pressure.hpp"
#include "host/keyblock/water/water.hpp"
#include "host/refuse.hpp"
#include "src/base/place_text.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

bool is_member(const RockBody& body, Index block) {
  return std::binary_search(body.members.begin(), body.members.end(), block);
}

/// In-situ normal stress on a plane, compression positive; no tension.
Real normal_stress(const InitialStress& stress, const Vec3& x, const Vec3& n) {
  constexpr Real rounding = 1e-9;
  const std::array<Real, 6> on{-n[0] * n[0],     -n[1] * n[1],     -n[2] * n[2],
                               -2 * n[0] * n[1], -2 * n[1] * n[2], -2 * n[2] * n[0]};
  const Real depth = stress.reference_z - x[2];
  Real sum = 0, size = 0;
  for (std::size_t k = 0; k < 6; ++k) {  // xx yy zz xy yz zx
    sum += on[k] * (stress.at[k] + depth * stress.gradient[k]);
    size += std::abs(stress.at[k]) + std::abs(depth * stress.gradient[k]);
  }
  return sum > rounding * size ? sum : 0;
}

/// Along the normal, on the plane through their middle.
void project_on_mean(const Vec3& normal, std::vector<Vec3>& points) {
  Real mean = 0;
  for (const Vec3& x : points) mean += dot(normal, x) / static_cast<Real>(points.size());
  for (Vec3& x : points) x += (mean - dot(normal, x)) * normal;
}

}  // namespace

Bodies::Bodies(const BlockArrays& blocks, const Model& model, const FaceTractions* tractions)
    : Bodies(blocks, model, model.support.value_or(SupportSpec{}), model.waters, tractions) {}

Bodies::Bodies(const BlockArrays& blocks, const Model& model, const SupportSpec& spec,
               const std::vector<Water>& waters, const FaceTractions* tractions)
    : blocks_(blocks),
      gravity_(model.gravity),
      spec_(spec),
      stress_(model.initial_stress),
      in_situ_(tractions),
      traction_(tractions ? &tractions->after(0) : nullptr),
      interfaces_(blocks),
      mesh_planes_(blocks, model),
      tractions_(blocks, model),
      has_polygons_(has_polygons(blocks)) {
  for (const FaceOrigin& origin : blocks.origins) {
    const FaceNature& n = nature_.emplace_back(nature(origin, model, waters));
    loses_strength_ =
        loses_strength_ || n.residual_friction < n.friction || n.residual_cohesion < n.cohesion;
  }
  for (const PointLoad& load : model.point_loads) {
    const Index block = block_at(blocks, load.point);
    if (block == none)
      refuse(load.place, load.place.key + ".point",
             fmt::format("{} is not in the rock", given_place_text(load.point)));
    forces_.push_back(
        {block, load.point, load.table.empty() ? load.force : load.table.at(time_of_statics)});
  }
  std::stable_sort(forces_.begin(), forces_.end(),
                   [](const auto& a, const auto& b) { return a.block < b.block; });
}

Bodies::FaceNature Bodies::nature(const FaceOrigin& origin, const Model& model,
                                  const std::vector<Water>& waters) const {
  FaceNature nature;
  nature.continues = origin.continues;
  if (origin.kind == FaceOrigin::Kind::solid_face) {
    if (!spec_.joint_faces_only)
      nature.continues |=
          std::any_of(model.fixed.begin(), model.fixed.end(), [&](const Fixed& fixed) {
            const auto* region = std::get_if<FaceRegion>(&fixed.where);
            return region && region->holds(origin);
          });
    return nature;
  }
  nature.water = water_of(waters, origin.name);
  if (origin.joint_material == none) return nature;
  const auto& joint = model.joint_materials[at(origin.joint_material)];
  const auto tangent = [](Real degrees) { return std::tan(degrees * std::numbers::pi / 180); };
  nature.friction = tangent(joint.friction_angle);
  nature.cohesion = joint.cohesion;
  nature.residual_friction = tangent(joint.residual_friction_angle.value_or(joint.friction_angle));
  nature.residual_cohesion = joint.residual_cohesion;
  nature.normal_stiffness = joint.normal_stiffness.value_or(0);
  nature.shear_stiffness = joint.shear_stiffness.value_or(0);
  return nature;
}

RockBody Bodies::body(std::vector<Index> members, const std::vector<Index>& batch) const {
  RockBody body;
  body.members = std::move(members);
  for (const Index block : body.members) {
    const Real mass = blocks_.mass[at(block)];
    body.volume += blocks_.volume[at(block)];
    body.mass += mass;
    body.centroid += mass * blocks_.centroid[at(block)];
    body.finite &= blocks_.finite[at(block)] != 0;
  }
  body.centroid = body.members.size() == 1 ? blocks_.centroid[at(body.members[0])]
                                           : (1 / body.mass) * body.centroid;
  if (!body.finite) return body;
  body.load = body.mass * gravity_ + (body.mass * norm(gravity_)) * spec_.seismic_coefficient;
  add_point_loads(body);
  for (const Index block : body.members) add_block(body, block, batch);
  flatten_meshes(body);
  press_faces(body);
  return body;
}

RockBody Bodies::with_residual_strength(RockBody body) const {
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const FaceNature& nature = nature_[at(blocks_.face_origin[at(body.face_id[f])])];
    body.faces[f].friction = nature.residual_friction;
    body.faces[f].cohesion = nature.residual_cohesion;
  }
  return body;
}

bool Bodies::is_encased(Index block, const std::vector<Index>& batch) const {
  for (Index id = blocks_.face_begin[at(block)]; id < blocks_.face_begin[at(block) + 1]; ++id) {
    const auto neighbours = interfaces_.of_face(id);
    if (std::none_of(neighbours.begin(), neighbours.end(), [&](const FaceInterfaces::Neighbour& c) {
          return batch[at(c.block)] == 0 && c.area > 0;
        }))
      return false;
  }
  return true;
}

void Bodies::add_point_loads(RockBody& body) const {
  for (const Index block : body.members) {
    auto force = std::lower_bound(forces_.begin(), forces_.end(), block,
                                  [](const PointForce& f, Index b) { return f.block < b; });
    for (; force != forces_.end() && force->block == block; ++force) {
      body.load += force->force;
      body.moment += cross(force->point - body.centroid, force->force);
    }
  }
}

/// What presses on the free share of a face.
void Bodies::add_traction(RockBody& body, Index face, Real share) const {
  const FaceLoad load = tractions_.on_face(face);
  body.load += share * load.force;
  body.moment += share * (load.moment - cross(body.centroid, load.force));
}

void Bodies::add_block(RockBody& body, Index block, const std::vector<Index>& batch) const {
  const bool alone = body.members.size() == 1;
  for (Index id = blocks_.face_begin[at(block)]; id < blocks_.face_begin[at(block) + 1]; ++id) {
    const FaceNature& nature = nature_[at(blocks_.face_origin[at(id)])];
    Real contact = 0, internal = 0;
    for (const auto& c : interfaces_.of_face(id)) {
      if (batch[at(c.block)] != 0) continue;
      const bool inside = !alone && is_member(body, c.block);
      (inside ? internal : contact) += c.area;
    }
    const Real area = blocks_.face_area[at(id)] - internal;
    if (area > contact) add_traction(body, id, (area - contact) / blocks_.face_area[at(id)]);
    if (internal > 0 && contact == 0 && area <= 1e-9 * internal) continue;
    body.faces.push_back({.normal = blocks_.face_normal[at(id)],
                          .area = area,
                          .contact_area = contact,
                          .friction = nature.friction,
                          .cohesion = nature.cohesion,
                          .continues = nature.continues});
    body.face_id.push_back(id);
  }
}

/// Facets of a mesh that are one plane have its normal.
void Bodies::flatten_meshes(RockBody& body) const {
  if (!mesh_planes_.any()) return;
  if (body.members.size() == 1) {
    for (std::size_t f = 0; f < body.faces.size(); ++f)
      body.faces[f].normal = mesh_planes_.normal(body.face_id[f]);
    return;
  }
  std::vector<Real> area;
  for (const BlockFace& face : body.faces) area.push_back(face.area);
  const std::vector<Vec3> normals = mesh_planes_.normals(body.face_id, area);
  for (std::size_t f = 0; f < body.faces.size(); ++f) body.faces[f].normal = normals[f];
}

bool Bodies::may_drain(const RockBody& body) const {
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const Water* water = nature_[at(blocks_.face_origin[at(body.face_id[f])])].water;
    if (has_polygons_ && body.faces[f].contact_area > 0 && water && is_drained(*water)) return true;
  }
  return false;
}

/// Water and in-situ stress on all faces in contact.
void Bodies::press_faces(RockBody& body) const {
  const JointOutlines joints = may_drain(body) ? joint_outlines(body) : JointOutlines{};
  std::vector<Pressures> pressures(joints.outline.size());
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    if (!(body.faces[f].contact_area > 0)) continue;
    const Index id = body.face_id[f];
    const Index outline = joints.of_face.empty() ? none : joints.of_face[f];
    const Water* water = nature_[at(blocks_.face_origin[at(id)])].water;
    if (outline == none || !water || !is_drained(*water)) {
      press(body.faces[f], id, {}, body);
      continue;
    }
    Pressures& drained = pressures[at(outline)];
    if (drained.empty()) drained = joint_pressures(*water, gravity_, joints.outline[at(outline)]);
    press(body.faces[f], id, drained, body);
  }
}

std::vector<std::vector<LinearPressure>> Bodies::water_in_joints(const RockBody& body) const {
  const JointOutlines joints = may_drain(body) ? joint_outlines(body) : JointOutlines{};
  std::vector<Pressures> pressures(body.faces.size());
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    if (!(body.faces[f].contact_area > 0)) continue;
    const FaceNature& nature = nature_[at(blocks_.face_origin[at(body.face_id[f])])];
    const Index outline = joints.of_face.empty() ? none : joints.of_face[f];
    if (nature.water && is_drained(*nature.water) && outline != none)
      pressures[f] = joint_pressures(*nature.water, gravity_, joints.outline[at(outline)]);
    else if (const LinearPressure p = undrained(nature); p.at_origin != 0 || p.gradient != Vec3{})
      pressures[f] = {p};
  }
  return pressures;
}

/// Of a solid, upright, all free, with no water before it.
bool Bodies::is_free_side(const RockBody& body, std::size_t f) const {
  const BlockFace& face = body.faces[f];
  const FaceWater water = tractions_.water_before(body.face_id[f]);
  return origin(body.face_id[f]).kind == FaceOrigin::Kind::solid_face && face.contact_area == 0 &&
         std::abs(dot(face.normal, gravity_)) <= direction_tolerance * norm(gravity_) &&
         !water.closed && !water.pond;
}

/// Water goes along a slice of a long slope, not out of its ends.
bool Bodies::is_end_of_slice(const RockBody& body, std::size_t f) const {
  if (!is_free_side(body, f)) return false;
  for (std::size_t g = 0; g < body.faces.size(); ++g)
    if (norm(body.faces[f].normal + body.faces[g].normal) <= direction_tolerance &&
        origin(body.face_id[f]).solid == origin(body.face_id[g]).solid && is_free_side(body, g))
      return true;
  return false;
}

Outlets Bodies::outlets(const RockBody& body) const {
  constexpr Real rounding = 1e-9;  // of areas
  Outlets outlets;
  if (!has_polygons_) return outlets;
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const BlockFace& face = body.faces[f];
    const Real share = 1 - face.contact_area / face.area;
    const FaceWater water = tractions_.water_before(body.face_id[f]);
    if (!(share > rounding) || water.closed || is_end_of_slice(body, f)) continue;
    for (const auto& loop : face_loops(blocks_, body.face_id[f]))
      outlets.add(loop, share, water.pond.value_or(LinearPressure{}));
  }
  return outlets;
}

/// Faces in contact of one origin with one normal, and what of them meets.
void Bodies::add_outlines(const RockBody& body, const std::vector<std::size_t>& faces,
                          const Outlets& outlets, JointOutlines& outlines) const {
  std::vector<std::vector<std::vector<Vec3>>> loops;
  Real size = 0;
  for (const std::size_t f : faces) {
    loops.push_back(face_loops(blocks_, body.face_id[f]));
    for (const auto& loop : loops.back())
      for (const Vec3& x : loop) size = std::max(size, norm(x));
  }
  const Vec3& normal = body.faces[faces[0]].normal;
  const auto flatness = mesh_planes_.flatness(body.face_id[faces[0]]);
  const Real tolerance =
      flatness ? std::tan(*flatness * std::numbers::pi / 180) : straightness_of_planes;
  const FaceOutlines joined = joined_outlines(loops, normal, Outlets::relative_slack * size);
  for (std::size_t k = 0; k < faces.size(); ++k)
    outlines.of_face[faces[k]] = static_cast<Index>(outlines.outline.size()) + joined.of_face[k];
  for (const auto& outline : joined.outline)
    outlines.outline.push_back(joint_outline(outlets, outline, normal, tolerance));
}

JointOutlines Bodies::joint_outlines(const RockBody& body) const {
  JointOutlines outlines{std::vector<Index>(body.faces.size(), none), {}};
  if (!has_polygons_) return outlines;
  const Outlets outlets = this->outlets(body);
  std::vector<bool> taken(body.faces.size(), false);
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    if (taken[f] || !(body.faces[f].contact_area > 0)) continue;
    std::vector<std::size_t> faces;
    for (std::size_t g = f; g < body.faces.size(); ++g)
      if (!taken[g] && body.faces[g].contact_area > 0 &&
          &origin(body.face_id[f]) == &origin(body.face_id[g]) &&
          norm(body.faces[f].normal - body.faces[g].normal) <= direction_tolerance) {
        taken[g] = true;
        faces.push_back(g);
      }
    add_outlines(body, faces, outlets, outlines);
  }
  return outlines;
}

/// Water and in-situ stress on the part in contact.
void Bodies::press(BlockFace& face, Index id, const Pressures& drained, RockBody& body) const {
  const FaceNature& nature = nature_[at(blocks_.face_origin[at(id)])];
  if (!nature.water && spec_.water_pressure == 0 && !stress_.any) return;
  press_by_water(face, id, nature, drained, body);
  if (stress_.any && has_polygons_) press_in_situ(face, id, nature);
}

/// Tension is none.
void Bodies::press_in_situ(BlockFace& face, Index id, const FaceNature& nature) const {
  face.clamping_holds = spec_.clamping;
  face.normal_stiffness = nature.normal_stiffness;
  face.shear_stiffness = nature.shear_stiffness;
  if (!traction_) {
    face.clamping =
        face.contact_area * normal_stress(stress_, face_centre(blocks_, id), face.normal);
    return;
  }
  const Vec3 traction = face.contact_area * (*traction_)[at(id)];
  face.clamping = std::max(0.0, -dot(traction, face.normal));
  if (face.clamping > 0) face.in_situ_shear = traction + face.clamping * face.normal;
}

/// Of water that no edge drains.
LinearPressure Bodies::undrained(const FaceNature& nature) const {
  if (nature.water) return linear_pressure(*nature.water, gravity_);
  return {.at_origin = spec_.water_pressure, .gradient = {}};
}

/// On all of a face.
PressureForce Bodies::water_on(Index face, const FaceNature& nature,
                               const Pressures& drained) const {
  if (!drained.empty())
    return least_pressure_force(face_loops(blocks_, face), blocks_.face_normal[at(face)], drained);
  const LinearPressure p = undrained(nature);
  if (p.at_origin == 0 && p.gradient == Vec3{}) return {};
  if (!has_polygons_) return {.force = blocks_.face_area[at(face)] * p.at_origin};
  return pressure_force(blocks_, face, p);
}

void Bodies::press_by_water(BlockFace& face, Index id, const FaceNature& nature,
                            const Pressures& drained, RockBody& body) const {
  const PressureForce push = water_on(id, nature, drained);
  const Real share = std::min(1.0, face.contact_area / blocks_.face_area[at(id)]);
  const Vec3& normal = blocks_.face_normal[at(id)];
  face.water = (share * push.force) * normal;
  if (!has_polygons_) return;
  const Vec3 arm = push.first_moment - push.force * body.centroid;
  body.moment -= share * cross(arm, normal);
}

/// Whether two faces are one plane for a turn: of one plane of the cutting, or of one plane of a mesh.
bool Bodies::is_one_plane(const RockBody& body, std::size_t f, std::size_t g) const {
  const auto plane = [&](std::size_t i) { return blocks_.face_plane[at(body.face_id[i])]; };
  const auto origin = [&](std::size_t i) { return blocks_.face_origin[at(body.face_id[i])]; };
  const Vec3 &n = body.faces[f].normal, &m = body.faces[g].normal;
  return (plane(f) == plane(g) && dot(n, m) > 0) ||
         (n == m && origin(f) == origin(g) && mesh_planes_.flatness(body.face_id[f]));
}

std::vector<ContactPatch> Bodies::patches(const RockBody& body,
                                          const std::vector<Index>& batch) const {
  std::vector<ContactPatch> patches;
  std::vector<std::vector<Vec3>> points;
  for (std::size_t f = 0; f < body.faces.size(); ++f) {
    const BlockFace& face = body.faces[f];
    if (!(face.contact_area > 0) || std::abs(norm(face.normal) - 1) > 1e-6) continue;
    const Index id = body.face_id[f];
    std::vector<Vec3> corners;
    if (face.contact_area >= (1 - 1e-9) * blocks_.face_area[at(id)]) {
      corners = outer_loop(blocks_, id);
    } else {
      for (const auto& c : interfaces_.of_face(id))
        if (batch[at(c.block)] == 0 && !is_member(body, c.block))
          for (const Vec3& x : overlap_points(blocks_, id, c.face)) corners.push_back(x);
    }
    // Faces of one plane are one patch: the block cannot turn about an edge inside it.
    const auto same = std::find_if(patches.begin(), patches.end(), [&](const ContactPatch& p) {
      return is_one_plane(body, at(p.face), f);
    });
    if (same == patches.end()) {
      patches.push_back({face.normal, {}, static_cast<Index>(f), face.friction});
      points.push_back(corners);
    } else {
      auto& all = points[static_cast<std::size_t>(same - patches.begin())];
      all.insert(all.end(), corners.begin(), corners.end());
    }
  }
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (mesh_planes_.flatness(body.face_id[at(patches[p].face)]))
      project_on_mean(patches[p].normal, points[p]);
    patches[p].corners = hull_in_plane(patches[p].normal, points[p]);
  }
  return patches;
}

Mat3 Bodies::inertia(const RockBody& body) const {
  Mat3 sum{};
  for (const Index block : body.members) {
    const Mat3 own = inertia_tensor(blocks_, block);
    const Vec3 arm = blocks_.centroid[at(block)] - body.centroid;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        sum[i][k] +=
            own[i][k] + blocks_.mass[at(block)] * ((i == k ? dot(arm, arm) : 0) - arm[i] * arm[k]);
  }
  return sum;
}

BlockVerdict Bodies::judge(const RockBody& body, const std::vector<Index>& batch) const {
  BlockVerdict verdict;
  if (!body.finite) {
    verdict.block_class = BlockClass::infinite;
    return verdict;
  }
  verdict = judge_block(body.faces, body.load, 0);
  const bool removable =
      verdict.block_class == BlockClass::key || verdict.block_class == BlockClass::stable;
  const bool falls = verdict.movement && verdict.movement->mode == SlidingMode::lifting &&
                     verdict.movement->resisting == 0;  // nothing is less safe
  if (!removable || falls || !looks_at_rotation()) return verdict;
  verdict.patches = patches(body, batch);
  verdict.body = {.centroid = body.centroid,
                  .inertia = inertia(body),
                  .mass = body.mass,
                  .force = verdict.resultant,
                  .moment = body.moment};
  add_rotations(verdict, find_rotations(verdict.patches, verdict.body));
  return verdict;
}

Vec3 Bodies::free_centre(const RockBody& body) const {
  Vec3 sum{};
  Real area = 0;
  if (has_polygons_)
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      const Real open = body.faces[f].area - body.faces[f].contact_area;
      if (open <= 1e-9 * body.faces[f].area) continue;
      sum += open * face_centre(blocks_, body.face_id[f]);
      area += open;
    }
  return area > 0 ? (1 / area) * sum : body.centroid;
}

Index block_at(const BlockArrays& blocks, const Vec3& point) {
  if (!has_polygons(blocks)) return none;
  Index best = none;
  Real largest = 0.05;  // in units of the whole sphere: a corner of a block holds about 1/8
  for (Index b = 0; b < blocks.block_count(); ++b) {
    Vec3 low = blocks.vertex[at(blocks.vertex_begin[at(b)])], high = low;
    for (Index v = blocks.vertex_begin[at(b)]; v < blocks.vertex_begin[at(b) + 1]; ++v)
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], blocks.vertex[at(v)][d]);
        high[d] = std::max(high[d], blocks.vertex[at(v)][d]);
      }
    bool near = true;
    for (std::size_t d = 0; d < 3; ++d) {
      const Real slack = 1e-9 * (norm(high - low) + std::abs(point[d]));
      near &= point[d] >= low[d] - slack && point[d] <= high[d] + slack;
    }
    if (!near) continue;
    const Real winding = winding_number(blocks, b, point);
    if (winding > largest + 1e-6) {
      largest = winding;
      best = b;
    }
  }
  return best;
}

}  // namespace rockfold
