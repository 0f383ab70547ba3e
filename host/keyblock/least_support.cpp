#include "host/keyblock/least_support.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// The conditions on the support P: gain·P ≥ deficit, and each of the planes slid on stays in
/// contact: N_k + reciprocal_k·P ≥ 0.
struct SupportProblem {
  Vec3 gain{};                         ///< −F s + Σ tan φ_k b_k
  Real deficit = 0;                    ///< F T − Σ (N tan φ + c A), N
  int planes = 0;                      ///< that it slides on
  std::array<Vec3, 2> reciprocal{};    ///< b_k
  std::array<Real, 2> normal_force{};  ///< N_k
};

SupportProblem support_problem(std::span<const ContactPlane> planes, const Movement& movement,
                               Real target) {
  const auto plane = [&](std::size_t k) -> const ContactPlane& {
    return planes[static_cast<std::size_t>(movement.planes[k])];
  };
  SupportProblem problem;
  problem.planes = movement.mode == SlidingMode::two_planes ? 2 : 1;
  problem.normal_force = movement.normal_force;
  problem.deficit = target * movement.driving - movement.resisting;
  problem.gain = -target * movement.direction;
  if (problem.planes == 1) {
    problem.reciprocal[0] = plane(0).normal;
  } else {
    problem.reciprocal = {reciprocal_normal(plane(0).normal, plane(1).normal),
                          reciprocal_normal(plane(1).normal, plane(0).normal)};
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(problem.planes); ++k)
    problem.gain += plane(k).friction * problem.reciprocal[k];
  return problem;
}

/// Contact may be lost by rounding alone: N and P are both of the size of the deficit.
bool keeps_contact(const SupportProblem& problem, const Vec3& p) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(problem.planes); ++k)
    if (problem.normal_force[k] + dot(problem.reciprocal[k], p) <
        -1e-12 * (problem.normal_force[k] + norm(problem.reciprocal[k]) * norm(p)))
      return false;
  return true;
}

/// The shortest P with a·P = alpha and b·P = beta.
Vec3 shortest(const Vec3& a, Real alpha, const Vec3& b, Real beta) {
  const Real aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
  const Real determinant =
      aa * bb - ab * ab;  // = |a × b|² > 0: only `gain` has a component along s
  return ((alpha * bb - beta * ab) / determinant) * a +
         ((beta * aa - alpha * ab) / determinant) * b;
}

/// The shortest P that meets the conditions. The first is always met exactly; the others hold by
/// themselves on one plane, and on two are tried in turn.
Vec3 shortest_support(const SupportProblem& problem, const Movement& movement, Real target) {
  const Vec3& g = problem.gain;
  const Vec3 free = (problem.deficit / dot(g, g)) * g;
  if (keeps_contact(problem, free)) return free;
  // Both contacts just open: P takes all normal forces away, P = −r + (Σ c A / F) s.
  const auto& [b0, b1] = problem.reciprocal;
  const auto& [n0, n1] = problem.normal_force;
  const Real along = (problem.deficit - dot(g, -n0 * reciprocal_normal(b0, b1)) -
                      dot(g, -n1 * reciprocal_normal(b1, b0))) /
                     target;
  Vec3 best =
      -n0 * reciprocal_normal(b0, b1) - n1 * reciprocal_normal(b1, b0) - along * movement.direction;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 p = shortest(g, problem.deficit, problem.reciprocal[k], -problem.normal_force[k]);
    if (keeps_contact(problem, p) && norm(p) < norm(best)) best = p;
  }
  return best;
}

}  // namespace

SupportForce least_support(std::span<const ContactPlane> planes, const Movement& movement,
                           Real target) {
  if (movement.mode == SlidingMode::lifting)
    return {std::max(0.0, target * movement.driving - movement.resisting),
            Vec3{} - movement.direction};
  const SupportProblem problem = support_problem(planes, movement, target);
  if (problem.deficit <= 0) return {0, normalized(problem.gain)};
  const Vec3 p = shortest_support(problem, movement, target);
  return {norm(p), normalized(p)};
}

Real support_force_along(std::span<const ContactPlane> planes, const Movement& movement,
                         const Vec3& direction, Real target) {
  constexpr Real impossible = std::numeric_limits<Real>::infinity();
  if (movement.mode == SlidingMode::lifting) {
    const Real share = -dot(direction, movement.direction);
    const Real deficit = target * movement.driving - movement.resisting;
    if (deficit <= 0) return 0;
    return share > 0 ? deficit / share : impossible;
  }
  const SupportProblem problem = support_problem(planes, movement, target);
  if (problem.deficit <= 0) return 0;
  const Real share = dot(problem.gain, direction);
  if (share <= 0) return impossible;
  const Real force = problem.deficit / share;
  return keeps_contact(problem, force * direction) ? force : impossible;
}

}  // namespace rockfold
