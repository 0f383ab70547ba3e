// What a survey says of sets: weights, spacings, the table's own sets.
#include "host/survey/joint_sets.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/survey/sampled_poles.hpp"

namespace rockfold {

namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();

void add_row(Survey& survey, const std::string& set, Real dip, Real dip_direction) {
  JointTable::Row row;
  row.orientation = {dip, dip_direction};
  row.radius = infinite;
  row.name = set;
  survey.rows.push_back(row);
}

/// Of a table with a column "set".
Survey named_survey() {
  Survey survey;
  survey.columns.names_sets = true;
  survey.columns.name_heading = "Set";
  return survey;
}

const LineDirection east{90, 0};

}  // namespace

/// A line to the east crosses planes across it (dip direction 090) twice as often as planes at 60° to that (dip direction 030).
TEST(TerzaghisWeights, GiveSetsTheirTrueShares) {
  Survey survey = named_survey();
  for (int i = 0; i < 60; ++i) add_row(survey, "across", 90, 90);
  for (int i = 0; i < 30; ++i) add_row(survey, "askew", 90, 30);
  const SurveyReport seen = find_joint_sets(survey, {});
  EXPECT_NEAR(seen.sets[0].share, 2.0 / 3, 1e-12);
  const SurveyReport report = find_joint_sets(survey, {.scanline = east});
  EXPECT_NEAR(report.weight[0], 1, 1e-12);
  EXPECT_NEAR(report.weight[60], 2, 1e-12);
  EXPECT_NEAR(report.sets[0].share, 0.5, 1e-12);
  EXPECT_NEAR(report.sets[1].share, 0.5, 1e-12);
  EXPECT_NEAR(report.effective_count, 120.0 * 120 / 180, 1e-9);
  EXPECT_EQ(report.blind, 0);
}

/// Planes at 10° to the line are weighed as if at 15°, or as the user says: 1/sin 15° = 3.863703, 1/sin 20° = 2.923804.
TEST(TerzaghisWeights, AreLimitedInTheBlindZone) {
  Survey survey = named_survey();
  add_row(survey, "a", 90, 10);
  add_row(survey, "a", 90, 20);
  const SurveyReport usual = find_joint_sets(survey, {.scanline = east});
  EXPECT_NEAR(usual.weight[0], 3.8637033, 1e-6);
  EXPECT_NEAR(usual.weight[1], 2.9238044, 1e-6);
  EXPECT_EQ(usual.blind, 1);
  const SurveyReport wide = find_joint_sets(survey, {.scanline = east, .blind_zone = 25});
  EXPECT_NEAR(wide.weight[0], 1 / std::sin(25 * degree), 1e-12);
  EXPECT_EQ(wide.blind, 2);
}

/// Each row has its own line; what the table's weights say is multiplied.
TEST(TerzaghisWeights, ComeFromColumnsToo) {
  Survey survey = named_survey();
  add_row(survey, "a", 90, 60);
  add_row(survey, "a", 0, 0);
  survey.columns.line_trend = {90, 0};
  survey.columns.line_plunge = {0, 45};
  survey.columns.weight = {3, 1};
  const SurveyReport report = find_joint_sets(survey, {});
  EXPECT_NEAR(report.weight[0], 3 / std::cos(30 * degree), 1e-12);
  EXPECT_NEAR(report.weight[1], 1 / std::cos(45 * degree), 1e-12);
  EXPECT_EQ(report.lines.size(), 2u);
}

/// Planes that dip to 030, 2 m apart along their normal, are 4 m apart on a line to the east. Told by distances, or by places.
TEST(Spacings, AreThoseAlongTheNormal) {
  for (const bool by_places : {false, true}) {
    Survey survey = named_survey();
    for (const Real distance : {17.0, 1.0, 5.0, 9.0, 13.0}) {
      add_row(survey, "askew", 90, 30);
      if (by_places)
        survey.rows.back().center = {distance + 100, 7, -3};
      else
        survey.columns.distance.push_back(distance);
    }
    survey.columns.has_places = by_places;
    const auto spacing = find_joint_sets(survey, {.scanline = east}).sets[0].spacing;
    ASSERT_TRUE(spacing);
    EXPECT_EQ(spacing->intervals, 4);
    EXPECT_NEAR(spacing->along, 4, 1e-12);
    EXPECT_NEAR(spacing->normal, 2, 1e-12);
    EXPECT_FALSE(spacing->blind);
  }
}

/// Lines to the east and to the north-east: 3 intervals of 4 m and 2 of 2 m/cos 15° make 10 m of normal for 5 intervals.
TEST(Spacings, OfSeveralLinesAreOneMean) {
  Survey survey = named_survey();
  for (int i = 0; i < 7; ++i) add_row(survey, "askew", 90, 30);
  survey.columns.line_trend = {90, 90, 90, 90, 45, 45, 45};
  survey.columns.line_plunge.assign(7, 0);
  const Real step = 2 / std::cos(15 * degree);
  survey.columns.distance = {0, 4, 8, 12, 50, 50 + step, 50 + 2 * step};
  const auto spacing = find_joint_sets(survey, {}).sets[0].spacing;
  ASSERT_TRUE(spacing);
  EXPECT_EQ(spacing->intervals, 5);
  EXPECT_NEAR(spacing->normal, 2, 1e-12);
}

TEST(Spacings, AreNotToldWhereTheyCannotBeKnown) {
  Survey survey = named_survey();
  add_row(survey, "a", 60, 90);
  add_row(survey, "a", 60, 90);
  add_row(survey, "b", 60, 90);
  EXPECT_FALSE(find_joint_sets(survey, {.scanline = east}).sets[0].spacing);
  survey.columns.distance = {1, 3, 5};
  const SurveyReport report = find_joint_sets(survey, {});
  EXPECT_NEAR(report.sets[0].spacing->along, 2, 1e-12);
  EXPECT_TRUE(std::isnan(report.sets[0].spacing->normal));
  EXPECT_FALSE(report.sets[1].spacing);  // one joint has no neighbour
  EXPECT_TRUE(find_joint_sets(survey, {.scanline = LineDirection{0, 0}}).sets[0].spacing->blind);
}

/// In the order in which the table names them; rows without a name belong to none.
TEST(OwnSets, AreTakenAsTheyAre) {
  Survey survey = named_survey();
  add_row(survey, "B", 80, 10);
  add_row(survey, "", 5, 200);
  add_row(survey, "A", 30, 100);
  add_row(survey, "B", 80, 190);  // 20° from the first: across the vertical
  survey.rows[2].radius = 1.5;
  const SurveyReport report = find_joint_sets(survey, {});
  ASSERT_TRUE(report.by_column);
  ASSERT_EQ(report.sets.size(), 2u);
  EXPECT_EQ(report.sets[0].name, "B");
  EXPECT_EQ(report.set_of_row, (std::vector<Index>{0, none, 1, 0}));
  EXPECT_NEAR(report.sets[0].dip, 90, 1e-9);
  EXPECT_NEAR(report.sets[0].most_cone, cone_of_share(report.sets[0].fisher.kappa, 0.95), 1e-12);
  EXPECT_NEAR(report.background, 0.25, 1e-12);
  EXPECT_EQ(report.sets[0].extents, 0);
  EXPECT_EQ(report.sets[1].extents, 1);
  EXPECT_NEAR(report.sets[1].mean_extent, 3, 1e-12);
  EXPECT_FALSE(find_joint_sets(survey, {.own_sets = false}).by_column);
}

/// Rows go to what they most probably are, and the largest set comes first.
TEST(FoundSets, HaveTheirRows) {
  PoleSampler sampler(2);
  Survey survey;
  for (int i = 0; i < 60; ++i) {
    const Vec3 pole = sampler.fisher(i % 3 == 0 ? normal_of(20, 90) : normal_of(75, 200), 60);
    const Vec3 up = pole[2] < 0 ? -pole : pole;
    add_row(survey, "J" + std::to_string(i), std::acos(up[2]) / degree,
            std::fmod(std::atan2(up[0], up[1]) / degree + 360, 360));
  }
  const SurveyReport report = find_joint_sets(survey, {});
  ASSERT_EQ(report.sets.size(), 2u);
  EXPECT_EQ(report.sets[0].name, "set1");
  EXPECT_EQ(report.sets[0].count, 40);
  EXPECT_EQ(report.sets[1].count, 20);
  for (std::size_t i = 0; i < 60; ++i) EXPECT_EQ(report.set_of_row[i], i % 3 == 0 ? 1 : 0);
  // Beyond 1.6 cones lie 0.05^(1.6²), 5 of 10,000.
  EXPECT_LT(angle_between_axes(report.sets[0].fisher.mean, normal_of(75, 200)),
            1.6 * report.sets[0].fisher.confidence_cone);
}

}  // namespace rockfold
