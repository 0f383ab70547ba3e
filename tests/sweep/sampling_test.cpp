#include "src/sweep/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "src/sweep/statistics.hpp"

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

Variable of_kind(Variable::Kind kind, Real min = -std::numeric_limits<Real>::infinity(),
                 Real max = std::numeric_limits<Real>::infinity()) {
  Variable v;
  v.kind = kind;
  v.min = min;
  v.max = max;
  return v;
}

TEST(Quantile, OfATriangleIsWhereItsAreaIsParted) {
  Variable v = of_kind(Variable::Kind::triangular, 1, 5);
  v.mode = 2;
  EXPECT_NEAR(quantile(v, 0.25), 2, 1e-15);  // a quarter of the area lies left of the mode
  EXPECT_NEAR(quantile(v, 0.0625), 1.5, 1e-15);
  EXPECT_NEAR(quantile(v, 1 - 0.75 / 4), 3.5, 1e-15);
  v.mode = 1;
  EXPECT_NEAR(quantile(v, 0.75), 3, 1e-15);
}

TEST(Quantile, OfABetaVariableIsThatOfItsClosedForms) {
  Variable v = of_kind(Variable::Kind::beta, 10, 20);
  EXPECT_NEAR(quantile(v, 0.3), 13, 1e-12);  // uniform
  v.alpha = 3;
  EXPECT_NEAR(quantile(v, 0.125), 15, 1e-12);  // t³
  v.alpha = v.beta = 0.5;                      // arcsine: sin²(π u/2)
  EXPECT_NEAR(quantile(v, 1.0 / 3), 12.5, 1e-10);
}

TEST(Quantile, OfAWeibullVariableIsItsClosedForm) {
  Variable v = of_kind(Variable::Kind::weibull);
  v.shape = 2;
  v.scale = 3;
  EXPECT_NEAR(quantile(v, 1 - std::exp(-1.0)), 3, 1e-14);
  v.max = 3;  // what lies below 3 alone
  EXPECT_NEAR(quantile(v, 0.5), 3 * std::sqrt(-std::log1p(-0.5 * -std::expm1(-1.0))), 1e-14);
}

TEST(Quantile, OfAnExponentialVariableBelowZeroIsTheOthersMirrorImage) {
  const Variable above{Variable::Kind::exponential, 2}, below{Variable::Kind::exponential, -2};
  for (const Real u : {0.01, 0.3, 0.5, 0.9})
    EXPECT_NEAR(quantile(below, u), -quantile(above, 1 - u), 1e-13);
  Variable cut = below;
  cut.min = -3;
  cut.max = -1;
  EXPECT_GT(quantile(cut, 0.001), -3);
  EXPECT_LT(quantile(cut, 0.999), -1);
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

std::vector<Real> column(const std::vector<std::vector<std::string>>& rows, std::size_t p) {
  std::vector<Real> values;
  for (const auto& row : rows) values.push_back(std::stod(row[p]));
  return values;
}

TEST(Correlation, OfRanksIsTheOneThatIsAskedFor) {
  constexpr Index runs = 4000;
  for (const Sampling sampling : {Sampling::monte_carlo, Sampling::latin_hypercube})
    for (const Real rank : {-1.0, -0.6, 0.0, 0.3, 0.9}) {
      SweepSpec spec = one_variable(sampling, runs);
      spec.parameters[0].values = Variable{Variable::Kind::log_normal, 5, 4};
      spec.parameters[1].correlation = Correlation{0, rank};
      const auto rows = sample(spec);
      EXPECT_NEAR(rank_correlation(column(rows, 0), column(rows, 1)), rank, 3 / std::sqrt(runs))
          << rank;
    }
}

TEST(Correlation, LeavesOneValueInEachSlice) {
  constexpr Index runs = 50;
  SweepSpec spec = one_variable(Sampling::latin_hypercube, runs);
  const auto alone = sample(spec);
  spec.parameters[1].correlation = Correlation{0, -0.7};
  const auto rows = sample(spec);
  EXPECT_EQ(column(rows, 0), column(alone, 0));  // the first stays as it is
  std::vector<Real> y = column(rows, 1);
  std::sort(y.begin(), y.end());
  for (Index s = 0; s < runs; ++s) EXPECT_EQ(static_cast<Index>(y[s] * runs), s);
}

SweepSpec sweep_of(const std::string& parameters) {
  return parse_sweep(
      "model = \"m.toml\"\ncommand = \"support\"\nsampling = \"monte_carlo\"\nruns = 3\n" +
          parameters,
      "s.toml");
}

void expect_refused(const std::string& parameters, const std::string& why) {
  try {
    sweep_of(parameters);
    ADD_FAILURE() << "not refused: " << parameters;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(Parameter, MayGiveItsValueToSeveralKeys) {
  const SweepSpec spec = sweep_of(
      "[[parameter]]\nname = \"phi\"\nkeys = [\"joint_material.1.friction_angle\", "
      "\"joint_material.2.friction_angle\"]\nvalues = [30]\n");
  EXPECT_EQ(spec.parameters[0].key, "phi");
  EXPECT_EQ(changes_of(spec.parameters[0], "30"),
            (std::vector<std::string>{"joint_material.1.friction_angle=30",
                                      "joint_material.2.friction_angle=30"}));
  expect_refused("[[parameter]]\nkeys = [1]\nvalues = [30]\n", "must be a list of keys");
  expect_refused("[[parameter]]\nkey = \"a\"\nkeys = [\"b\"]\nvalues = [30]\n", "beside key");
}

TEST(Parameter, TellsOfWrongDistributionsAndCorrelations) {
  const std::string first =
      "[[parameter]]\nkey = \"c\"\ndistribution = \"uniform\"\nmin = 0\nmax = 1\n";
  const std::string second =
      "[[parameter]]\nkey = \"phi\"\ndistribution = \"normal\"\nmean = 30\nstandard_deviation = "
      "2\n";
  EXPECT_EQ(sweep_of(first + second + "correlation = {with = \"c\", rank = -0.5}\n")
                .parameters[1]
                .correlation->rank,
            -0.5);
  expect_refused(first + second + "correlation = {with = \"d\", rank = -0.5}\n",
                 "no parameter with a distribution before this one");
  expect_refused(first + second + "correlation = {with = \"c\", rank = 2}\n",
                 "found 2, must be -1 to 1");
  expect_refused(
      first +
          "[[parameter]]\nkey = \"x\"\nvalues = [1]\ncorrelation = {with = \"c\", rank = 0.5}\n",
      "drawn from a distribution");
  expect_refused(
      "[[parameter]]\nkey = \"x\"\ndistribution = \"triangular\"\nmin = 0\nmax = 1\nmode = 2\n",
      "must lie from min to max");
  expect_refused("[[parameter]]\nkey = \"x\"\ndistribution = \"exponential\"\nmean = 0\n",
                 "above 0, or below");
}

TEST(Expression, IsOfWhatStandsBeforeIt) {
  SweepSpec spec = sweep_of(
      "[[parameter]]\nname = \"c\"\nkey = \"a.c\"\ndistribution = \"uniform\"\nmin = 1\nmax = 2\n"
      "[[parameter]]\nname = \"half\"\nkey = \"a.d\"\nexpression = \"0.5 * c\"\n"
      "[[parameter]]\nkey = \"a.e\"\nexpression = \"sqrt(half) + c^2\"\n");
  for (const auto& row : sample(spec)) {
    const Real c = std::stod(row[0]);
    EXPECT_EQ(std::stod(row[1]), 0.5 * c);
    EXPECT_NEAR(std::stod(row[2]), std::sqrt(0.5 * c) + c * c, 1e-14);
  }
  spec.sampling = Sampling::all;
  spec.parameters[0].values = std::vector<std::string>{"1", "2", "3"};
  const auto rows = sample(spec);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(std::stod(rows[2][1]), 1.5);
}

TEST(Expression, TellsWhatIsWrong) {
  const std::string first = "[[parameter]]\nname = \"depth\"\nkey = \"a\"\nvalues = [1, 2]\n";
  expect_refused(first + "[[parameter]]\nkey = \"b\"\nexpression = \"2 * dept\"\n",
                 "did you mean \"depth\"?");
  expect_refused(first + "[[parameter]]\nkey = \"b\"\nexpression = \"2 * (depth\"\n",
                 "parenthesis");
  expect_refused(
      "[[parameter]]\nname = \"x\"\nkey = \"a\"\nvalues = [\"wet\"]\n[[parameter]]\nkey = "
      "\"b\"\nexpression = \"x\"\n",
      "no parameter with numbers");
  expect_refused(first + "[[parameter]]\nkey = \"b\"\nvalues = [1]\nexpression = \"depth\"\n",
                 "beside values");
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
