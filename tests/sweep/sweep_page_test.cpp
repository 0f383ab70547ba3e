// What the report of a sweep draws.
#include "src/sweep/sweep_page.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

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

TEST(Histogram, HasABarForEachClassThatHoldsARun) {
  EXPECT_EQ(histogram_svg("nothing", {none_there}), "");
  EXPECT_EQ(count_of(histogram_svg("one", {3, 3, 3}), "#4477aa"), 1U);
  EXPECT_EQ(count_of(histogram_svg("ends", {0, 0, 0, 4, none_there}), "#4477aa"), 2U);
}

TEST(Tornado, HasTwoBarsAParameter) {
  EXPECT_EQ(tornado_svg("y", {}, 1), "");
  const auto svg = tornado_svg("y", {{"a", 1, 3, 1}, {"b", 2, 1, -0.5}}, 2);
  EXPECT_EQ(count_of(svg, "#4477aa"), 2U);
  EXPECT_EQ(count_of(svg, "#ee7733"), 2U);
  EXPECT_EQ(count_of(svg, "r -0.50"), 1U);
}

}  // namespace
}  // namespace rockfold::sweep
