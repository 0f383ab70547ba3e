// Random numbers that are the same on every machine (docs/random_joints.md).
#pragma once

#include <cstdint>
#include <random>

#include "host/joints/disc.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// std::mt19937_64, whose numbers the C++ standard fixes, seeded by its constructor from one 64-bit seed.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : engine_(seed) {}
  /// In [0, 1): the engine's upper 53 bits over 2^53.
  Real uniform() { return static_cast<Real>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

/// A value of the distribution inside [min, max]; others are drawn again (share_in_window() says how many those are).
/// Uniform numbers used a try: none for a constant, two for a log-normal value, else one. Throws std::logic_error after
/// 100,000 tries.
Real draw(const Distribution& distribution, RandomStream& random);

/// The part of the distribution's values, without its window, that lies in the window. 1 for a power law.
Real share_in_window(const Distribution& distribution);

/// Windows with less of the distribution than this are refused.
constexpr Real least_share_in_window = 1e-3;

/// A log-normal distribution's parameters, of the logarithm.
struct LogNormal {
  Real mu, sigma;
};
LogNormal log_normal(const Distribution& distribution);

/// A unit normal (to rounding) that scatters about frame.normal by Fisher's distribution on the sphere, density
/// κ/(4π sinh κ)·exp(κ cos θ) (Fisher, 1953). 0 < kappa < ∞. Two uniform numbers.
Vec3 draw_fisher(const PlaneFrame& frame, Real kappa, RandomStream& random);

}  // namespace rockfold
