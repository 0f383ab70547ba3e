#include "host/bolting/held_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();
constexpr Real rounding = 1e-12;

/// The balance along the movement, and how support changes it.
class Balance {
 public:
  Balance(std::span<const ContactPlane> planes, const Movement& movement) : movement_(movement) {
    if (movement.mode == SlidingMode::lifting || movement.planes[0] == none) return;
    count_ = movement.planes[1] == none ? 1 : 2;
    const ContactPlane& first = planes[static_cast<std::size_t>(movement.planes[0])];
    friction_[0] = first.friction;
    reciprocal_[0] = first.normal;
    if (count_ == 1) return;
    const ContactPlane& second = planes[static_cast<std::size_t>(movement.planes[1])];
    friction_[1] = second.friction;
    reciprocal_ = {reciprocal_normal(first.normal, second.normal),
                   reciprocal_normal(second.normal, first.normal)};
  }

  Real driving() const { return movement_.driving; }
  Real resisting(const Vec3& support) const {
    Real sum = movement_.resisting - dot(support, movement_.direction);
    for (std::size_t k = 0; k < count_; ++k) {
      const Real change = dot(support, reciprocal_[k]);
      sum += friction_[k] * std::max(change, -movement_.normal_force[k]);
    }
    return sum;
  }
  /// What one newton in the best direction adds to resisting − target·driving; support of a falling block only resists.
  Real best_gain(Real target) const {
    if (movement_.mode == SlidingMode::lifting) return 1;
    Vec3 gain = -target * movement_.direction;
    for (std::size_t k = 0; k < count_; ++k) gain += friction_[k] * reciprocal_[k];
    return norm(gain);
  }

 private:
  const Movement& movement_;
  std::size_t count_ = 0;
  std::array<Real, 2> friction_{0, 0};
  std::array<Vec3, 2> reciprocal_{};
};

/// N: of the passive elements.
Vec3 sum(std::span<const SupportElement> elements, const std::vector<Real>& mobilised) {
  Vec3 force{};
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (!elements[i].active) force += mobilised[i] * elements[i].force;
  return force;
}

/// m: where each element reaches its capacity; 0 of active ones.
std::vector<Real> yield_displacements(std::span<const SupportElement> elements) {
  std::vector<Real> yield(elements.size(), 0);
  Real last = 0;
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (!elements[i].active && elements[i].stiffness > 0) {
      yield[i] = norm(elements[i].force) / elements[i].stiffness;
      last = std::max(last, yield[i]);
    }
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (!elements[i].active && !(elements[i].stiffness > 0)) yield[i] = last > 0 ? last : 1;
  return yield;
}

std::vector<Real> mobilised_at(const std::vector<Real>& yield, Real displacement) {
  std::vector<Real> mobilised;
  mobilised.reserve(yield.size());
  for (const Real y : yield) mobilised.push_back(y > displacement ? displacement / y : 1);
  return mobilised;
}

/// How far resisting exceeds driving.
Real margin(const Balance& balance, const Vec3& support) {
  return balance.resisting(support) - balance.driving();
}

/// The least displacement at which the block is in balance: halving between displacements that are too small and large
/// enough, until they are neighbours. The margin grows with the displacement but where contacts open.
Real displacement_of_balance(const Balance& balance, std::span<const SupportElement> elements,
                             const std::vector<Real>& yield, Real largest) {
  Real low = 0, high = largest;
  for (int step = 0; step < 200; ++step) {
    const Real middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (margin(balance, sum(elements, mobilised_at(yield, middle))) >= 0 ? high : low) = middle;
  }
  return high;
}

}  // namespace

HeldBlock hold(std::span<const ContactPlane> planes, const Movement& movement,
               std::span<const SupportElement> elements, Real target) {
  const Balance balance(planes, movement);
  const Vec3 full = sum(elements, std::vector<Real>(elements.size(), 1));
  const Real size = movement.driving + norm(full);
  HeldBlock held;
  const Real driving = balance.driving(), resisting = balance.resisting(full);
  held.factor_of_safety = driving > rounding * size ? resisting / driving + 0.0 : infinite;
  if (elements.empty()) held.factor_of_safety = movement.factor_of_safety();
  const Real missing = target * driving - resisting;
  held.adequate = missing <= rounding * size;
  held.missing_force = held.adequate ? 0 : missing / balance.best_gain(target);
  held.in_balance = driving - resisting <= rounding * size;

  held.mobilised.assign(elements.size(), 1);
  held.moved.assign(elements.size(), infinite);
  const auto yield = yield_displacements(elements);
  const Real largest = yield.empty() ? 0 : *std::max_element(yield.begin(), yield.end());
  if (margin(balance, {}) >= 0) {
    held.displacement = 0;
  } else if (!held.in_balance) {
    held.displacement = infinite;
    return held;
  } else {
    held.displacement = displacement_of_balance(balance, elements, yield, largest);
  }
  held.mobilised = mobilised_at(yield, held.displacement);
  held.moved.assign(elements.size(), held.displacement);
  return held;
}

HeldBlock at_rest(std::span<const SupportElement> elements) {
  HeldBlock held;
  held.factor_of_safety = infinite;
  held.adequate = held.in_balance = true;
  for (const SupportElement& element : elements) held.mobilised.push_back(element.active ? 1 : 0);
  held.moved.assign(elements.size(), 0);
  return held;
}

Vec3 Turning::motion(const Vec3& at) const {
  return cross(axis, at - point);
}

/// As forces at the arm, all along one line: a movement without planes.
HeldBlock hold(const Turning& turning, std::span<const SupportElement> elements, Real target) {
  constexpr Vec3 line{1, 0, 0};
  Movement movement;
  movement.mode = SlidingMode::single_plane;
  movement.direction = line;
  movement.driving = turning.driving / turning.arm;
  movement.resisting = turning.resisting / turning.arm;
  std::vector<SupportElement> along;
  std::vector<Real> lever;  // of each element's displacement over that at the arm
  for (const SupportElement& element : elements) {
    const Vec3 motion = turning.motion(element.point);
    const Real force = dot(motion, element.force) / turning.arm, full = norm(element.force);
    lever.push_back(norm(motion) / turning.arm);
    const Real stiffness = full > 0 ? element.stiffness * lever.back() * std::abs(force) / full : 0;
    along.push_back({force * line, element.active, stiffness, {}});
  }
  HeldBlock held = hold({}, movement, along, target);
  for (std::size_t i = 0; i < lever.size(); ++i)
    held.moved[i] = lever[i] > 0 ? lever[i] * held.moved[i] : 0;
  return held;
}

}  // namespace rockfold
