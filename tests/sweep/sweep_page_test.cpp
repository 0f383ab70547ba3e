// What the report of a sweep draws.
#include "src/sweep/sweep_page.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "src/report/drawings/svg.hpp"

namespace rockfold::sweep {
namespace {

constexpr Real none_there = std::numeric_limits<Real>::quiet_NaN();

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Nine runs: y = 10 a + b, a = 1 … 9, b = 4, 1, 3, 1, 5, 9, 2, 6, 5; run 10 failed.
struct TenRuns {
  SweepSpec spec;
  std::vector<std::vector<std::string>> values;
  std::vector<RunRecord> rows;

  TenRuns() {
    for (const char* key : {"a", "b", "same"})
      spec.parameters.push_back({key, std::vector<std::string>{}});
    spec.results.push_back({"y", "y"});
    const int b[] = {4, 1, 3, 1, 5, 9, 2, 6, 5, 3};
    for (int i = 0; i < 10; ++i) {
      values.push_back({std::to_string(i + 1), std::to_string(b[i]), "7"});
      RunRecord row{i + 1, i < 9 ? "done" : "failed", 1, "", {}};
      if (i < 9) row.results.push_back(std::to_string(10 * (i + 1) + b[i]));
      rows.push_back(row);
    }
  }
};

TEST(Swings, AreMeansOverTheLowestAndTheHighestThird) {
  const TenRuns runs;
  const SweepTable table{runs.spec, runs.values, runs.rows};
  const auto all = swings(table, "y");
  ASSERT_EQ(all.size(), 2U) << "what does not vary has no swing";
  EXPECT_EQ(all[0].parameter, "a");
  EXPECT_DOUBLE_EQ(all[0].low, (14 + 21 + 33) / 3.0);
  EXPECT_DOUBLE_EQ(all[0].high, (72 + 86 + 95) / 3.0);
  EXPECT_EQ(all[1].parameter, "b");
  EXPECT_DOUBLE_EQ(all[1].low, (21 + 41 + 72) / 3.0);        // b ≤ 2
  EXPECT_DOUBLE_EQ(all[1].high, (55 + 69 + 86 + 95) / 4.0);  // b ≥ 5, a tie
  EXPECT_NEAR(all[0].rank_correlation, 1, 0.05);
}

TEST(Swings, AreNoneOfSeeds) {
  TenRuns runs;
  runs.spec.parameters[0].key = "joint_set.north.random.seed";
  const SweepTable table{runs.spec, runs.values, runs.rows};
  const auto all = swings(table, "y");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].parameter, "b");
}

TEST(Histogram, HasABarForEachClassThatHoldsARun) {
  EXPECT_EQ(histogram_svg({"nothing", "", {none_there}}), "");
  EXPECT_EQ(count_of(histogram_svg({"one", "", {3, 3, 3}}), "#4477aa"), 1U);
  EXPECT_EQ(count_of(histogram_svg({"a fraction", "", {0.3, 0.3}}), "#4477aa"), 1U);
  EXPECT_EQ(count_of(histogram_svg({"ends", "", {0, 0, 0, 4, none_there}}), "#4477aa"), 2U);
}

TEST(Histogram, OfWholeNumbersHasAClassForEach) {
  EXPECT_EQ(count_of(histogram_svg({"blocks", "", {0, 1, 2, 3, 3, 7}}), "#4477aa"), 5U);
}

/// Half of the results are alike, as forces are where most runs need none: their quartiles do not tell how wide a class is.
TEST(Histogram, TellsTheScatterBesideManyThatAreAlike) {
  std::vector<Real> values(100, 0.0);
  for (int i = 0; i < 24; ++i) values.push_back(i + 0.5);
  EXPECT_GE(count_of(histogram_svg({"force", "N", values}), "#4477aa"), 8U);
}

/// The points of the curve as "x y" of its path: from the left end at 0 % to the right end at 100 %.
std::vector<Point2> curve_in(const std::string& svg) {
  std::vector<Point2> points;
  const auto end = svg.find("\" stroke-linejoin=\"round\" fill=\"none\" stroke=\"#4477aa\"");
  const auto begin = svg.rfind('M', end);
  std::istringstream path(svg.substr(begin, end - begin));
  char letter = 0;
  Point2 point{};
  while (path >> letter >> point[0] >> point[1]) points.push_back(point);
  return points;
}

TEST(CumulatedCurve, StepsByTheShareOfEachRun) {
  const auto curve = curve_in(cumulated_svg({"f", "", {0, 4, 4, 2.5, none_there}}));
  ASSERT_EQ(curve.size(), 8U);  // the start, two a value, the end
  const Real zero = curve.front()[1], whole = curve.back()[1];
  const auto share = [&](std::size_t i) { return (zero - curve[i][1]) / (zero - whole); };
  EXPECT_NEAR(share(2), 0.25, 1e-3);
  EXPECT_NEAR(share(4), 0.5, 1e-3);
  EXPECT_NEAR(share(6), 1, 1e-3);
  EXPECT_EQ(curve[3][0], curve[4][0]) << "a step is upright";
  EXPECT_NEAR((curve[4][0] - curve[2][0]) / (curve[6][0] - curve[2][0]), 2.5 / 4, 1e-3);
}

TEST(CumulatedCurve, MarksMedianAndTails) {
  std::vector<Real> values;
  for (int i = 0; i <= 100; ++i) values.push_back(i * 1e4);
  const std::string svg = cumulated_svg({"force", "N", values});
  for (const char* words : {"5 %: 0.05 MN", "50 %: 0.5 MN", "95 %: 0.95 MN", ">force, MN<"})
    EXPECT_EQ(count_of(svg, words), 1U) << words;
  EXPECT_EQ(cumulated_svg({"nothing", "", {none_there}}), "");
}

TEST(CumulatedCurve, OfManyRunsHasNoMorePointsThanThePaperShows) {
  std::vector<Real> values;
  for (int i = 0; i < 100'000; ++i) values.push_back(std::sin(i));
  const auto curve = curve_in(cumulated_svg({"sine", "", values}));
  EXPECT_LT(curve.size(), 9000U);
  EXPECT_GT(curve.size(), 600U);
}

TEST(Marks, StandWhereEventsCompareAndInsideThePlotAlone) {
  const ResultPlot plot{"FS", "", {0.5, 1.5, 2.5}, {{"fails", "<", 1}, {"far", ">", 9}}};
  for (const std::string& svg : {histogram_svg(plot), cumulated_svg(plot)}) {
    EXPECT_EQ(count_of(svg, "fails: &lt; 1"), 1U);
    EXPECT_EQ(count_of(svg, "far"), 0U);
  }
}

TEST(Units, FollowFromTheKeysOfDocuments) {
  EXPECT_EQ(unit_at("totals.support_force"), "N");
  EXPECT_EQ(unit_at("totals.listed.volume"), "m³");
  EXPECT_EQ(unit_at("monitors.crest.displacement.-1.2"), "m");
  EXPECT_EQ(unit_at("rest.largest_slip.value"), "m");
  EXPECT_EQ(unit_at("energy.friction"), "J");
  EXPECT_EQ(unit_at("keyblocks.0.mobilisation.force"), "");
  EXPECT_EQ(unit_at("totals.keyblocks"), "");
  EXPECT_EQ(unit_at("totals.least_factor_of_safety"), "");
  EXPECT_EQ(unit_at(""), "");
}

TEST(Tornado, HasTwoBarsAParameter) {
  EXPECT_EQ(tornado_svg("y", "", {}, 1), "");
  const auto svg = tornado_svg("y", "", {{"a", 1, 3, 1}, {"b", 2, 1, -0.5}}, 2);
  EXPECT_EQ(count_of(svg, "#4477aa"), 2U);
  EXPECT_EQ(count_of(svg, "#ee7733"), 2U);
  EXPECT_EQ(count_of(svg, "r -0.50"), 1U);
}

}  // namespace
}  // namespace rockfold::sweep
