#include <cmath>

#include "host/files/read_joint_table.hpp"
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

const std::vector<JointMaterial> materials = named_materials({"clean", "clay; \"soft\"", "rough"});

std::vector<JointTable::Row> rows_of(std::string_view text,
                                     std::vector<Diagnostic>* warnings = nullptr,
                                     bool left_hand = false) {
  JointTable table;
  table.material = 2;
  table.left_hand = left_hand;
  return read_joint_table(text, table, materials, sample_place, warnings);
}

}  // namespace

TEST(JointTables, AreReadByTheNamesOfTheirColumns) {
  const auto rows = rows_of(
      "# mapped in 2019\n\nx,y,z,Dip,dip_direction,radius\n1.5, -2,3e1 ,45,120,2.5\n\n# a "
      "fault\n0,0,0,90,360,\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].orientation.dip, 45);
  EXPECT_EQ(rows[0].orientation.dip_direction, 120);
  EXPECT_EQ(rows[0].center, (Vec3{1.5, -2, 30}));
  EXPECT_EQ(rows[0].radius, 2.5);
  EXPECT_EQ(rows[0].material, 2);
  EXPECT_TRUE(std::isinf(rows[1].radius));
}

TEST(JointTables, MayUseSemicolonsQuotesAndOtherLineEnds) {
  const auto rows = rows_of(
      "\xEF\xBB\xBF\"dip\";\"dip_direction\";x;y;z;radius;material\r\n"
      "10;20;1;2;3;4;\"clay; \"\"soft\"\"\"\r\n10;20;1;2;3;\"4\"; \"clean\" "
      "\r\n10;20;1;2;3;4;\r\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].material, 1);
  EXPECT_EQ(rows[1].material, 0);
  EXPECT_EQ(rows[2].material, 2);
}

TEST(JointTables, MayUseTabs) {
  const auto rows = rows_of(
      "dip\tdip_direction\tx\ty\tz\tradius\tmaterial\n10\t20\t1\t2\t3\t4\trough\n"
      "10\t20\t1\t 2\t3\t\t\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].center, (Vec3{1, 2, 3}));
  EXPECT_EQ(rows[0].radius, 4);
  EXPECT_EQ(rows[1].center, (Vec3{1, 2, 3}));
  EXPECT_TRUE(std::isinf(rows[1].radius));
  EXPECT_EQ(rows[1].material, 2);
}

TEST(JointTables, MayHaveTheColumnsOfOtherPrograms) {
  std::vector<Diagnostic> warnings;
  const auto facets = rows_of(
      "Index; CenterX; CenterY; CenterZ; NormalX; RMS; Dip dir.; Dip (deg); Family ind.\n"
      "0; 5.0; 6; 7; 0.5; 0.01; 90; 30; 1\n",
      &warnings);
  ASSERT_EQ(facets.size(), 1u);
  EXPECT_EQ(facets[0].orientation.dip, 30);
  EXPECT_EQ(facets[0].orientation.dip_direction, 90);
  EXPECT_EQ(facets[0].center, (Vec3{5, 6, 7}));
  EXPECT_TRUE(std::isinf(facets[0].radius));
  const auto orientations =
      rows_of("X,Y,Z,azimuth,dip,polarity,radius\n5,5,5,90,30,1,2\n", &warnings);
  EXPECT_EQ(orientations[0].orientation.dip_direction, 90);
  rows_of("id,dip,dip_direction,strike,easting,northing,elevation,radius,\n1,30,90,0,5,5,5,2,\n",
          &warnings);
  rows_of("dip,dip_direction,x,y,z,radius\n30,90,5,5,5,\n", &warnings);  // says nothing
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings[0].place.line, 1);
  EXPECT_EQ(warnings[0].message,
            "4 columns are passed over: Index, NormalX, RMS, Family ind.; "
            "without a column radius or diameter all joints are through-going");
  EXPECT_EQ(warnings[1].message,
            "a column is passed over: polarity; azimuth is taken for dip_direction");
  EXPECT_EQ(warnings[2].message, "2 columns are passed over: id, strike");
}

TEST(JointTables, MayHaveDiameters) {
  std::vector<Diagnostic> warnings;
  const auto rows =
      rows_of("Dip,Dip Dir.,X,Y,Z,Diameter [m]\n30,90,5,5,5,3\n30,90,5,5,5,\n", &warnings);
  EXPECT_EQ(rows[0].radius, 1.5);
  EXPECT_TRUE(std::isinf(rows[1].radius));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].message, "half of diameter is taken for radius");
  EXPECT_EQ(
      rows_of("dip,dip_direction,x,y,z,radius,diameter\n30,90,5,5,5,1,9\n", &warnings)[0].radius,
      1);
}

TEST(JointTables, MayHaveStrikes) {
  const std::string text = "strike;dip;x;y;z;radius\n30;30;5;5;5;\n300.5;30;5;5;5;1\n";
  std::vector<Diagnostic> warnings;
  const auto right = rows_of(text, &warnings), left = rows_of(text, &warnings, true);
  EXPECT_EQ(right[0].orientation.dip_direction, 120);
  EXPECT_EQ(right[1].orientation.dip_direction, 30.5);
  EXPECT_EQ(left[0].orientation.dip_direction, 300);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].message, "planes dip to the right of their strike (rule)");
  EXPECT_EQ(warnings[1].message, "planes dip to the left of their strike (rule)");
}

TEST(JointTables, MayHaveDecimalCommasWhereNoCommaPartsTheirFields) {
  for (const char separator : {';', '\t'}) {
    std::string text = "dip;dip_direction;x;y;z;radius\n50,5;120;-0,25;10;0,5;1,5\n";
    std::replace(text.begin(), text.end(), ';', separator);
    std::vector<Diagnostic> warnings;
    const auto rows = rows_of(text, &warnings);
    EXPECT_EQ(rows[0].orientation.dip, 50.5);
    EXPECT_EQ(rows[0].center, (Vec3{-0.25, 10, 0.5}));
    EXPECT_EQ(rows[0].radius, 1.5);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].place.line, 2);
    EXPECT_EQ(warnings[0].message, "decimals are taken to stand behind commas, as in 50,5");
  }
}

TEST(JointTables, WithoutAHeadingGiveOneError) {
  const auto errors = errors_of_reading([] { rows_of("45,120,0,0,0,1\n46,120,0,0,0,1\n"); });
  EXPECT_EQ(errors.size(), 1u);
}

TEST(JointTables, ThatAreWrongSayWhereAndWhy) {
  struct Wrong {
    std::string text;
    int line, column;
    const char* says;
  };
  const std::string head = "dip,dip_direction,x,y,z,radius,material\n";
  const Wrong cases[] = {
      {"# nothing\n\n", 0, 0, "must begin with a heading"},
      {"dip,dip_direction,x,y,z,radius\n", 0, 0, "no joints"},
      {"dip,trend,x,y,z,radius\n", 1, 0, "no column dip_direction"},
      {"dip,dip dir.,azimuth,x,y,z,radius\n", 1, 14, "two columns dip_direction"},
      {"dip,dip_direction,x,y,z,radus\n", 1, 25,
       "unknown column 'radus', did you mean \"radius\"?"},
      {"dip,dip_drection,x,y,z,radius\n", 1, 5, "did you mean \"dip_direction\"?"},
      {"dip,dip,dip_direction,x,y,z,radius\n", 1, 5, "two columns dip"},
      {"dip,x,y\n", 1, 0, "no column dip_direction, z"},
      {"45,120,0,0,0,1\n46,120,0,0,0,1\n", 1, 0,
       "holds numbers, must be a heading: dip, dip_direction, x"},
      {"45;120;0,5;0;0;1;clean\n", 1, 0, "holds numbers, must be a heading"},
      {"dip;dip_direction;x;y;z;radius\n50,5;120;0;0;0.25;1\n", 2, 1,
       "behind a comma in 50,5, behind a point in 0.25 (line 2): must be alike in a table"},
      {head + "45,120,0,0,0,1.5,\n46,120,\"0,5\",0,0,1,\n", 3, 8,
       "is '0,5'; decimals stand behind a point: 0.5, not 0,5 (a decimal comma)"},
      {head + "45,120,0,0,0\n", 2, 0, "has 5 fields, the heading 7"},
      {head + "45,120,0,0,0,1,clean,7\n", 2, 0, "has 8 fields, the heading 7"},
      {head + "91,120,0,0,0,1,\n", 2, 1, "dip must be 0 to 90 (deg), is 91"},
      {head + "45,-1,0,0,0,1,\n", 2, 4, "dip_direction must be 0 to 360 (deg), is -1"},
      {head + "45,120,0,0,0,0,\n", 2, 14, "radius must be > 0 (m), is 0"},
      {head + "45,120,0,0,0,inf,\n", 2, 14, "radius must be a finite number, > 0 (m), is inf"},
      {head + "45,120,0,0,0,-2,\n", 2, 14, "radius must be > 0 (m), is -2"},
      {head + "nan,120,0,0,0,1,\n", 2, 1, "dip must be a finite number"},
      {head + "45,120,,0,0,1,\n", 2, 8, "x must be a number (m), is ''"},
      {head + "45,120,0,1e10,0,1,\n", 2, 10, "y must be at most 1e9 in size (m), is 1e+10"},
      {head + "4 5,120,0,0,0,1,\n", 2, 1, "is '4 5'"},
      {head + "45,120,0,0,0,1,claen\n", 2, 16,
       "no joint material is called 'claen', did you mean \"clean\"?"},
      {head + "45,120,0,0,0,1,\"clean\n", 2, 16, "must end with its quote"},
      {head + "45,120,0,0,0,1,\"cl\"ean\n", 2, 16, "must end with its quote"},
  };
  for (const auto& wrong : cases) {
    const auto errors = errors_of_reading([&] { rows_of(wrong.text); });
    ASSERT_FALSE(errors.empty()) << wrong.text;
    EXPECT_EQ(errors[0].place.line, wrong.line) << listed(errors);
    EXPECT_EQ(errors[0].place.column, wrong.column) << listed(errors);
    EXPECT_NE(errors[0].message.find(wrong.says), std::string::npos) << listed(errors);
  }
}

TEST(JointTables, TellAllWrongLinesAtOnce) {
  std::string text = "dip,dip_direction,x,y,z,radius\n";
  for (int i = 0; i < 30; ++i) text += "95,0,0,0,0,1\n";
  const auto errors = errors_of_reading([&] { rows_of(text); });
  ASSERT_EQ(errors.size(), 21u);
  EXPECT_EQ(errors[19].place.line, 21);
  EXPECT_EQ(errors[20].message, "10 more errors");
}

}  // namespace rockfold
