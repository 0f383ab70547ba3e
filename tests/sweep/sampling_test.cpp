#include "src/sweep/sampling.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace rockfold::sweep {
namespace {

TEST(Quantile, OfANormalVariableIsThatOfTables) {
  const Variable v{Variable::Kind::normal, 10, 2};
  EXPECT_NEAR(quantile(v, 0.5), 10, 1e-12);
  EXPECT_NEAR(quantile(v, 0.975), 10 + 2 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(quantile(v, 0.001), 10 - 2 * 3.090232306167814, 1e-11);
}

TEST(Quantile, OfATruncatedVariableCountsWhatIsInsideAlone) {
  const Variable half{Variable::Kind::normal, 0, 1, 0, 0};  // above 0: the median is that of 75 %
  EXPECT_NEAR(quantile(half, 0.5), 0.6744897501960817, 1e-12);
  const Variable cut{Variable::Kind::exponential, 1, 0, 0, 1, 2};
  const Real low = std::exp(-1.0), high = std::exp(-2.0);
  EXPECT_NEAR(quantile(cut, 0.25), -std::log(low - 0.25 * (low - high)), 1e-14);
}

TEST(Quantile, OfTheOtherKindsEqualsItsClosedForm) {
  EXPECT_EQ(quantile({Variable::Kind::constant, 3}, 0.2), 3);
  EXPECT_EQ(quantile({Variable::Kind::uniform, 0, 0, 0, 2, 6}, 0.25), 3);
  EXPECT_NEAR(quantile({Variable::Kind::power_law, 0, 0, 3, 1, 10}, 0.5),
              std::pow((1 + 0.01) / 2, -0.5), 1e-14);
  EXPECT_NEAR(quantile({Variable::Kind::power_law, 0, 0, 1, 1, 100}, 0.5), 10, 1e-13);
  // The median of a log-normal variable is mean / √(1 + (s/m)²).
  EXPECT_NEAR(quantile({Variable::Kind::log_normal, 5, 2}, 0.5), 5 / std::sqrt(1.16), 1e-13);
}

TEST(Quantile, OfWholeNumbersIsOneOfThem) {
  const Variable die{Variable::Kind::uniform, 0, 0, 0, 1, 6, true};
  std::vector<int> seen(7);
  for (int i = 0; i < 600; ++i) ++seen[static_cast<int>(quantile(die, (i + 0.5) / 600))];
  EXPECT_EQ(seen, (std::vector<int>{0, 100, 100, 100, 100, 100, 100}));
  EXPECT_EQ(quantile({Variable::Kind::normal, 10.4, 1, 0, 0, 20, true}, 0.5), 10);
}

SweepSpec one_variable(Sampling sampling, Index runs) {
  SweepSpec spec;
  spec.sampling = sampling;
  spec.runs = runs;
  spec.parameters = {{"x", Variable{Variable::Kind::uniform, 0, 0, 0, 0, 1}},
                     {"y", Variable{Variable::Kind::uniform, 0, 0, 0, 0, 1}}};
  return spec;
}

TEST(LatinHypercube, HasOneValueInEachSliceOfEachParameter) {
  constexpr Index runs = 37;
  const auto rows = sample(one_variable(Sampling::latin_hypercube, runs));
  for (std::size_t p = 0; p < 2; ++p) {
    std::vector<Index> slice;
    for (const auto& row : rows) slice.push_back(static_cast<Index>(std::stod(row[p]) * runs));
    std::sort(slice.begin(), slice.end());
    for (Index s = 0; s < runs; ++s) EXPECT_EQ(slice[s], s);
  }
  EXPECT_NE(rows[0][0], rows[0][1]);
}

TEST(MonteCarlo, FollowsFromTheSeedAlone) {
  SweepSpec spec = one_variable(Sampling::monte_carlo, 5);
  const auto five = sample(spec);
  spec.runs = 3;
  const auto three = sample(spec);
  EXPECT_TRUE(std::equal(three.begin(), three.end(), five.begin()));  // more runs change none
  spec.seed = 2;
  EXPECT_NE(sample(spec), three);
}

TEST(AllCombinations, ChangeTheLastParameterFirst) {
  SweepSpec spec;
  spec.parameters = {{"a", std::vector<std::string>{"1", "2"}},
                     {"b", std::vector<std::string>{"x", "y", "z"}}};
  const auto rows = sample(spec);
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[1], (std::vector<std::string>{"1", "y"}));
  EXPECT_EQ(rows[3], (std::vector<std::string>{"2", "x"}));
}

}  // namespace
}  // namespace rockfold::sweep
