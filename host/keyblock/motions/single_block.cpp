#include "host/keyblock/motions/single_block.hpp"

#include <algorithm>
#include <cmath>

#include "host/keyblock/motions/in_situ.hpp"
#include "host/keyblock/motions/pyramid.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// A block whose resistance and driving force differ by less than this share of |r| is stable:
/// friction equal to the dip is no motion, whatever the last digit says.
constexpr Real equilibrium_tolerance = 1e-9;

/// An uncovered part of a face smaller than this share of it is the rounding of areas.
constexpr Real area_rounding = 1e-12;

bool has_direction(const BlockFace& face) {
  return std::abs(norm(face.normal) - 1) < 1e-6;
}

ContactPlane& plane_of(std::vector<ContactPlane>& planes, const Vec3& normal) {
  const auto same = std::find_if(planes.begin(), planes.end(), [&](const ContactPlane& p) {
    return norm(p.normal - normal) <= direction_tolerance;
  });
  if (same != planes.end()) return *same;
  planes.push_back({.normal = normal});
  return planes.back();
}

Real free_area(std::span<const BlockFace> faces) {
  Real sum = 0;
  for (const BlockFace& face : faces) {
    const Real open = face.area - face.contact_area;
    if (open > area_rounding * face.area) sum += open;
  }
  return sum;
}

bool is_removable(std::span<const ContactPlane> planes) {
  std::vector<Vec3> normals;
  normals.reserve(planes.size());
  for (const ContactPlane& p : planes) normals.push_back(p.normal);
  return removable_direction(normals).has_value();
}

/// r = load − Σ p A n, and zero where that is the rounding of forces that cancel.
Vec3 resultant(std::span<const ContactPlane> planes, const Vec3& load, Real water_pressure) {
  Vec3 r = load;
  Real size = norm(load);
  for (const ContactPlane& p : planes) {
    const Vec3 push = (water_pressure * p.area) * p.normal + p.water;
    r -= push;
    size += norm(push);
  }
  return norm(r) <= 1e-12 * size ? Vec3{} : r;
}

}  // namespace

std::vector<ContactPlane> contact_planes(std::span<const BlockFace> faces) {
  std::vector<ContactPlane> planes;
  planes.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const BlockFace& face = faces[f];
    if (!(face.contact_area > 0) || !has_direction(face)) continue;
    ContactPlane& plane = plane_of(planes, face.normal);
    if (plane.face == none ||
        face.contact_area > faces[static_cast<std::size_t>(plane.face)].contact_area)
      plane.face = static_cast<Index>(f);
    plane.area += face.contact_area;
    plane.friction += face.contact_area * face.friction;  // divided by the area below
    plane.cohesion += face.contact_area * face.cohesion;
    plane.water += face.water;
    plane.clamping += face.clamping;
    plane.in_situ_shear += face.in_situ_shear;
    plane.clamping_holds = plane.clamping_holds && face.clamping_holds;
    plane.normal_stiffness += face.contact_area * face.normal_stiffness;
    plane.shear_stiffness += face.contact_area * face.shear_stiffness;
  }
  for (ContactPlane& plane : planes) plane.friction /= plane.area;
  return planes;
}

std::optional<Movement> governing_movement(std::span<const ContactPlane> planes, const Vec3& r) {
  auto movements = possible_movements(planes, r);
  const bool holds = std::all_of(planes.begin(), planes.end(),
                                 [](const ContactPlane& p) { return p.clamping_holds; });
  for (Movement& m : movements) {
    const Movement stressed = with_in_situ_stress(planes, m, r);
    if (holds || stressed.sliding_force() > m.sliding_force()) m = stressed;
  }
  return least_safe(movements, r);
}

BlockVerdict judge_block(std::span<const BlockFace> faces, const Vec3& load, Real water_pressure) {
  BlockVerdict verdict;
  if (std::any_of(faces.begin(), faces.end(), [](const BlockFace& f) { return f.continues; })) {
    verdict.block_class = BlockClass::infinite;
    return verdict;
  }
  // A closed block without a free face has no removable direction: this only saves the search.
  const bool encased = std::all_of(faces.begin(), faces.end(),
                                   [](const BlockFace& f) { return f.contact_area > 0; });
  if (encased) return verdict;
  auto planes = contact_planes(faces);
  if (!is_removable(planes)) return verdict;

  verdict.planes = std::move(planes);
  verdict.resultant = resultant(verdict.planes, load, water_pressure);
  verdict.free_area = free_area(faces);
  verdict.movement = governing_movement(verdict.planes, verdict.resultant);
  const bool moves = verdict.movement && verdict.movement->sliding_force() >
                                             equilibrium_tolerance * norm(verdict.resultant);
  verdict.block_class = moves ? BlockClass::key : BlockClass::stable;
  return verdict;
}

bool BlockVerdict::rotates() const {
  if (rotations.empty()) return false;
  if (!movement) return true;
  if (movement->mode == SlidingMode::lifting && movement->resisting == 0) return false;
  return rotations[0].safety * movement->driving < movement->resisting;
}

Real BlockVerdict::sliding_force() const {
  return rotates() ? rotations[0].sliding_force() : movement->sliding_force();
}

void add_rotations(BlockVerdict& verdict, std::vector<Rotation> rotations) {
  verdict.rotations = std::move(rotations);
  if (!verdict.rotations.empty() && verdict.rotations[0].safety < 1 - equilibrium_tolerance)
    verdict.block_class = BlockClass::key;
}

}  // namespace rockfold
