#include "host/keyblock/motions/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/keyblock/motions/pyramid.hpp"
#include "host/keyblock/motions/sliding.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using Patches = std::span<const ContactPatch>;

/// Rounding of coordinates, over their size.
constexpr Real coordinate_rounding = 1e-14;

/// Their corners' lines are some 10⁵ then; blocks of more planes of contact hardly ever are removable.
constexpr std::size_t most_planes_for_lines = 64;

/// Whether turning about the axis through `point` moves no corner of a contact into the rock.
bool is_admissible(Patches patches, const Vec3& point, const Vec3& axis) {
  for (const ContactPatch& patch : patches)
    for (const Vec3& x : patch.corners) {
      const Vec3 arm = x - point;
      const Real limit = direction_tolerance * norm(arm) + coordinate_rounding * norm(x);
      if (dot(cross(axis, arm), patch.normal) > limit) return false;
    }
  return true;
}

/// m⁻¹ v of a symmetric, positive definite matrix.
Vec3 solution(const Mat3& m, const Vec3& v) {
  const Vec3 a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  return (1 / dot(m[0], a)) * (v[0] * a + v[1] * b + v[2] * c);
}

/// About a point at `arm` from it to the centroid (Steiner).
Mat3 inertia_about(const RigidBody& body, const Vec3& arm) {
  Mat3 j = body.inertia;
  for (std::size_t i = 0; i < 3; ++i) {
    j[i][i] += body.mass * dot(arm, arm);
    for (std::size_t k = 0; k < 3; ++k) j[i][k] -= body.mass * arm[i] * arm[k];
  }
  return j;
}

/// N, with the anchors' pull.
Vec3 resultant(const RigidBody& body) {
  return body.force + body.pull;
}

/// What presses a block on the plane or the two planes of its hinge.
struct Hinge {
  std::size_t first = 0, second = 0;  ///< patches; the same one for an edge or a corner of one
};

/// The part of the loads r along the normals of the hinge: N n, or N_i n_i + N_j n_j of two planes; nothing where one of them is
/// not pressed by r and the anchors' pull.
std::optional<Vec3> pressing_part(Patches patches, const Hinge& hinge, const RigidBody& body) {
  const Vec3 &n_i = patches[hinge.first].normal, &n_j = patches[hinge.second].normal;
  const Vec3 all = resultant(body);
  const Real least = direction_tolerance * norm(all);
  if (hinge.first == hinge.second) {
    if (dot(all, n_i) <= least) return {};
    return dot(body.force, n_i) * n_i;
  }
  if (norm(cross(n_i, n_j)) <= direction_tolerance) return {};
  const Vec3 b_i = reciprocal_normal(n_i, n_j), b_j = reciprocal_normal(n_j, n_i);
  if (dot(all, b_i) <= least || dot(all, b_j) <= least) return {};
  return dot(body.force, b_i) * n_i + dot(body.force, b_j) * n_j;
}

/// Whether some corner of the patch leaves its plane.
bool lifts(const ContactPatch& patch, const Vec3& point, const Vec3& axis) {
  return std::any_of(patch.corners.begin(), patch.corners.end(), [&](const Vec3& x) {
    const Vec3 arm = x - point;
    return dot(cross(axis, arm), patch.normal) < -1e-6 * norm(arm);
  });
}

/// N m: the friction of planes that the load presses on and that the block only slides along, at the foot of the centroid.
Real friction_moment(Patches patches, const RigidBody& body, const Rotation& rotation) {
  Real sum = 0;
  for (const ContactPatch& patch : patches) {
    const Real pressed = dot(resultant(body), patch.normal);
    if (!(pressed > 0) || patch.friction == 0 || patch.corners.empty() ||
        lifts(patch, rotation.point, rotation.axis))
      continue;
    const Vec3 foot =
        body.centroid + dot(patch.corners[0] - body.centroid, patch.normal) * patch.normal;
    sum += patch.friction * pressed * norm(cross(rotation.axis, foot - rotation.point));
  }
  return sum;
}

struct Moments {
  Real driving = 0, resisting = 0;
};

/// About an axis: of the part of r that presses on the hinge, of the rest of r, and of the loads' own moment; the anchors'
/// pull takes from the driving moment, or adds to it.
Moments moments_about(const Vec3& axis, const Vec3& point, const RigidBody& body,
                      const Vec3& pressing) {
  const Vec3 velocity = cross(axis, body.centroid - point);
  Moments sum;
  for (const Real moment :
       {dot(pressing, velocity), dot(body.force - pressing, velocity), dot(body.moment, axis)})
    (moment > 0 ? sum.driving : sum.resisting) += std::abs(moment);
  sum.driving += dot(body.pull, velocity) + dot(body.pull_moment, axis);
  return sum;
}

/// Below this share of |r| times the arm a moment is rounding.
Real rounding_of_moments(const RigidBody& body, const Vec3& point) {
  const Real arm = norm(body.centroid - point);
  return 1e-9 *
         ((norm(body.force) + norm(body.pull)) * arm + norm(body.moment) + norm(body.pull_moment));
}

/// (net moment)² over the moment of inertia about the axis: of motions that start together, the one
/// that departs least from the free motion has the most (Gauss' principle of least constraint).
Real vigour(const Rotation& rotation, const RigidBody& body) {
  const Mat3 inertia = inertia_about(body, body.centroid - rotation.point);
  const Real net = rotation.driving - rotation.resisting;
  const Vec3& a = rotation.axis;
  return net * net / dot(a, {dot(inertia[0], a), dot(inertia[1], a), dot(inertia[2], a)});
}

class RotationSearch {
 public:
  RotationSearch(Patches patches, const RigidBody& body) : patches_(patches), body_(body) {}

  std::vector<Rotation> run() {
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      if (const auto pressing = pressing_part(patches_, {p, p}, body_))
        for (std::size_t k = 0; k < patches_[p].corners.size(); ++k) {
          turn_about(about_edge(patches_[p], k), *pressing, {p, p});
          turn_freely(patches_[p].corners[k], *pressing, p);
        }
      if (patches_.size() > most_planes_for_lines) continue;
      for (std::size_t q = p + 1; q < patches_.size(); ++q) turn_about_lines({p, q});
    }
    sort();
    return std::move(found_);
  }

 private:
  bool is_possible(const Rotation& rotation, const Hinge& hinge) const {
    return is_admissible(patches_, rotation.point, rotation.axis) &&
           lifts(patches_[hinge.first], rotation.point, rotation.axis) &&
           lifts(patches_[hinge.second], rotation.point, rotation.axis);
  }

  /// N, by which r and the pull press on a plane.
  Real pressed(std::size_t patch) const { return dot(resultant(body_), patches_[patch].normal); }

  void turn_about(Rotation rotation, const Vec3& pressing, const Hinge& hinge) {
    const Moments moments = moments_about(rotation.axis, rotation.point, body_, pressing);
    rotation.velocity = cross(rotation.axis, body_.centroid - rotation.point);
    if (moments.driving <= rounding_of_moments(body_, rotation.point) ||
        !(norm(rotation.velocity) > 0) || !is_possible(rotation, hinge))
      return;
    rotation.driving = moments.driving;
    rotation.resisting = moments.resisting + friction_moment(patches_, body_, rotation);
    rotation.safety = rotation.resisting / rotation.driving;
    const std::size_t more =
        pressed(hinge.second) > pressed(hinge.first) ? hinge.second : hinge.first;
    rotation.face = patches_[more].face;
    rotation.pressed = pressed(more);
    found_.push_back(rotation);
  }

  /// About lines through a corner of each of two planes, in either sense.
  void turn_about_lines(const Hinge& hinge) {
    const auto pressing = pressing_part(patches_, hinge, body_);
    if (!pressing) return;
    for (const Vec3& from : patches_[hinge.first].corners)
      for (const Vec3& to : patches_[hinge.second].corners) {
        if (norm(to - from) <= coordinate_rounding * norm(to)) continue;
        Rotation rotation;
        rotation.point = from;
        rotation.axis = normalized(to - from);
        turn_about(rotation, *pressing, hinge);
        rotation.axis = -rotation.axis;
        turn_about(rotation, *pressing, hinge);
      }
  }

  /// The free rotation about a corner, of a block that is turned over and not only twisted.
  void turn_freely(const Vec3& corner, const Vec3& pressing, std::size_t patch) {
    const Vec3 arm = body_.centroid - corner;
    const Vec3 acceleration = solution(
        inertia_about(body_, arm), cross(arm, resultant(body_)) + body_.moment + body_.pull_moment);
    if (!(norm(acceleration) > 0)) return;
    Rotation rotation;
    rotation.about = Rotation::About::corner;
    rotation.point = corner;
    rotation.axis = normalized(acceleration);
    const Vec3& n = patches_[patch].normal;
    const Vec3 over = rotation.axis - dot(rotation.axis, n) * n;
    const Moments turning = moments_about(over, corner, body_, pressing);
    const std::size_t before = found_.size();
    turn_about(rotation, pressing, {patch, patch});
    if (found_.size() == before) return;
    const Rotation& made = found_.back();
    if (turning.driving <= turning.resisting || made.driving <= made.resisting)
      found_.pop_back();
    else
      found_.back().safety = turning.resisting / turning.driving;
  }

  /// The least safe first; of equals the more vigorous one, whatever rounding says.
  void sort() {
    constexpr Real rounding = 1e-10;
    if (found_.empty()) return;
    const auto less_safe = [](const Rotation& a, const Rotation& b) { return a.safety < b.safety; };
    const Real least = std::min_element(found_.begin(), found_.end(), less_safe)->safety;
    const auto equals = std::stable_partition(found_.begin(), found_.end(), [&](const Rotation& r) {
      return r.safety <= least + rounding * (1 + least);
    });
    // Of two planes that share the edge the one that r presses on more.
    const auto keep_most = [&](auto begin, auto end, const auto& value) {
      Real most = 0;
      for (auto r = begin; r != end; ++r) most = std::max(most, value(*r));
      return std::stable_partition(
          begin, end, [&](const Rotation& r) { return value(r) >= (1 - rounding) * most; });
    };
    const auto vigorous =
        keep_most(found_.begin(), equals, [&](const Rotation& r) { return vigour(r, body_); });
    keep_most(found_.begin(), vigorous, [](const Rotation& r) { return r.pressed; });
    std::stable_sort(equals, found_.end(), less_safe);
  }

  Patches patches_;
  const RigidBody& body_;
  std::vector<Rotation> found_;
};

}  // namespace

Rotation about_edge(const ContactPatch& patch, std::size_t k) {
  const Vec3 &from = patch.corners[k], &to = patch.corners[(k + 1) % patch.corners.size()];
  Rotation rotation;
  rotation.point = from;
  rotation.axis = normalized(to - from);
  Vec3 middle{};
  for (const Vec3& x : patch.corners)
    middle += (1.0 / static_cast<Real>(patch.corners.size())) * (x - from);
  if (dot(cross(rotation.axis, middle), patch.normal) > 0) rotation.axis = -rotation.axis;
  return rotation;
}

Real Rotation::factor_of_safety() const {
  return resisting > 0 ? safety : std::numeric_limits<Real>::quiet_NaN();
}

Real Rotation::sliding_force() const {
  return (driving - resisting) / norm(velocity);
}

std::vector<Rotation> find_rotations(Patches patches, const RigidBody& body) {
  return RotationSearch(patches, body).run();
}

std::optional<Rotation> find_rotation(Patches patches, const RigidBody& body) {
  const auto all = find_rotations(patches, body);
  if (all.empty()) return {};
  return all.front();
}

}  // namespace rockfold
