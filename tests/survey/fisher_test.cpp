// Fisher's statistics against closed forms and against what they promise of samples.
#include "host/survey/fisher.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/survey/sampled_poles.hpp"

namespace rockfold {

namespace {

FisherStatistics of_equal_poles(const std::vector<Vec3>& poles) {
  const std::vector<Real> ones(poles.size(), 1);
  return fisher_statistics(poles, ones, ones);
}

}  // namespace

/// Five poles at 20° from 50/110, evenly round it: R = 5 cos 20°. Two of them point the other way.
TEST(FisherStatistics, OfPolesEvenlyAroundAnAxisEqualTheClosedForm) {
  const Vec3 mean = normal_of(50, 110);
  std::vector<Vec3> poles;
  for (int k = 0; k < 5; ++k)
    poles.push_back(direction_beside(mean, 20 * degree, 72 * k * degree + 0.3));
  poles[1] = -poles[1];
  poles[4] = -poles[4];
  const FisherStatistics found = of_equal_poles(poles);
  EXPECT_NEAR(angle_between_axes(found.mean, mean), 0, 1e-5);
  EXPECT_NEAR(found.effective_count, 5, 1e-12);
  EXPECT_NEAR(found.resultant, 5 * std::cos(20 * degree), 1e-12);
  const Real missing = 5 * (1 - std::cos(20 * degree));
  EXPECT_NEAR(found.kappa, 4 / missing, 1e-9);
  EXPECT_NEAR(found.kappa_unbiased, 3 / missing, 1e-9);
  // 20^(1/4) = 2.114743.
  const Real cosine = 1 - missing / (5 * std::cos(20 * degree)) * 1.114742526881;
  EXPECT_NEAR(found.confidence_cone, std::acos(cosine) / degree, 1e-8);
  // cos² 20° along the mean, the rest shared evenly.
  EXPECT_NEAR(found.eigenvalues[0], 0.883022221559, 1e-10);
  EXPECT_NEAR(found.eigenvalues[1], 0.0584888892202, 1e-10);
  EXPECT_NEAR(found.eigenvalues[2], 0.0584888892202, 1e-10);
}

TEST(FisherStatistics, OfCoincidingPolesHaveNoScatter) {
  const FisherStatistics found = of_equal_poles(std::vector<Vec3>(4, normal_of(33, 217)));
  EXPECT_TRUE(std::isinf(found.kappa));
  EXPECT_EQ(found.confidence_cone, 0);
  EXPECT_EQ(cone_of_share(found.kappa, 0.95), 0);
}

TEST(FisherStatistics, OfOnePoleAndOfNoneSayWhatTheyCannotKnow) {
  const FisherStatistics one = of_equal_poles({normal_of(33, 217)});
  EXPECT_NEAR(angle_between_axes(one.mean, normal_of(33, 217)), 0, 1e-6);
  EXPECT_TRUE(std::isnan(one.kappa));
  EXPECT_TRUE(std::isnan(one.confidence_cone));
  const std::vector<Vec3> poles{normal_of(33, 217)};
  const std::vector<Real> ones{1}, zeros{0};
  EXPECT_TRUE(std::isnan(fisher_statistics(poles, ones, zeros).mean[0]));
}

/// A pole of weight 2 is two poles for the mean, but no more than one for what is known: N is Kish's.
TEST(FisherStatistics, WeighPoles) {
  const std::vector<Vec3> poles{normal_of(20, 10), normal_of(30, 40), normal_of(25, 350)};
  const std::vector<Real> weights{2, 1, 1}, ones(3, 1);
  const FisherStatistics weighed = fisher_statistics(poles, weights, ones);
  const FisherStatistics twice = of_equal_poles({poles[0], poles[0], poles[1], poles[2]});
  EXPECT_NEAR(angle_between_axes(weighed.mean, twice.mean), 0, 1e-5);
  EXPECT_NEAR(weighed.effective_count, 16.0 / 6, 1e-12);
  EXPECT_NEAR(weighed.resultant / weighed.effective_count, twice.resultant / 4, 1e-12);
}

/// 2000 samples of 12 poles with κ = 20. The cone misses in 5 of 100: σ = √(0.05 · 0.95/2000) = 0.0049. Of one sample the unbiased κ has
/// the deviation 20/√(12 − 3), of the mean of all 0.149. Four deviations are allowed.
TEST(FisherStatistics, KeepTheirPromises) {
  constexpr int samples = 2000, poles_of_sample = 12;
  const Vec3 mean = normal_of(88, 300);  // poles on both sides of the horizon
  PoleSampler sampler(7);
  int held = 0;
  Real kappas = 0;
  for (int s = 0; s < samples; ++s) {
    std::vector<Vec3> poles;
    for (int i = 0; i < poles_of_sample; ++i)
      poles.push_back(sampler.either_way(sampler.fisher(mean, 20)));
    const FisherStatistics found = of_equal_poles(poles);
    held += angle_between_axes(found.mean, mean) <= found.confidence_cone;
    kappas += found.kappa_unbiased;
  }
  EXPECT_NEAR(held / Real{samples}, 0.95, 4 * 0.0049);
  EXPECT_NEAR(kappas / samples, 20, 4 * 0.149);
}

/// Of 20,000 poles; σ of a share p is √(p (1 − p)/20000) ≤ 0.0036.
TEST(ConesOfFishersDistribution, HoldTheirShareOfPoles) {
  for (const Real kappa : {0.5, 5.0, 60.0}) {
    PoleSampler sampler(11);
    int half = 0, most = 0;
    for (int i = 0; i < 20000; ++i) {
      const Real angle = std::acos(dot(sampler.fisher({0, 0, 1}, kappa), {0, 0, 1})) / degree;
      half += angle <= cone_of_share(kappa, 0.5);
      most += angle <= cone_of_share(kappa, 0.95);
    }
    EXPECT_NEAR(half / 20000.0, 0.5, 4 * 0.0036) << kappa;
    EXPECT_NEAR(most / 20000.0, 0.95, 4 * 0.0016) << kappa;
  }
}

TEST(MostLikelyKappa, BelongsToTheMeanLength) {
  for (const Real kappa : {1e-5, 0.02, 1.0, 7.3, 50.0, 3000.0})
    EXPECT_NEAR(
        kappa_of_mean_length(kappa < 1e-3 ? kappa / 3 : 1 / std::tanh(kappa) - 1 / kappa) / kappa,
        1, 1e-7);
  EXPECT_EQ(kappa_of_mean_length(0), 0);
}

}  // namespace rockfold
