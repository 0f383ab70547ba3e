#include "src/sweep/statistics.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

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
  EXPECT_NEAR(c.low, 0.05668, 1e-5);
  EXPECT_NEAR(c.high, 0.50984, 1e-5);
  EXPECT_EQ(chance_of(0, 10).low, 0);
  EXPECT_EQ(chance_of(10, 10).high, 1);
  EXPECT_EQ(chance_of(0, 0).high, 1);
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
