// Probabilities where they are known, and that nothing but the seed decides.
#include "host/keyblock/theory/monte_carlo.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <omp.h>

#include "host/keyblock/theory/theory.hpp"
#include "host/keyblock/theory/tunnel_block.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/model/tunnel_section.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

Model model_of(Real spacing, Real friction_angle, Real kappa = INFINITY) {
  Model model = test::model_with_joints(friction_angle, 1e3);
  const Real dips[] = {60, 55, 70}, directions[] = {30, 145, 260};
  for (std::size_t i = 0; i < 3; ++i) {
    JointSet set;
    set.name = "J" + std::to_string(i + 1);
    set.orientation = DipOrientation{dips[i], directions[i]};
    set.random = RandomSet{};
    set.random->fisher_kappa = kappa;
    set.random->spacing = Distribution{};
    set.random->spacing->mean = spacing;
    set.place = {"m.toml", 3, 1, "joint_set[" + std::to_string(i + 1) + "]"};
    model.joint_sets.push_back(set);
  }
  model.theory = TheorySpec{};
  return model;
}
const TheoryTunnel adit{
    "adit", 20, 5, circle_section(2, 16), {"m.toml", 9, 1, "block_theory.tunnel[1]"}};

/// Apexes of the pyramid's finite blocks lie in the part of the section's plane between the maximum
/// apex and the section: its area.
Real apex_area(const TunnelFrame& frame, const TunnelPyramid& pyramid) {
  Real area = 0;
  for (std::size_t i = 0; i < frame.section.size(); ++i) {
    const Point2 &a = frame.section[i], &b = frame.section[(i + 1) % frame.section.size()],
                 &p = pyramid.apex();
    const Real twice = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    if (twice < 0) area -= twice / 2;
  }
  return area;
}

// Joints so far apart that one corner of the lattice at most lies there: the expected number of
// corners, volume over the cell's volume, is the probability.
TEST(MonteCarlo, OfSparseJointsGivesTheProbabilityOfACornerInTheRightPlace) {
  const Real spacing = 30;
  const Model model = model_of(spacing, 30);
  MonteCarloSpec spec;
  spec.realisations = 40'000;
  spec.length = 3;
  spec.reach = 40;
  spec.confidence = 0.9999;
  const auto result = simulate_tunnel(model, adit, spec);
  const auto frame = tunnel_frame(adit.trend, adit.plunge, adit.section);
  const auto sets = theory_sets(model);
  const auto n = upward_normals(sets);
  const Real cell = std::pow(spacing, 3) / std::abs(dot(n[0], cross(n[1], n[2])));
  int checked = 0;
  for (const auto& p : result.pyramids) {
    const auto pyramid = TunnelPyramid::make(frame, joint_pyramid(n, p.code));
    if (!pyramid) {
      EXPECT_EQ(p.block.count, 0) << p.code;
      continue;
    }
    const Real expected = apex_area(frame, *pyramid) * spec.length / cell;
    if (norm(frame.lifted(pyramid->apex())) > 12) continue;  // not sure to hold one corner only
    ++checked;
    EXPECT_LT(p.block.low, expected) << p.code;
    EXPECT_GT(p.block.high, expected) << p.code;
  }
  EXPECT_GE(checked, 4);
}

// Joints so dense that a corner lies next to every maximum apex.
TEST(MonteCarlo, OfDenseJointsGivesTheMaximumBlocks) {
  const Model model = model_of(0.05, 30);
  MonteCarloSpec spec;
  spec.realisations = 3;
  spec.length = 2;
  const auto result = simulate_tunnel(model, adit, spec);
  const auto largest = tunnel_blocks(theory_sets(model), theory_loads(model), adit);
  for (const auto& block : largest) {
    const auto p = std::find_if(result.pyramids.begin(), result.pyramids.end(),
                                [&](const auto& q) { return q.code == block.code; });
    if (block.shape.volume > 30) continue;  // its apex may be out of reach
    EXPECT_EQ(p->block.value, 1) << block.code;
    if (!block.key) continue;
    EXPECT_LE(p->volume.greatest, block.shape.volume * (1 + 1e-9));
    EXPECT_GT(p->volume.least, 0.8 * block.shape.volume) << block.code;
  }
}

TEST(MonteCarlo, DependsOnTheSeedAloneNotOnTheThreads) {
  Model model = model_of(1.5, 30, 80);
  model.joint_sets[1].random->spacing->kind = Distribution::Kind::exponential;
  MonteCarloSpec spec;
  spec.realisations = 300;
  spec.friction_deviation = 4;
  spec.cohesion_variation = 0.4;
  const auto run = [&](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    auto result = simulate_tunnel(model, adit, spec);
    omp_set_num_threads(before);
    return result;
  };
  const auto one = run(1), four = run(4);
  EXPECT_EQ(one.key.count, four.key.count);
  EXPECT_EQ(one.support_pressure.mean, four.support_pressure.mean);
  EXPECT_EQ(one.largest_volume.greatest, four.largest_volume.greatest);
  EXPECT_EQ(one.largest_volume.deviation, four.largest_volume.deviation);
  EXPECT_GT(one.key.count, 0);
  spec.seed = 2;
  EXPECT_NE(run(1).support_pressure.mean, one.support_pressure.mean);
}

TEST(MonteCarlo, WithMoreFrictionHasFewerKeyBlocks) {
  MonteCarloSpec spec;
  spec.realisations = 400;
  Index before = spec.realisations * 8;
  for (const Real friction : {10.0, 40.0, 70.0}) {
    const auto result = simulate_tunnel(model_of(2, friction, 100), adit, spec);
    Index keys = 0;
    for (const auto& p : result.pyramids) keys += p.key.count;
    EXPECT_LT(keys, before);
    before = keys;
  }
}

TEST(MonteCarlo, RefusesSectionsWithInwardCornersAndTooManyJoints) {
  MonteCarloSpec spec;
  spec.realisations = 2;
  spec.place = {"m.toml", 20, 1, "block_theory.monte_carlo"};
  TheoryTunnel notched = adit;
  notched.section = {{-2, 0}, {2, 0}, {2, 3}, {0, 1}, {-2, 3}};
  const auto key_of = [&](const Model& model, const TheoryTunnel& tunnel) -> std::string {
    try {
      simulate_tunnel(model, tunnel, spec);
    } catch (const Error& error) {
      return error.diagnostics()[0].place.key;
    }
    return "";
  };
  EXPECT_EQ(key_of(model_of(1, 30), notched), "block_theory.tunnel[1].section");
  EXPECT_EQ(key_of(model_of(1e-6, 30), adit), "block_theory.monte_carlo.reach");
  Model discs = model_of(1, 30);
  discs.joint_sets[2].random->spacing.reset();
  EXPECT_EQ(key_of(discs, adit), "joint_set[3].random.spacing");
}

TEST(Probabilities, HaveWilsonsBounds) {
  const auto half = probability(5, 10, 0.95);
  EXPECT_NEAR(half.low, 0.236593, 1e-6);
  EXPECT_NEAR(half.high, 0.763407, 1e-6);
  const auto never = probability(0, 10, 0.95);
  EXPECT_EQ(never.low, 0);
  EXPECT_NEAR(never.high, 0.277533, 1e-6);
  EXPECT_EQ(probability(10, 10, 0.95).high, 1);
}

TEST(Distributions, HaveQuantilesWithBoundsByRank) {
  std::vector<Real> sample;
  for (int i = 100; i > 0; --i) sample.push_back(i);
  const auto d = distribution(sample, 0.95);
  EXPECT_EQ(d.count, 100);
  EXPECT_DOUBLE_EQ(d.mean, 50.5);
  EXPECT_NEAR(d.deviation, std::sqrt(100 * 101 / 12.0), 1e-12);
  const Quantile& median = d.quantiles[2];
  EXPECT_EQ(median.value, 50);
  EXPECT_EQ(median.low, 40);
  EXPECT_EQ(median.high, 61);
  EXPECT_TRUE(std::isnan(d.quantiles[0].low) || d.quantiles[0].low == 1);
  EXPECT_TRUE(std::isnan(d.quantiles.back().high));
  EXPECT_EQ(distribution({}, 0.95).count, 0);
}

// The bounds hold the true value as often as they say.
TEST(Distributions, BoundsOfTheMedianHoldItAsOftenAsTheySay) {
  std::uint64_t state = 1;
  int held = 0;
  const int trials = 2000;
  for (int t = 0; t < trials; ++t) {
    std::vector<Real> sample;
    for (int i = 0; i < 101; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      sample.push_back(static_cast<Real>(state >> 11) * 0x1p-53);
    }
    const auto median = distribution(sample, 0.9).quantiles[2];
    held += median.low <= 0.5 && 0.5 <= median.high;
  }
  EXPECT_GT(held, 0.88 * trials);
  EXPECT_LT(held, 0.96 * trials);
}

}  // namespace
}  // namespace rockfold
