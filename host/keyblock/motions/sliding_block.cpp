#include "host/keyblock/motions/sliding_block.hpp"

#include <algorithm>

#include "host/keyblock/motions/pyramid.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// m, from a wall: above the rounding of a way.
constexpr Real touching = 1e-12;

}  // namespace

SlidingBlock::SlidingBlock(std::span<const ContactPlane> planes, const Movement& movement,
                           const std::array<PlaneStrength, 2>& residual, Real mass)
    : line_(movement.mode == SlidingMode::two_planes), mass_(mass) {
  const auto plane = [&](int k) -> const ContactPlane& { return planes[movement.planes[k]]; };
  direction_ = line_ ? movement.direction : plane(0).normal;
  for (int k = 0; k < (line_ ? 2 : 1); ++k) {
    const Vec3 b =
        line_ ? reciprocal_normal(plane(k).normal, plane(1 - k).normal) : plane(0).normal;
    planes_.push_back({b, {plane(k).friction, plane(k).cohesion}, residual[k]});
  }
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const bool slides_on =
        static_cast<Index>(i) == movement.planes[0] || static_cast<Index>(i) == movement.planes[1];
    const Vec3 wall = along(planes[i].normal);
    if (!slides_on && norm(wall) > direction_tolerance) walls_.push_back(normalized(wall));
  }
}

/// The part of v in which it can slide.
Vec3 SlidingBlock::along(const Vec3& v) const {
  const Vec3 part = dot(v, direction_) * direction_;
  return line_ ? part : v - part;
}

/// N
Real SlidingBlock::resistance(const Vec3& r) {
  Real sum = 0;
  for (const SlidingPlane& plane : planes_) {
    const PlaneStrength& strength = slipped_ ? plane.residual : plane.peak;
    const Real pressure = dot(r, plane.reciprocal);
    lifted_ = lifted_ || pressure < 0;
    sum += std::max(0.0, pressure) * strength.friction + strength.cohesion;
  }
  return sum;
}

/// What of a velocity no wall that it touches is in the way of.
Vec3 SlidingBlock::kept_out(Vec3 velocity) const {
  for (const Vec3& wall : walls_) {
    const Real speed = dot(velocity, wall);
    if (speed > 0 && dot(displacement_, wall) > -touching) velocity -= speed * wall;
  }
  return velocity;
}

void SlidingBlock::go(const Vec3& r, Real dt) {
  const Vec3 pushed = kept_out(velocity_ + (dt / mass_) * along(r));
  const Real speed = norm(pushed), lost = dt / mass_ * resistance(r);
  const Vec3 before = kept_out(velocity_);
  velocity_ = speed > lost ? (1 - lost / speed) * pushed : Vec3{};
  if (velocity_ == Vec3{} && before == Vec3{}) return;
  slipped_ = true;
  displacement_ += (0.5 * dt) * (before + velocity_);
  for (const Vec3& wall : walls_) displacement_ -= std::max(0.0, dot(displacement_, wall)) * wall;
}

}  // namespace rockfold
