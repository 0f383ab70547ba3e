#include "host/keyblock/motions/sliding.hpp"

#include <algorithm>
#include <limits>

#include "host/keyblock/motions/pyramid.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using Planes = std::span<const ContactPlane>;

/// Rounding of a component of r, over |r|.
constexpr Real force_rounding = 1e-15;

/// v/|v|, divided: exactly an axis where v is along one.
Vec3 unit(const Vec3& v) {
  const Real length = norm(v);
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// Whether a motion along s (of any length) enters none of the planes; r is what s was computed
/// from.
bool is_admissible(Planes planes, const Vec3& s, Real r_length) {
  const Real limit = direction_tolerance * norm(s) + force_rounding * r_length;
  return std::all_of(planes.begin(), planes.end(),
                     [&](const ContactPlane& p) { return dot(p.normal, s) <= limit; });
}

/// Eq. 5-1: s = r/|r|, F = |r|.
Movement lifting(const Vec3& r) {
  Movement m;
  m.mode = SlidingMode::lifting;
  m.direction = unit(r);
  m.driving = norm(r);
  return m;
}

/// Eq. 5-2, 5-7: s is the projection of r on plane i, N = r·n_i, F = |s| − N tan φ_i − c_i A_i.
std::optional<Movement> single_plane(Planes planes, std::size_t i, const Vec3& r) {
  const Real r_length = norm(r);
  const ContactPlane& plane = planes[i];
  const Real normal_force = dot(r, plane.normal);
  if (normal_force <= direction_tolerance * r_length) return {};
  const Vec3 s = r - normal_force * plane.normal;
  if (norm(s) <= direction_tolerance * r_length) return {};
  if (!is_admissible(planes, s, r_length)) return {};
  Movement m;
  m.mode = SlidingMode::single_plane;
  m.planes[0] = static_cast<Index>(i);
  m.direction = unit(s);
  m.driving = norm(s);
  m.normal_force[0] = normal_force;
  m.resisting = normal_force * plane.friction + plane.cohesion;
  return m;
}

/// Eq. 5-3, 5-4, 5-9: s along n_i × n_j towards r, N_i = r·b_i and N_j = r·b_j both compressive,
/// F = r·s − N_i tan φ_i − N_j tan φ_j − c_i A_i − c_j A_j.
std::optional<Movement> two_planes(Planes planes, std::size_t i, std::size_t j, const Vec3& r) {
  const Real r_length = norm(r);
  const Vec3 &n_i = planes[i].normal, &n_j = planes[j].normal;
  const Vec3 line = cross(n_i, n_j);
  if (norm(line) <= direction_tolerance) return {};
  const Vec3 s = (dot(line, r) < 0 ? -1.0 : 1.0) * unit(line);
  const Real driving = dot(r, s);
  if (driving <= direction_tolerance * r_length) return {};
  const std::array<Real, 2> normal_force{dot(r, reciprocal_normal(n_i, n_j)),
                                         dot(r, reciprocal_normal(n_j, n_i))};
  if (std::min(normal_force[0], normal_force[1]) < -force_rounding * r_length) return {};
  if (!is_admissible(planes, s, 1)) return {};
  Movement m;
  m.mode = SlidingMode::two_planes;
  m.planes = {static_cast<Index>(i), static_cast<Index>(j)};
  m.direction = s;
  m.driving = driving;
  m.normal_force = {std::max(normal_force[0], 0.0), std::max(normal_force[1], 0.0)};
  m.resisting = m.normal_force[0] * planes[i].friction + planes[i].cohesion +
                m.normal_force[1] * planes[j].friction + planes[j].cohesion;
  return m;
}

}  // namespace

Real Movement::factor_of_safety() const {
  const bool unresisted = mode == SlidingMode::lifting && resisting == 0;
  return unresisted ? std::numeric_limits<Real>::quiet_NaN() : resisting / driving;
}

Vec3 reciprocal_normal(const Vec3& n_i, const Vec3& n_j) {
  const Vec3 line = cross(n_i, n_j);
  return (1.0 / dot(line, line)) * cross(n_j, line);
}

std::vector<Movement> possible_movements(Planes planes, const Vec3& r) {
  std::vector<Movement> movements;
  if (!(norm(r) > 0)) return movements;
  if (is_admissible(planes, r, norm(r))) return {lifting(r)};
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (const auto m = single_plane(planes, i, r)) movements.push_back(*m);
  if (!movements.empty()) return movements;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j)
      if (const auto m = two_planes(planes, i, j, r)) movements.push_back(*m);
  return movements;
}

std::optional<Movement> least_safe(std::span<const Movement> movements, const Vec3& r) {
  constexpr Real rounding = 1e-12;
  std::optional<Movement> worst;
  for (const Movement& m : movements)
    if (!worst || m.sliding_force() > worst->sliding_force() + rounding * norm(r)) worst = m;
  return worst;
}

std::optional<Movement> find_movement(Planes planes, const Vec3& r) {
  return least_safe(possible_movements(planes, r), r);
}

}  // namespace rockfold
