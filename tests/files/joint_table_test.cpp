#include <cmath>

#include "host/files/read_joint_table.hpp"
#include "src/base/vector.hpp"
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

std::vector<JointTable::Row> through_going(std::string_view text) {
  JointTable table;
  table.extent = JointTable::Extent::through_going;
  return read_joint_table(text, table, materials, sample_place);
}

/// What the one warning of reading the text says; "" if there is none.
std::string told(std::string_view text) {
  std::vector<Diagnostic> warnings;
  rows_of(text, &warnings);
  EXPECT_LE(warnings.size(), 1u);
  return warnings.empty() ? "" : warnings[0].message;
}

std::string fault(std::string_view text) {
  const auto errors = errors_of_reading([&] { rows_of(text); });
  return errors.empty() ? "" : errors[0].message;
}

/// Two joints as planes: dip 60 towards 135 through (5, 5, 5), dip 30 towards 240 through (4, 5, 6).
void expect_two_joints(const std::vector<JointTable::Row>& rows, Real tolerance) {
  ASSERT_EQ(rows.size(), 2u);
  const DipOrientation wanted[] = {{60, 135}, {30, 240}};
  const Vec3 through[] = {{5, 5, 5}, {4, 5, 6}};
  constexpr Real degree = 0.017453292519943295;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(rows[i].orientation.dip, wanted[i].dip, tolerance);
    EXPECT_NEAR(rows[i].orientation.dip_direction, wanted[i].dip_direction, tolerance);
    const Real dip = wanted[i].dip * degree, direction = wanted[i].dip_direction * degree;
    const Vec3 normal{std::sin(dip) * std::sin(direction), std::sin(dip) * std::cos(direction),
                      std::cos(dip)};
    EXPECT_NEAR(dot(normal, rows[i].center - through[i]), 0, 20 * tolerance);
    EXPECT_TRUE(std::isinf(rows[i].radius));
  }
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
  EXPECT_EQ(warnings[2].message, "a column is passed over: strike");  // id names the joint
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

TEST(JointTables, ReadPersistencesTraceLengthsAndExtentsAsDiametersOfDiscs) {
  const std::string head = "Dip,DipDir,X,Y,Z,";
  for (const char* name : {"Persistence (m)", "Trace length", "Trace Length [m]", "Length (m)",
                           "extent", "Persistence", "Spurl\xC3\xA4nge (m)"}) {
    const std::string text = head + name + "\n60,135,5,5,5,4\n30,240,4,5,6,\n";
    EXPECT_EQ(rows_of(text)[0].radius, 2) << name;
    EXPECT_TRUE(std::isinf(rows_of(text)[1].radius)) << name;
    EXPECT_EQ(told(text), std::string(name) +
                              " is taken for the diameter of discs (m); extents = "
                              "\"through_going\" takes all joints as through-going; 1 row without "
                              "it is through-going");
    EXPECT_TRUE(std::isinf(through_going(text)[0].radius)) << name;
  }
  EXPECT_EQ(rows_of(head + "Trace length (cm)\n60,135,5,5,5,400\n")[0].radius, 2);
  EXPECT_EQ(rows_of(head + "Persistence\n(deg),(deg),(m),(m),(m),(m)\n60,135,5,5,5,4\n")[0].radius,
            2);
  EXPECT_TRUE(std::isinf(through_going(head + "radius\n60,135,5,5,5,1\n")[0].radius));
}

TEST(JointTables, TakeOneOfSeveralExtentsAndNameTheOthers) {
  const std::string text =
      "Set,Dip,DipDir,X,Y,Z,Persistence (m),Trace length\nJ1,60,135,5,5,5,4,3\n";
  EXPECT_EQ(rows_of(text)[0].radius, 2);
  EXPECT_EQ(told(text).substr(0, 68),
            "a column is passed over: Trace length; Persistence (m) is taken for ");
  const std::string share = "Dip,DipDir,X,Y,Z,Persistence (%),Trace length\n60,135,5,5,5,80,3\n";
  EXPECT_EQ(rows_of(share)[0].radius, 1.5) << "a share is no extent beside a length";
}

TEST(JointTables, AskWhereAPersistenceIsAShare) {
  for (const char* column :
       {"Persistence (%)\n60,135,5,5,5,80\n", "Persistence [%]\n60,135,5,5,5,0.8\n",
        "Persistence\n60,135,5,5,5,0.8\n30,135,5,5,5,1\n",
        "Persistence\n,,,,,%\n60,135,5,5,5,80\n"}) {
    const std::string text = std::string("Dip,DipDir,X,Y,Z,") + column;
    EXPECT_NE(fault(text).find("is a share of the plane, not an extent in metres"),
              std::string::npos)
        << column << fault(text);
    EXPECT_NE(fault(text).find("extents = \"through_going\""), std::string::npos);
    EXPECT_TRUE(std::isinf(through_going(text)[0].radius));
  }
}

TEST(JointTables, NameTheirJoints) {
  const std::string text =
      "ID,Set,dip,dip_direction,x,y,z,radius\n7,J1,30,90,5,5,5,1\n8,,30,90,5,5,5,1\n";
  EXPECT_EQ(rows_of(text)[0].name, "J1");
  EXPECT_EQ(rows_of(text)[1].name, "");
  EXPECT_EQ(told(text), "a column is passed over: ID");
  for (const char* column : {"Set", "ID", "Type", "Joint", "Name"}) {
    const std::string one =
        std::string(column) + ",dip,dip_direction,x,y,z,radius\nA,30,90,5,5,5,1\n";
    EXPECT_EQ(rows_of(one)[0].name, "A") << column;
    EXPECT_EQ(told(one), "") << column;
  }
}

TEST(JointTables, MayGiveQuadrants) {
  expect_two_joints(rows_of("x,y,z,strike,dip\n5,5,5,N45E,60SE\n4,5,6,S30E,30SW\n"), 0);
  expect_two_joints(rows_of("x,y,z,Strike/Dip\n5,5,5,N 45\xC2\xB0 E/60 SE\n4,5,6,150/30SW\n"), 0);
  expect_two_joints(rows_of("x,y,z,dip dir,dip\n5,5,5,S45E,60\n4,5,6,S60W,30W\n"), 0);
  EXPECT_EQ(told("x,y,z,radius,strike,dip\n5,5,5,1,N45E,60SE\n"), "") << "no rule is used";
  const std::string head = "x,y,z,strike,dip\n5,5,5,";
  EXPECT_NE(fault(head + "N45E,60\n").find("'N45E' does not say to which side"), std::string::npos);
  EXPECT_NE(fault(head + "N45E,60NE\n").find("lies along the strike"), std::string::npos);
  EXPECT_NE(fault(head + "N95E,60SE\n").find("is 'N95E'"), std::string::npos);
  EXPECT_NE(fault("x,y,z,dip dir,dip\n5,5,5,90,60W\n").find("name two sides"), std::string::npos);
}

TEST(JointTables, MayGiveBothAnglesInOneColumn) {
  expect_two_joints(rows_of("ID,X,Y,Z,Dip/DipDir\n1,5,5,5,60/135\n2,4,5,6,30/240\n"), 0);
  expect_two_joints(rows_of("X,Y,Z,Dip direction / Dip (deg)\n5,5,5,135/60\n4,5,6,240/30\n"), 0);
  EXPECT_NE(fault("X,Y,Z,Dip/DipDir\n5,5,5,60\n").find("two values parted by '/'"),
            std::string::npos);
}

TEST(JointTables, MayGiveNormals) {
  const std::string text =
      "cx,cy,cz,nx,ny,nz\n5,5,5,0.612372,-0.612372,0.500000\n4,5,6,0.866026,0.5,-1.732050\n";
  expect_two_joints(rows_of(text), 1e-4);  // deg: six digits
  const auto upright = rows_of("cx,cy,cz,nx,ny,nz\n0,0,0,-2,0,0\n0,0,0,0,0,3\n0,0,0,1,1,0\n");
  EXPECT_EQ(upright[0].orientation.dip, 90);
  EXPECT_EQ(upright[0].orientation.dip_direction, 270);
  EXPECT_EQ(upright[1].orientation.dip, 0);
  EXPECT_EQ(upright[2].orientation.dip_direction, 45);
  EXPECT_NE(fault("x,y,z,nx,ny,nz\n0,0,0,0,0,0\n").find("length > 0"), std::string::npos);
}

TEST(JointTables, MayGiveUnitsInARow) {
  expect_two_joints(
      rows_of("Dip,DipDir,X,Y,Z\n(deg),(deg),(m),(m),(m)\n60,135,5,5,5\n30,240,4,5,6\n"), 0);
  expect_two_joints(rows_of("Dip;DipDir;X;Y;Z\n\xC2\xB0;\xC2\xB0;cm;cm;cm\n60;135;500;500;500\n"
                            "30;240;400;500;600\n"),
                    1e-12);
}

TEST(JointTables, MayBeInFeetOfSurveysAndInGons) {
  const Real foot = 1200.0 / 3937;
  for (const char* unit : {"usft", "US ft", "ftUS", "US survey ft", "sft", "U.S. Survey Feet"}) {
    const auto rows =
        rows_of(std::string("Dip,DipDir,X,Y,Z,Radius (") + unit + ")\n60,135,5,5,5,3\n");
    EXPECT_DOUBLE_EQ(rows[0].radius, 3 * foot) << unit;
  }
  EXPECT_DOUBLE_EQ(rows_of("Dip;DipDir;X, yd;Y, yd;Z [yd]\n60;135;5;5;5\n")[0].center[2],
                   5 * 0.9144);
  EXPECT_NEAR(rows_of("Dip (grad),DipDir (gon),X,Y,Z\n50,150,5,5,5\n")[0].orientation.dip, 45,
              1e-12);
  EXPECT_EQ(told("Dip (grad),DipDir,X (ft),Y (ft),Z (m AHD),Radius\n50,150,5,5,5,1\n"),
            "Dip (grad) is converted, times 0.9 deg; X (ft), Y (ft) are converted, times 0.3048 m");
  EXPECT_NE(told("Dip,DipDir,X,Y,Z,Persistence (ft)\n60,135,5,5,5,6\n")
                .find("Persistence (ft) is taken for the diameter of discs; "),
            std::string::npos);
}

TEST(JointTables, RefuseUnitsThatAreNotKnown) {
  struct Wrong {
    const char* text;
    int line, column;
    const char* says;
  };
  const Wrong cases[] = {
      {"Dip (mil),DipDir,X,Y,Z\n60,135,5,5,5\n", 1, 1,
       "the unit of 'Dip (mil)' is not known: angles are in deg, \xC2\xB0, rad, gon, grad"},
      {"Dip,DipDir,X,Y,Z,Radius [furlong]\n60,135,5,5,5,1\n", 1, 18,
       "the unit of 'Radius [furlong]' is not known: lengths are in m, "},
      {"Dip;DipDir;X;Y;Z, furlong\n60;135;5;5;5\n", 1, 16, "'Z, furlong' is not known"},
      {"Dip,DipDir,X,Y,Z,Persistence (furlong)\n60,135,5,5,5,0.5\n", 1, 18,
       "'Persistence (furlong)' is not known: lengths"},
      {"Dip,DipDir,X,Y,Z\n(deg),(deg),(m),(chain),(m)\n60,135,5,5,5\n", 2, 17,
       "the unit of '(chain)' is not known"},
  };
  for (const auto& wrong : cases) {
    const auto errors = errors_of_reading([&] { rows_of(wrong.text); });
    ASSERT_EQ(errors.size(), 1u) << wrong.text;
    EXPECT_EQ(errors[0].place.line, wrong.line) << listed(errors);
    EXPECT_EQ(errors[0].place.column, wrong.column) << listed(errors);
    EXPECT_NE(errors[0].message.find(wrong.says), std::string::npos) << listed(errors);
  }
  EXPECT_EQ(fault("Dip,DipDir,Easting (X),Northing (Y),Z,Note (old)\n60,135,5,5,5,a\n"), "");
}

TEST(JointTables, SayWhatToDoWithoutPlacesAndWithoutExtents) {
  EXPECT_NE(fault("Dip,DipDir,Spacing,Set\n60,135,1,J1\n").find("x, y, z: a table is of joints at"),
            std::string::npos);
  for (const char* extent : {">10", "20+", "n/a"})
    EXPECT_NE(fault(std::string("Dip,DipDir,X,Y,Z,Persistence (m)\n60,135,5,5,5,") + extent + "\n")
                  .find("; an empty field is a through-going joint"),
              std::string::npos)
        << extent;
}

TEST(JointTables, TellOfAnglesThatMayBeRadians) {
  const std::string head = "Dip,DipDir,X,Y,Z,radius\n";
  EXPECT_NE(told(head + "0.66,3.05,5,5,5,1\n1.2,1.05,5,5,5,1\n").find("did you mean radians?"),
            std::string::npos);
  for (const char* rows : {"0.66,3.05,5,5,5,1\n1.7,1.05,5,5,5,1\n", "0.66,30,5,5,5,1\n",
                           "1,3,5,5,5,1\n", "0.5,0,5,5,5,1\n", "0.5,N3E,5,5,5,1\n"})
    EXPECT_EQ(told(head + rows), "") << rows;
  EXPECT_EQ(told("Dip (deg),DipDir (deg),X,Y,Z,radius\n0.66,3.05,5,5,5,1\n"), "");
}

/// A x + B y + C z + D = 0: the plane of the first line is 0.612372·(x − y) + 0.5·z = 2.5, through (5, 5, 5).
TEST(JointTables, MayGivePlanesByTheirEquations) {
  const std::string rows =
      "0.612372 -0.612372 0.500000 -2.500000\n-0.433013 -0.250000 0.866025 -2.214102\n";
  expect_two_joints(rows_of(rows), 1e-4);
  expect_two_joints(rows_of("A B C D\n" + rows), 1e-4);
  EXPECT_NE(told(rows).find("planes A x + B y + C z + D = 0"), std::string::npos);
  EXPECT_NE(fault("1 0 0 -2\n3 0 0 -2\n").find("a normal of length 1, have length 3"),
            std::string::npos);
  EXPECT_NE(fault("45 120 10 20\n").find("must be a heading"), std::string::npos);
  const auto tall = rows_of("A;B;C;D\n0;0;2;-10\n");
  EXPECT_EQ(tall[0].center, (Vec3{0, 0, 5}));
}

TEST(JointTables, KnowOtherLanguagesAndRefuseDegreesAsPlaces) {
  const auto rows =
      rows_of("Fallrichtung;Fallwinkel;Rechtswert;Hochwert;H\xC3\xB6he;radius\n135;60;5;6;7;1\n");
  EXPECT_EQ(rows[0].center, (Vec3{5, 6, 7}));
  EXPECT_EQ(rows[0].orientation.dip, 60);
  EXPECT_EQ(rows_of("Buzamiento,Direcci\xC3\xB3n de buzamiento,Este,Norte,Cota,radio\n"
                    "60,135,5,6,7,1\n")[0]
                .center,
            (Vec3{5, 6, 7}));
  EXPECT_NE(fault("dip,dip dir,lat,lon,elevation\n60,135,47.1,8.2,500\n").find("reproject"),
            std::string::npos);
}

TEST(JointTables, MayPartThousands) {
  EXPECT_EQ(rows_of("dip;dip dir;x;y;z;radius\n60;135;412,345.5;5,802,117;1'200;1\n")[0].center,
            (Vec3{412345.5, 5802117, 1200}));
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
      {"dip,dip dir.,azimuth,x,y,z,radius\n", 1, 14,
       "two columns dip_direction: 'dip dir.' and 'azimuth'"},
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
