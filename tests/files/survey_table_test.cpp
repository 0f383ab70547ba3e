// Tables of surveys: orientations that need no place, and what their other columns say.
#include <cmath>

#include <gtest/gtest.h>

#include "host/files/read_joint_table.hpp"
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

std::vector<JointTable::Row> survey_of(std::string_view text, SurveyColumns& columns,
                                       std::vector<Diagnostic>* warnings = nullptr) {
  return read_survey_table(text, JointTable{}, sample_place, columns, warnings);
}

std::string fault(std::string_view text) {
  SurveyColumns columns;
  const auto errors = errors_of_reading([&] { survey_of(text, columns); });
  return errors.empty() ? "" : errors[0].message;
}

}  // namespace

/// A model's table without places is refused; materials are those of a model.
TEST(SurveyTables, NeedNeitherPlacesNorMaterials) {
  constexpr auto text = "Dip,Dip Direction,Material\n60,135,shale\n30,240,\n";
  SurveyColumns columns;
  const auto rows = survey_of(text, columns);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].orientation.dip, 30);
  EXPECT_EQ(rows[1].orientation.dip_direction, 240);
  EXPECT_TRUE(std::isinf(rows[0].radius));
  EXPECT_FALSE(columns.has_places);
  EXPECT_FALSE(columns.names_sets);
  EXPECT_TRUE(columns.weight.empty());
  EXPECT_FALSE(
      errors_of_reading([&] { read_joint_table(text, JointTable{}, {}, sample_place); }).empty());
}

TEST(SurveyTables, SayWeightsDistancesAndLines) {
  SurveyColumns columns;
  const auto rows = survey_of(
      "Set;Dip;DipDir;Quantity;Distance (ft);Traverse Trend;Traverse Plunge;x;y;z\n"
      "A;60;135;2;10;90;-5;1;2;3\nB;30;240;0.5;20;0;85;4;5;6\n",
      columns);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_TRUE(columns.has_places);
  EXPECT_TRUE(columns.names_sets);
  EXPECT_EQ(columns.name_heading, "Set");
  EXPECT_EQ(columns.weight, (std::vector<Real>{2, 0.5}));
  EXPECT_NEAR(columns.distance[1], 6.096, 1e-12);
  EXPECT_EQ(columns.line_trend, (std::vector<Real>{90, 0}));
  EXPECT_EQ(columns.line_plunge, (std::vector<Real>{-5, 85}));
  EXPECT_EQ(rows[1].center, (Vec3{4, 5, 6}));
}

/// Numbers of joints are no sets.
TEST(SurveyTables, KnowSetsFromNamesOfJoints) {
  for (const auto* name : {"Joint", "ID", "Type"}) {
    SurveyColumns columns;
    survey_of(std::string(name) + ",dip,dip_direction\nJ1,60,135\n", columns);
    EXPECT_FALSE(columns.names_sets) << name;
    EXPECT_EQ(columns.name_heading, name);
  }
}

/// Nothing is placed, so nothing is told of discs, and a persistence may be a share.
TEST(SurveyTables, TellNothingOfExtents) {
  SurveyColumns columns;
  std::vector<Diagnostic> warnings;
  const auto rows =
      survey_of("dip,dip_direction,trace_length\n60,135,4\n30,240,\n", columns, &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(rows[0].radius, 2);
  EXPECT_TRUE(std::isinf(rows[1].radius));
  EXPECT_EQ(fault("dip,dip_direction,persistence (%)\n60,135,90\n"), "");
}

TEST(SurveyTables, ThatAreWrongSayWhy) {
  EXPECT_EQ(fault("dip,x,y,z\n60,1,2,3\n"), "the heading has no column dip_direction");
  EXPECT_EQ(fault("dip,dip_direction,scanline_trend\n60,135,90\n"),
            "a scanline has a trend and a plunge: there is a column of one of them alone");
  EXPECT_NE(fault("dip,dip_direction,weight\n60,135,0\n").find("weight must be > 0"),
            std::string::npos);
  EXPECT_NE(fault("dip,dip_direction,scanline_trend,scanline_plunge\n60,135,90,95\n")
                .find("scanline_plunge must be -90 to 90 (deg)"),
            std::string::npos);
}

}  // namespace rockfold
