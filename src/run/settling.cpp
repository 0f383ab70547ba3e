#include "src/run/settling.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Steps over which the forces on walls go.
constexpr Index release_steps = 10;
/// Steps after which what is not at rest yet is left to the dynamic step.
constexpr Index most_steps = 100;
/// Of gravity, or without any of the largest acceleration there has been: what accelerates less is at rest.
constexpr Real resting = 1e-2;
/// By how much the acceleration of a block may change in a step, in its own terms, if it is to be steady …
constexpr Real steady = 0.05;
/// … and to how much accelerations must fall if rock is coming to rest.
constexpr Real falling = 0.7;
/// Of a block's size, what the fastest one moves in a step at most.
constexpr Real longest_way = 1e-4;

}  // namespace

Real walls_left(const std::vector<std::array<Real, 2>>& release, Real time) {
  Real from = 0, gone = 0;
  for (const auto& [at, share] : release) {
    if (time < at) return 1 - (gone + (share - gone) * (time - from) / (at - from));
    from = at;
    gone = share;
  }
  return 1 - gone;
}

void Settling::begin(Real time_step, Real size, Real gravity, Real free, Real rounding) {
  *this = {};
  time_step_ = time_step;
  size_ = size;
  gravity_ = gravity;
  free_ = free;
  rounding_ = rounding;
  done_ = false;
}

Real Settling::walls() const {
  return std::max<Real>(0, 1 - static_cast<Real>(settled_.steps + 1) / release_steps);
}

bool Settling::is_at_rest(Real acceleration) const {
  return acceleration <= resting * (gravity_ > 0 ? gravity_ : largest_ever_);
}

/// Whether all blocks are at rest or go on steadily, and which do that.
void Settling::judge(const std::vector<Vec3>& acceleration) {
  settled_.moving = 0;
  settled_.fastest = none;
  done_ = true;
  Real most = 0;
  for (std::size_t b = 0; b < acceleration.size(); ++b) {
    const Real a = norm(acceleration[b]);
    if (is_at_rest(a)) continue;
    const Real change = norm(acceleration[b] - acceleration_[b]);
    if (change > steady * a || a > (1 + steady) * free_) done_ = false;
    ++settled_.moving;
    if (a <= most) continue;
    most = a;
    settled_.fastest = static_cast<Index>(b);
  }
}

void Settling::choose_time_step(Real acceleration, Real way) {
  const Real room = way > 0 ? std::sqrt(longest_way * size_ / way) : 2;
  time_step_ *= acceleration < falling * largest_before_ ? 2 : std::clamp<Real>(room, 0.5, 2);
}

void Settling::add(const std::vector<Vec3>& way, const std::vector<Vec3>& since, Index parts) {
  ++settled_.steps;
  // Each part begins at rest: a (Δt/n)²/4, n times.
  const Real by_way = 4 * static_cast<Real>(parts) / (time_step_ * time_step_);
  std::vector<Vec3> acceleration(way.size());
  Real largest_way = 0;
  for (std::size_t b = 0; b < way.size(); ++b) {
    acceleration[b] = by_way * way[b];
    largest_way = std::max(largest_way, norm(way[b]));
    if (norm(since[b]) <= std::max(settled_.largest, rounding_)) continue;
    settled_.largest = norm(since[b]);
    settled_.block = static_cast<Index>(b);
  }
  const Real largest = by_way * largest_way;
  largest_ever_ = std::max(largest_ever_, largest);
  if (settled_.steps > release_steps) {
    judge(acceleration);
    choose_time_step(largest, largest_way);
  }
  if (settled_.steps == most_steps) {
    settled_.ended = done_;
    done_ = true;
  }
  largest_before_ = largest;
  acceleration_ = std::move(acceleration);
}

void Settling::pass(Archive& archive) {
  archive.all(settled_, time_step_, size_, gravity_, free_, rounding_, largest_before_,
              largest_ever_, acceleration_, done_);
}

}  // namespace rockfold
