// The density of poles: its mean, its peak, and which way poles point.
#include "host/survey/density.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/survey/sampled_poles.hpp"

namespace rockfold {

/// Spread-out poles are as many as poles: over a lattice of equal areas on the sphere (Fibonacci's) the mean is 1.
TEST(PoleDensity, HasTheMeanOne) {
  const PoleDensity density({normal_of(30, 80), normal_of(85, 200), normal_of(84, 21)}, {1, 2, 5});
  constexpr int points = 20000;
  Real sum = 0;
  for (int k = 0; k < points; ++k) {
    const Real z = 1 - (2 * k + 1.0) / points, turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const Real r = std::sqrt(1 - z * z);
    sum += density.at({r * std::cos(turn), r * std::sin(turn), z});
  }
  EXPECT_NEAR(sum / points, 1, 1e-4);
}

/// N = 18 like poles: κ = 2 (1 + 18/9) = 6; at the pole κ coth κ, at right angles κ/sinh κ.
TEST(PoleDensity, IsVollmersAtThreeDeviations) {
  const Vec3 pole = normal_of(40, 130);
  const PoleDensity density(std::vector<Vec3>(18, pole), std::vector<Real>(18, 0.7));
  EXPECT_NEAR(density.kappa(), 6, 1e-12);
  EXPECT_NEAR(density.at(pole), 6 / std::tanh(6.0), 1e-9);
  EXPECT_NEAR(density.at(-pole), 6 / std::tanh(6.0), 1e-9);
  EXPECT_NEAR(density.at(direction_beside(pole, 90 * degree, 1)), 6 / std::sinh(6.0), 1e-9);
}

}  // namespace rockfold
