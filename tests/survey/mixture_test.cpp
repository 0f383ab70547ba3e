// Sets among poles that were drawn from known ones.
#include "host/survey/mixture.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "host/survey/fisher.hpp"
#include "tests/survey/sampled_poles.hpp"

namespace rockfold {

namespace {

struct TrueSet {
  Vec3 mean;
  Real kappa;
  int count;
};

/// One leans, one is upright so that its poles lie on both sides of the horizon, one is nearly flat.
const std::vector<TrueSet> true_sets{
    {normal_of(70, 40), 50, 90}, {normal_of(88, 310), 80, 75}, {normal_of(15, 200), 30, 60}};

struct Drawn {
  std::vector<Vec3> poles;
  std::vector<std::size_t> set;  ///< as many as sets: of none
};

/// The sets, and beside them a tenth of all poles that are uniform.
Drawn draw(std::uint64_t seed) {
  PoleSampler sampler(seed);
  Drawn drawn;
  const auto add = [&](const Vec3& pole, std::size_t set) {
    drawn.poles.push_back(sampler.either_way(pole));
    drawn.set.push_back(set);
  };
  for (std::size_t k = 0; k < true_sets.size(); ++k)
    for (int i = 0; i < true_sets[k].count; ++i)
      add(sampler.fisher(true_sets[k].mean, true_sets[k].kappa), k);
  for (int i = 0; i < 25; ++i) add(sampler.any(), true_sets.size());
  return drawn;
}

SetSearch search(const std::vector<Vec3>& poles, std::optional<std::size_t> count = {}) {
  return find_axial_sets(poles, std::vector<Real>(poles.size(), 1), count);
}

std::size_t nearest(const std::vector<AxialSet>& sets, const Vec3& mean) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < sets.size(); ++k)
    if (angle_between_axes(sets[k].mean, mean) < angle_between_axes(sets[best].mean, mean))
      best = k;
  return best;
}

std::size_t most_likely(const AxialMixture& mixture, const Vec3& pole) {
  const auto chance = mixture.memberships(pole);
  return static_cast<std::size_t>(std::max_element(chance.begin(), chance.end()) - chance.begin());
}

}  // namespace

/// 30 samples of three sets. Each cone holds the true mean with 95 of 100, each κ is within two standard errors (κ/√N) with 95 of 100: of
/// 90 sets 85.5 with the deviation 2.1; four deviations are allowed.
TEST(AxialMixture, FindsTheSetsThatPolesWereDrawnFrom) {
  int held = 0, kappas = 0, right = 0, of_sets = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Drawn drawn = draw(seed);
    const AxialMixture found = search(drawn.poles).found;
    ASSERT_EQ(found.sets.size(), 3u) << seed;
    EXPECT_NEAR(found.background, 0.1, 4 * 0.03) << seed;  // a binomial share and what sets take
    std::vector<std::size_t> found_of;
    for (const TrueSet& wanted : true_sets) {
      found_of.push_back(nearest(found.sets, wanted.mean));
      const AxialSet& set = found.sets[found_of.back()];
      const Real n = set.share * static_cast<Real>(drawn.poles.size());
      const Real cone = confidence_cone(n, n - (n - 1) / set.kappa, 0.05);
      held += angle_between_axes(set.mean, wanted.mean) <= cone;
      kappas += std::abs(set.kappa - wanted.kappa) < 2 * wanted.kappa / std::sqrt(wanted.count);
    }
    for (std::size_t i = 0; i < drawn.poles.size(); ++i) {
      if (drawn.set[i] == true_sets.size()) continue;
      ++of_sets;
      right += most_likely(found, drawn.poles[i]) == found_of[drawn.set[i]];
    }
  }
  EXPECT_GE(held, 77);
  EXPECT_GE(kappas, 77);
  EXPECT_GE(right, 0.95 * of_sets);
}

/// Chance makes a cluster now and then that the criterion takes for a set: in no more than a tenth of such surveys.
TEST(AxialMixture, HardlyEverFindsSetsAmongUniformPoles) {
  int with_sets = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    PoleSampler sampler(seed);
    std::vector<Vec3> poles;
    for (int i = 0; i < 150; ++i) poles.push_back(sampler.any());
    with_sets += !search(poles).found.sets.empty();
  }
  EXPECT_LE(with_sets, 2);
}

/// A pole and its opposite are one plane.
TEST(AxialMixture, IsTheSameWhicheverWayPolesPoint) {
  Drawn drawn = draw(3);
  const AxialMixture before = search(drawn.poles).found;
  for (std::size_t i = 0; i < drawn.poles.size(); i += 3) drawn.poles[i] = -drawn.poles[i];
  const AxialMixture after = search(drawn.poles).found;
  ASSERT_EQ(before.sets.size(), after.sets.size());
  EXPECT_NEAR(before.log_likelihood, after.log_likelihood, 1e-9 * std::abs(before.log_likelihood));
  for (std::size_t k = 0; k < before.sets.size(); ++k)
    EXPECT_LT(angle_between_axes(before.sets[k].mean, after.sets[k].mean), 1e-4);
}

/// 4 K ln N less twice the logarithm of Π f, with f by another formula: half of Fisher's density about each end of the axis.
TEST(AxialMixture, HasTheCriterionOfItsLikelihood) {
  const Drawn drawn = draw(5);
  const AxialMixture found = search(drawn.poles).found;
  const auto fisher = [](Real kappa, Real t) {
    return 2 * kappa * std::exp(kappa * (t - 1)) / (1 - std::exp(-2 * kappa));
  };
  Real likelihood = 0;
  for (const Vec3& pole : drawn.poles) {
    Real f = found.background;
    for (const AxialSet& set : found.sets) {
      const Real t = dot(set.mean, pole);
      f += set.share * (fisher(set.kappa, t) + fisher(set.kappa, -t)) / 2;
    }
    likelihood += std::log(f);
  }
  EXPECT_NEAR(found.log_likelihood, likelihood, 1e-6);
  EXPECT_NEAR(found.criterion, -2 * likelihood + 12 * std::log(drawn.poles.size()), 1e-6);
}

TEST(AxialMixture, HasAsManySetsAsAreAskedFor) {
  const Drawn drawn = draw(1);
  for (const std::size_t count : {0u, 1u, 2u, 5u}) {
    const SetSearch found = search(drawn.poles, count);
    EXPECT_EQ(found.found.sets.size(), count);
    EXPECT_EQ(found.criteria.size(), count + 1);
  }
}

/// Coinciding poles are as narrow as a compass can tell; four poles are no set, and none are none.
TEST(AxialMixture, HoldsItsLimits) {
  std::vector<Vec3> poles(30, normal_of(40, 80));
  const AxialMixture one = search(poles).found;
  ASSERT_EQ(one.sets.size(), 1u);
  EXPECT_NEAR(one.sets[0].kappa, narrowest_kappa, 1e-3 * narrowest_kappa);
  poles.resize(4);
  EXPECT_TRUE(search(poles).found.sets.empty());
  EXPECT_TRUE(search({}).found.sets.empty());
}

}  // namespace rockfold
