// Records of acceleration over time.
#include <cmath>

#include <gtest/gtest.h>

#include "host/files/read_record.hpp"

namespace rockfold {
namespace {

const Place place{"quake.csv", 0, 0, "base_acceleration.file"};

std::string fault(std::string_view text, const BaseAcceleration& base = {}) {
  try {
    read_record(text, base, place);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::model);
    const auto& first = error.diagnostics()[0];
    EXPECT_EQ(first.place.file, "quake.csv");
    return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " +
           first.message;
  }
  return "";
}

BaseAcceleration along(const Vec3& direction) {
  BaseAcceleration base;
  base.direction = direction;
  return base;
}

std::string warning(std::string_view text, const BaseAcceleration& base = {}) {
  std::vector<Diagnostic> warnings;
  read_record(text, base, place, &warnings);
  EXPECT_LE(warnings.size(), 1u);
  return warnings.empty() ? "" : warnings[0].message;
}

}  // namespace

TEST(Record, IsReadWithOrWithoutAHeading) {
  for (const char* text :
       {"t, ax, ay, az\n0, 0, 0, 0\n0.01, 1.5, -2, 3e-1\n", "0;0;0;0\r\n0.01;1.5;-2;0.3",
        "# El Centro\n\nT;AX;AY;AZ\n 0 0 0 0\n0.01 1.5 -2 0.3",
        "az,t,ay,ax\n0,0,0,0\n0.3,0.01,-2,1.5\n",
        "Time (s) acc_x (m/s2) acc_y (m/s^2) acc_z (m/s\xC2\xB2)\n0 0 0 0\n0.01 1.5 -2 0.3\n",
        "time;EW;NS;UD;note\n0;0;0;0;a\n0.01;1.5;-2;0.3;b\n"}) {
    const TimeTable table = read_record(text, {}, place);
    EXPECT_EQ(table.time, (std::vector<Real>{0, 0.01})) << text;
    EXPECT_EQ(table.value[1], (Vec3{1.5, -2, 0.3})) << text;
  }
}

TEST(Record, OfOneComponentActsInTheDirectionOfTheModel) {
  for (const char* text :
       {"time, acc\n0, 0\n0.01, 5\n", "0 0\n0.01 5\n", "acc;vel;t\n0;1;0\n5;2;0.01\n"}) {
    const TimeTable table = read_record(text, along({0.6, 0, 0.8}), place);
    EXPECT_EQ(table.time, (std::vector<Real>{0, 0.01})) << text;
    EXPECT_EQ(table.value[1], (Vec3{3, 0, 4})) << text;
    EXPECT_NE(fault(text).find("base_acceleration.direction = [x, y, z]"), std::string::npos);
  }
  EXPECT_NE(fault("t,ax,ay,az\n0,0,0,0\n", along({1, 0, 0})).find("record with one component"),
            std::string::npos);
}

TEST(Record, HasTheUnitsOfItsHeadingOrOfTheModel) {
  for (const char* text :
       {"t (s), a (g)\n0, 0.5\n", "t,a [cm/s2]\n0,490.5\n", "t,acc Gal\n0,490.5\n",
        "t,a\n(s),(g)\n0,0.5\n", "t (ms), a (m/s/s)\n0, 4.905\n"}) {
    EXPECT_NEAR(read_record(text, along({1, 0, 0}), place).value[0][0], 0.5 * 9.81, 1e-12) << text;
    EXPECT_EQ(warning(text, along({1, 0, 0})), "") << text;
  }
  EXPECT_EQ(read_record("t (ms),a\n0,9\n20,9\n", along({1, 0, 0}), place).time[1], 0.02);
  BaseAcceleration base = along({1, 0, 0});
  base.unit = 9.81;
  EXPECT_EQ(read_record("t,a (cm/s2)\n0,0.5\n", base, place).value[0][0], 0.5 * 9.81);
  EXPECT_EQ(fault("t,a (m/s)\n0,1\n", along({1, 0, 0})),
            "1:3: the unit of 'a (m/s)' is not known: accelerations are in m/s2, cm/s2, g");
  EXPECT_EQ(fault("t (d),a (g)\n0,1\n", along({1, 0, 0})),
            "1:1: the unit of 't (d)' is not known: times are in s, ms, min, h");
}

TEST(Record, TellsWhereTheModelContradictsItsUnit) {
  BaseAcceleration base = along({1, 0, 0});
  base.unit = 9.81;
  for (const char* text : {"t,acc (m/s2)\n0,0.3\n", "t,acc\n(s),(m/s2)\n0,0.3\n"})
    EXPECT_NE(warning(text, base)
                  .find("contradicts base_acceleration.unit, which goes before it: "
                        "the largest acceleration is then 0.3 g, by the file 0.0306 g"),
              std::string::npos)
        << warning(text, base);
  for (const char* text : {"t,acc (g)\n0,0.3\n", "t,acc\n0,0.3\n"})
    EXPECT_EQ(warning(text, base), "") << text;
}

/// Strong shaking is 1 to 20 m/s², which is 0.1 to 2 g and 100 to 2,000 gal.
TEST(Record, WithoutAUnitTellsOfASizeThatOtherUnitsHave) {
  const std::string in_g = "0,0,0,0\n0.01,0.35,0,0\n";
  EXPECT_NE(warning(in_g).find("0.35, is 0.036 g: did you mean 0.35 g?"), std::string::npos)
      << warning(in_g);
  EXPECT_NE(warning("0,0,0,0\n0.01,-343,0,0\n").find("did you mean cm/s2?"), std::string::npos);
  EXPECT_EQ(warning("0,0,0,0\n0.01,3.4,0,0\n"), "");
  EXPECT_EQ(warning("0,0,0,0\n0.01,0,0,0\n"), "");
  BaseAcceleration base;
  base.scale = 9.81;
  EXPECT_EQ(warning(in_g, base), "") << "scaled by hand";
  base.scale = 1;
  base.unit = 1;
  EXPECT_EQ(warning(in_g, base), "") << "the model says m/s2";
}

TEST(Record, NamesWhatItTakesForNothing) {
  EXPECT_EQ(warning("t,ax (m/s2),vel\n0,1,2\n"),
            "a column is passed over: vel; without a column ay it is 0; without a column az it is "
            "0");
}

TEST(Record, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(fault(""), "0:0: holds no rows t, ax, ay, az");
  EXPECT_EQ(fault("t,ax,ay,az\n"), "0:0: holds no rows t, ax, ay, az");
  EXPECT_EQ(fault("0,0,0\n"), "1:6: has 3 numbers, must have 4: t, ax, ay, az");
  EXPECT_EQ(fault("0,0,0,0\n0.1,0,0,0,0\n"), "2:11: has more than 4 numbers: t, ax, ay, az");
  EXPECT_EQ(fault("0,0,0,0\n0,0,0,0\n"), "2:1: time 0 s follows 0 s, times must ascend");
  EXPECT_EQ(fault("0,0,x,0\n"), "1:5: ay must be a number (m/s2), is 'x'");
  EXPECT_EQ(fault("0,nan,0,0\n").substr(0, 5), "1:3: ");
  EXPECT_EQ(fault("ax,ay,az\n1,2,3\n"), "1:0: the heading names no column for the time: t (s)");
  EXPECT_EQ(fault("t,vel\n1,2\n").substr(0, 40), "1:0: the heading names no acceleration: ");
  EXPECT_EQ(fault("t,ax,AX\n1,2,3\n"), "1:6: two columns ax");
}

}  // namespace rockfold
