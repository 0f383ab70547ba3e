#include "src/sweep/statistics.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "src/sweep/sweep_spec.hpp"

namespace rockfold::sweep {
namespace {

constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();

TEST(Spread, OfFiveValuesIsAsByHand) {
  const Spread s = spread_of({4, nan, 1, 3, 2, 10});
  EXPECT_EQ(s.count, 5);
  EXPECT_DOUBLE_EQ(s.mean, 4);
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt((0 + 9 + 1 + 4 + 36) / 4.0));
  EXPECT_DOUBLE_EQ(s.p50, 3);
  EXPECT_DOUBLE_EQ(s.p25, 2);
  EXPECT_DOUBLE_EQ(s.p5, 1.2);
  EXPECT_EQ(spread_of({nan}).count, 0);
}

/// Wilson's interval, as Brown, Cai & DasGupta (2001) write it: 2 of 10 is 5.7 % … 51 %.
TEST(Chance, HasWilsonsBounds) {
  const Chance c = chance_of(2, 10);
  EXPECT_DOUBLE_EQ(c.probability, 0.2);
  EXPECT_NEAR(c.wilson.low, 0.05668, 1e-5);
  EXPECT_NEAR(c.wilson.high, 0.50984, 1e-5);
}

/// Of no success in n the upper bounds are z²/(n + z²) and 1 − (0.025)^(1/n); of n in n the lower ones lie as far below 1.
TEST(Chance, OfNoneAndOfAllHasOneBoundThatIsSure) {
  constexpr Real z = 1.959963984540054;
  for (const Index n : {1, 10, 200, 100000}) {
    const Chance none = chance_of(0, n), all = chance_of(n, n);
    EXPECT_EQ(none.wilson.low, 0);
    EXPECT_EQ(none.exact.low, 0);
    EXPECT_NEAR(none.wilson.high, z * z / (n + z * z), 1e-14) << n;
    EXPECT_NEAR(none.exact.high, -std::expm1(std::log(0.025) / n), 1e-11) << n;
    EXPECT_EQ(all.wilson.high, 1);
    EXPECT_EQ(all.exact.high, 1);
    EXPECT_NEAR(all.wilson.low, 1 - none.wilson.high, 1e-14) << n;
    EXPECT_NEAR(all.exact.low, 1 - none.exact.high, 1e-11) << n;
  }
  EXPECT_EQ(chance_of(0, 0).wilson.low, 0);
  EXPECT_EQ(chance_of(0, 0).exact.high, 1);
}

/// P(X ≥ met) of a binomial variable, term by term.
Real tail(Index met, Index n, Real p) {
  Real sum = 0;
  for (Index k = met; k <= n; ++k)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                    k * std::log(p) + (n - k) * std::log1p(-p));
  return sum;
}

/// Clopper & Pearson: so many or more have 2.5 % at the lower bound, so many or fewer at the upper one.
TEST(Chance, HasClopperAndPearsonsBounds) {
  for (const auto& [met, n] : {std::pair<Index, Index>{2, 10}, {47, 200}, {1, 3}, {122, 2000}}) {
    const Chance c = chance_of(met, n);
    EXPECT_NEAR(tail(met, n, c.exact.low), 0.025, 1e-10) << met << " of " << n;
    EXPECT_NEAR(1 - tail(met + 1, n, c.exact.high), 0.025, 1e-10) << met << " of " << n;
    EXPECT_LT(c.exact.low, c.wilson.low);
  }
  EXPECT_NEAR(chance_of(2, 10).exact.low, 0.02521, 1e-5);
  EXPECT_NEAR(chance_of(2, 10).exact.high, 0.55610, 1e-5);
}

TEST(IncompleteBeta, EqualsItsClosedForms) {
  for (const Real x : {0.01, 0.3, 0.5, 0.77, 0.999}) {
    EXPECT_NEAR(incomplete_beta(1, 1, x), x, 1e-14);
    EXPECT_NEAR(incomplete_beta(3.5, 1, x), std::pow(x, 3.5), 1e-13);
    EXPECT_NEAR(incomplete_beta(1, 4, x), 1 - std::pow(1 - x, 4), 1e-13);
    EXPECT_NEAR(incomplete_beta(0.5, 0.5, x), 2 / std::numbers::pi * std::asin(std::sqrt(x)),
                1e-13);
  }
  EXPECT_EQ(incomplete_beta(2, 3, 0), 0);
  EXPECT_EQ(incomplete_beta(2, 3, 1), 1);
}

TEST(RankCorrelation, SeesOrderNotSize) {
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3, nan}, {1, 8, 1000, 4}), 1);
  EXPECT_DOUBLE_EQ(rank_correlation({1, 2, 3}, {3, 2, 1}), -1);
  // Ranks 0 1 2 3 and, the first two tied, 0.5 0.5 3 2: Σab = 3.5, Σa² = 5, Σb² = 4.5.
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {5, 5, 9, 7}), 3.5 / std::sqrt(5 * 4.5), 1e-15);
  EXPECT_TRUE(std::isnan(rank_correlation({1, 1}, {1, 2})));
}

TEST(Condition, JoinsComparisonsAndBeforeOr) {
  const Condition c = parse_condition("force > 1e6 and fs<1.5 or blocks == 3");
  ASSERT_EQ(c.any_of_all.size(), 2U);
  ASSERT_EQ(c.any_of_all[0].size(), 2U);
  EXPECT_EQ(c.any_of_all[0][0].name, "force");
  EXPECT_EQ(c.any_of_all[0][0].number, 1e6);
  EXPECT_EQ(c.any_of_all[0][1].op, Condition::Operator::less);
  EXPECT_EQ(c.any_of_all[1][0].name, "blocks");
}

TEST(Condition, ThatIsNoneIsRefused) {
  for (const char* text : {"", "force", "force > ", "> 3", "force > much", "force => 3",
                           "force > 3 and", "force > inf"})
    EXPECT_THROW(parse_condition(text), std::invalid_argument) << text;
}

}  // namespace
}  // namespace rockfold::sweep
