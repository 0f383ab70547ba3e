#include "host/joints/radius_near_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/exact/correctly_rounded.hpp"

namespace rockfold {

namespace {

using Kind = Distribution::Kind;

// What is below has less than 1e-9 of the discs; what is above less than 1e-9 of f(r)·V(r) for any V, also of r³·f(r).
struct Range {
  Real low, high;
};
Range radius_range(const Distribution& radius, const LogNormal& log_normal) {
  const auto [mu, sigma] = log_normal;
  switch (radius.kind) {
    case Kind::exponential:
      return {std::max(radius.min, 1e-9 * std::min(radius.mean, radius.max)),
              std::min(radius.max, radius.min + 40 * radius.mean)};
    case Kind::log_normal:  // r³·f(r) is log-normal too, with μ + 3σ²
      return {std::max(radius.min, correctly_rounded::exp(mu - 7 * sigma)),
              std::min(radius.max, correctly_rounded::exp(mu + 3 * sigma * sigma + 7 * sigma))};
    case Kind::power_law:
      return {radius.min, radius.max};
    default:
      return {radius.mean, radius.mean};
  }
}

Real mode_of_log(const Distribution& radius, const LogNormal& log_normal) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  if (radius.kind == Kind::exponential) return correctly_rounded::log(radius.mean);
  if (radius.kind == Kind::log_normal) return log_normal.mu;
  return radius.exponent > 1 ? -infinity : infinity;
}

}  // namespace

RadiusNearBox::RadiusNearBox(const Distribution& radius, const Vec3& lengths)
    : radius_(radius), lengths_(lengths) {
  if (radius.kind == Kind::log_normal) log_normal_ = log_normal(radius);
  const auto [low, high] = radius_range(radius, log_normal_);
  largest_ = high;
  if (radius.kind == Kind::constant) return;
  mode_ = mode_of_log(radius, log_normal_);
  start_ = correctly_rounded::log(low);
  const Real width = std::max(0.0, correctly_rounded::log(high) - start_);
  const Real steepness = radius.kind == Kind::power_law ? std::abs(1 - radius.exponent) : 0;
  const int steps =
      static_cast<int>(std::clamp(std::ceil(width * std::max(10.0, steepness)), 16.0, 4096.0));
  step_ = width / steps;
  Real sum = 0;
  for (int i = 0; i < steps; ++i) {
    const Real from = start_ + i * step_, to = start_ + (i + 1) * step_;
    // The density has one maximum, the volume grows; a little more than their bound, against rounding.
    const Real bound =
        (1 + 1e-9) * density(std::clamp(mode_, from, to)) * volume(correctly_rounded::exp(to));
    bound_.push_back(bound);
    summed_.push_back(sum += bound);
  }
}

Real RadiusNearBox::volume(Real radius) const {
  return (lengths_[0] + 2 * radius) * (lengths_[1] + 2 * radius) * (lengths_[2] + 2 * radius);
}

Real RadiusNearBox::density(Real log_radius) const {
  switch (radius_.kind) {
    case Kind::exponential:  // r·exp(−(r − min)/mean)
      return correctly_rounded::exp(
          log_radius - (correctly_rounded::exp(log_radius) - radius_.min) / radius_.mean);
    case Kind::log_normal: {
      const Real z = (log_radius - log_normal_.mu) / log_normal_.sigma;
      return correctly_rounded::exp(-0.5 * z * z);
    }
    default:  // (r/min)^(1 − exponent)
      return correctly_rounded::exp((1 - radius_.exponent) * (log_radius - start_));
  }
}

Real RadiusNearBox::draw(RandomStream& random) const {
  if (radius_.kind == Kind::constant) return radius_.mean;
  for (;;) {
    const Real share = random.uniform() * summed_.back();
    const auto found = std::upper_bound(summed_.begin(), summed_.end(), share);
    const auto i = std::min<std::size_t>(found - summed_.begin(), summed_.size() - 1);
    const Real s = start_ + (static_cast<Real>(i) + random.uniform()) * step_;
    const Real radius = correctly_rounded::exp(s);
    if (random.uniform() * bound_[i] < density(s) * volume(radius))
      return std::clamp(radius, radius_.min, radius_.max);
  }
}

}  // namespace rockfold
