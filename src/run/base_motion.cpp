#include "src/run/base_motion.hpp"

#include <utility>

#include "src/base/vector.hpp"

namespace rockfold {

BaseRecord::BaseRecord(TimeTable acceleration) : acceleration_(std::move(acceleration)) {
  motion_.acceleration = acceleration_.at(0);
}

const BaseMotion& BaseRecord::at(Real time) {
  for (const Real row : acceleration_.time)
    if (row > time_ && row < time) advance(row);
  if (time > time_) advance(time);
  return motion_;
}

/// Over a time in which the acceleration is linear.
void BaseRecord::advance(Real time) {
  const Real dt = time - time_;
  const Vec3 before = motion_.acceleration, after = acceleration_.at(time);
  motion_.displacement += dt * motion_.velocity + (dt * dt / 6) * (2 * before + after);
  motion_.velocity += (dt / 2) * (before + after);
  motion_.acceleration = after;
  time_ = time;
}

}  // namespace rockfold
