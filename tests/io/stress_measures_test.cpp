#include "src/io/viewers/stress_measures.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

using Stress = std::array<Real, 6>;

Material mohr_coulomb(Real cohesion, Real friction, Real tension) {
  Material m;
  m.strength = MohrCoulombStrength{cohesion, friction, tension};
  return m;
}

TEST(PrincipalStresses, AreDescendingRootsOfTheCharacteristicPolynomial) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> any(-1e6, 1e6);
  for (int i = 0; i < 200; ++i) {
    Stress s;
    for (Real& v : s) v = any(random);
    const Vec3 p = principal_stresses(s);
    EXPECT_GE(p[0], p[1]);
    EXPECT_GE(p[1], p[2]);
    // The three invariants.
    const Real second =
        s[0] * s[1] + s[1] * s[2] + s[2] * s[0] - s[3] * s[3] - s[4] * s[4] - s[5] * s[5];
    const Real third = s[0] * (s[1] * s[2] - s[4] * s[4]) - s[3] * (s[3] * s[2] - s[4] * s[5]) +
                       s[5] * (s[3] * s[4] - s[1] * s[5]);
    EXPECT_NEAR(p[0] + p[1] + p[2], s[0] + s[1] + s[2], 1e-8);
    EXPECT_NEAR(p[0] * p[1] + p[1] * p[2] + p[2] * p[0], second, 1e-1);  // of 1e12
    EXPECT_NEAR(p[0] * p[1] * p[2], third, 1e6);                         // of 1e18
    EXPECT_NEAR(von_mises(s),
                std::sqrt(0.5 * (std::pow(p[0] - p[1], 2) + std::pow(p[1] - p[2], 2) +
                                 std::pow(p[2] - p[0], 2))),
                1e-6);
  }
  EXPECT_EQ(principal_stresses({7, 7, 7, 0, 0, 0}), (Vec3{7, 7, 7}));
  const Vec3 shear = principal_stresses({0, 0, 0, 3, 0, 0});
  EXPECT_NEAR(shear[0], 3, 1e-14);
  EXPECT_NEAR(shear[1], 0, 1e-14);
  EXPECT_NEAR(shear[2], -3, 1e-14);
}

TEST(StrengthRatio, OfMohrCoulombIsStrengthOverStress) {
  const Material rock = mohr_coulomb(1e6, 30, 0.5e6);
  const Real uniaxial = 2e6 * std::sqrt(3.0);  // 2 c cos φ / (1 − sin φ)
  EXPECT_NEAR(strength_ratio({0, 0, -uniaxial / 2, 0, 0, 0}, rock), 2, 1e-12);
  // σ3 = 1 MPa: σ1f = 3 + 2√3 MPa.
  const Real strong = 3e6 + uniaxial;
  EXPECT_NEAR(strength_ratio({-1e6, -2e6, -strong, 0, 0, 0}, rock), 1, 1e-12);
  EXPECT_NEAR(strength_ratio({0, 0, 0.25e6, 0, 0, 0}, rock), 2, 1e-12);
  EXPECT_EQ(strength_ratio({0, 0, 0, 0, 0, 0}, rock), largest_strength_ratio);
  EXPECT_EQ(strength_ratio({-5e9, -5e9, -5e9, 0, 0, 0}, rock), largest_strength_ratio);
  EXPECT_TRUE(std::isnan(strength_ratio({0, 0, -1, 0, 0, 0}, Material{})));
}

TEST(StrengthRatio, OfHoekBrownFollowsItsCurve) {
  Material rock;
  rock.strength = HoekBrownStrength{100e6, 10, 1, 0.5};
  EXPECT_NEAR(strength_ratio({0, 0, -50e6, 0, 0, 0}, rock), 2, 1e-12);
  // σ3 = 10 MPa: σ1f = 10 + 100 √(10 · 0.1 + 1) MPa.
  EXPECT_NEAR(strength_ratio({-10e6, -10e6, -10e6 - 100e6 * std::sqrt(2.0), 0, 0, 0}, rock), 1,
              1e-12);
  // Tensile strength s σ_ci / m_b = 10 MPa.
  EXPECT_NEAR(strength_ratio({5e6, 0, 0, 0, 0, 0}, rock), 2, 1e-12);
}

}  // namespace
}  // namespace rockfold
