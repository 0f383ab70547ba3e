#include "host/keyblock/motions/least_support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using Conditions = std::span<const SupportCondition>;

constexpr Real impossible = std::numeric_limits<Real>::infinity();
constexpr Real rounding = 1e-10;

/// v/|v|, divided: exactly an axis where v is along one; nothing of nothing.
Vec3 unit(const Vec3& v) {
  const Real length = norm(v);
  return length > 0 ? Vec3{v[0] / length, v[1] / length, v[2] / length} : v;
}

/// Whether P meets a condition, but for rounding: deficit and gain·P are both of the size of what they differ by.
bool meets(const SupportCondition& c, const Vec3& p) {
  const Real size = std::abs(c.deficit) + norm(c.gain) * norm(p);
  return dot(c.gain, p) - c.deficit >= -rounding * size;
}

/// The shortest P that meets two conditions exactly; nothing where they are parallel.
std::optional<Vec3> shortest(const SupportCondition& a, const SupportCondition& b) {
  const Real aa = dot(a.gain, a.gain), ab = dot(a.gain, b.gain), bb = dot(b.gain, b.gain);
  const Real determinant = aa * bb - ab * ab;
  if (determinant <= rounding * rounding * aa * bb) return {};
  return ((a.deficit * bb - b.deficit * ab) / determinant) * a.gain +
         ((b.deficit * aa - a.deficit * ab) / determinant) * b.gain;
}

/// The P that meets three conditions exactly; nothing where they do not span space.
std::optional<Vec3> corner(const SupportCondition& a, const SupportCondition& b,
                           const SupportCondition& c) {
  const Vec3 ab = cross(a.gain, b.gain);
  const Real determinant = dot(ab, c.gain);
  if (std::abs(determinant) <= rounding * norm(a.gain) * norm(b.gain) * norm(c.gain)) return {};
  return (1 / determinant) *
         (a.deficit * cross(b.gain, c.gain) + b.deficit * cross(c.gain, a.gain) + c.deficit * ab);
}

/// A P and the conditions that it just meets.
struct Tight {
  Vec3 p{};
  std::vector<SupportCondition> conditions;
};

/// The shortest P that meets a few conditions: that of one, two or three of them, the first that meets the others too. Of
/// several the shortest.
std::optional<Tight> shortest_of_few(Conditions few) {
  std::optional<Tight> best;
  const auto look_at = [&](const std::optional<Vec3>& p, std::vector<SupportCondition> tight) {
    if (!p || (best && norm(*p) >= norm(best->p))) return;
    if (std::all_of(few.begin(), few.end(), [&](const auto& c) { return meets(c, *p); }))
      best = Tight{*p, std::move(tight)};
  };
  for (std::size_t i = 0; i < few.size(); ++i) {
    const SupportCondition& a = few[i];
    look_at((a.deficit / dot(a.gain, a.gain)) * a.gain, {a});
    for (std::size_t j = i + 1; j < few.size(); ++j) {
      look_at(shortest(a, few[j]), {a, few[j]});
      for (std::size_t k = j + 1; k < few.size(); ++k)
        look_at(corner(a, few[j], few[k]), {a, few[j], few[k]});
    }
  }
  return best;
}

/// The condition that P misses by most; none where it meets all.
const SupportCondition* most_missed(Conditions conditions, const Vec3& p) {
  const SupportCondition* most = nullptr;
  Real by = 0;
  for (const SupportCondition& c : conditions) {
    if (meets(c, p)) continue;
    const Real distance =
        norm(c.gain) > 0 ? (c.deficit - dot(c.gain, p)) / norm(c.gain) : impossible;
    if (!most || distance > by) most = &c, by = distance;
  }
  return most;
}

}  // namespace

std::vector<SupportCondition> support_conditions(std::span<const ContactPlane> planes,
                                                 const Movement& movement, Real target) {
  const auto plane = [&](std::size_t k) -> const ContactPlane& {
    return planes[static_cast<std::size_t>(movement.planes[k])];
  };
  const Real deficit = target * movement.driving - movement.resisting;
  if (movement.mode == SlidingMode::lifting) return {{-movement.direction, deficit}};
  std::vector<SupportCondition> conditions{{-target * movement.direction, deficit}};
  const std::size_t count = movement.mode == SlidingMode::two_planes ? 2 : 1;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3& n = plane(k).normal;
    const Vec3 b = count == 1 ? n : reciprocal_normal(n, plane(1 - k).normal);
    conditions[0].gain += plane(k).friction * b;
    conditions.push_back({b, -movement.normal_force[k]});
  }
  return conditions;
}

SupportCondition support_condition(const Rotation& rotation, const Vec3& at, Real target) {
  return {-target * cross(rotation.axis, at - rotation.point),
          target * rotation.driving - rotation.resisting};
}

/// The shortest vector of a polyhedron: P that meets a few conditions, then with the one that it misses by most, until it
/// meets all. Each step makes it longer, so that no few come back, and no more than three of them are tight.
SupportForce least_support(Conditions conditions) {
  Tight least;
  const std::size_t most_steps = 100 + 10 * conditions.size();  // rounding could make it go round
  for (std::size_t step = 0; step < most_steps; ++step) {
    const SupportCondition* missed = most_missed(conditions, least.p);
    if (!missed) break;
    least.conditions.push_back(*missed);
    const auto next =
        norm(missed->gain) > 0 ? shortest_of_few(least.conditions) : std::optional<Tight>{};
    if (!next) return {impossible, unit(conditions[0].gain)};
    least = *next;
  }
  return {norm(least.p), unit(norm(least.p) > 0 ? least.p : conditions[0].gain)};
}

Real support_force_along(Conditions conditions, const Vec3& direction) {
  Real least = 0, most = impossible;
  for (const SupportCondition& c : conditions) {
    const Real share = dot(c.gain, direction);
    if (std::abs(share) <= rounding * norm(c.gain)) {
      if (c.deficit > 0) return impossible;
    } else if (share > 0) {
      least = std::max(least, c.deficit / share);
    } else if (c.deficit > 0) {
      return impossible;
    } else {
      most = std::min(most, c.deficit / share);
    }
  }
  return least <= (1 + rounding) * most ? least : impossible;
}

SupportForce least_support(std::span<const ContactPlane> planes, const Movement& movement,
                           Real target) {
  return least_support(support_conditions(planes, movement, target));
}

Real support_force_along(std::span<const ContactPlane> planes, const Movement& movement,
                         const Vec3& direction, Real target) {
  return support_force_along(support_conditions(planes, movement, target), direction);
}

}  // namespace rockfold
