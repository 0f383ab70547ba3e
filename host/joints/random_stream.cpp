#include "host/joints/random_stream.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "host/exact/correctly_rounded.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real two_pi = 2 * std::numbers::pi;

// Box and Muller (1958); the second of the pair is not used, so that each value takes the same amount of numbers.
Real draw_normal(RandomStream& random) {
  const Real u = random.uniform(), v = random.uniform();
  return std::sqrt(-2 * correctly_rounded::log1p(-u)) * correctly_rounded::cos(two_pi * v);
}

// By the inverse of its distribution function, x = min·(1 + u·((max/min)^e − 1))^(1/e) with e = 1 − exponent, in a form
// that keeps its digits as e goes to zero.
Real draw_power_law(const Distribution& law, Real u) {
  using namespace correctly_rounded;
  const Real e = 1 - law.exponent, width = log(law.max / law.min);
  const Real s = e == 0 ? u * width : log1p(u * expm1(e * width)) / e;
  return std::clamp(law.min * exp(s), law.min, law.max);
}

Real draw_once(const Distribution& distribution, RandomStream& random) {
  switch (distribution.kind) {
    case Distribution::Kind::exponential:
      return -distribution.mean * correctly_rounded::log1p(-random.uniform());
    case Distribution::Kind::log_normal: {
      const auto [mu, sigma] = log_normal(distribution);
      return correctly_rounded::exp(mu + sigma * draw_normal(random));
    }
    case Distribution::Kind::power_law:
      return draw_power_law(distribution, random.uniform());
    default:
      return distribution.mean;
  }
}

}  // namespace

Real draw(const Distribution& distribution, RandomStream& random) {
  for (int tries = 0; tries < 100'000; ++tries)
    if (const Real x = draw_once(distribution, random);
        x >= distribution.min && x <= distribution.max)
      return x;
  throw std::logic_error("a distribution without values in its window");
}

LogNormal log_normal(const Distribution& distribution) {
  const Real ratio = distribution.standard_deviation / distribution.mean;
  const Real variance = correctly_rounded::log1p(ratio * ratio);
  return {correctly_rounded::log(distribution.mean) - 0.5 * variance, std::sqrt(variance)};
}

Real share_in_window(const Distribution& distribution) {
  const Real min = distribution.min, max = distribution.max;
  if (!(min <= max)) return 0;
  switch (distribution.kind) {
    case Distribution::Kind::exponential:
      return std::exp(-min / distribution.mean) - std::exp(-max / distribution.mean);
    case Distribution::Kind::log_normal: {
      const auto [mu, sigma] = log_normal(distribution);
      const auto above = [mu = mu, sigma = sigma](Real x) {  // log 0 = −∞
        return 0.5 * std::erfc((std::log(x) - mu) / (sigma * std::numbers::sqrt2));
      };
      return above(min) - above(max);
    }
    case Distribution::Kind::power_law:
      return 1;
    default:
      return distribution.mean >= min && distribution.mean <= max ? 1 : 0;
  }
}

Vec3 draw_fisher(const PlaneFrame& frame, Real kappa, RandomStream& random) {
  using namespace correctly_rounded;
  const Real u = random.uniform(), v = random.uniform();
  // 1 − cos θ, from 0 to 2: the inverse of the distribution function in a form good for any κ.
  const Real t = std::clamp(-log1p(u * expm1(-2 * kappa)) / kappa, 0.0, 2.0);
  const Real sin_theta = std::sqrt(t * (2 - t));
  const Real phi = two_pi * v;
  return (1 - t) * frame.normal + sin_theta * (correctly_rounded::cos(phi) * frame.down +
                                               correctly_rounded::sin(phi) * frame.strike);
}

}  // namespace rockfold
