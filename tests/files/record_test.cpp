// Records of acceleration over time.
#include <gtest/gtest.h>

#include "host/files/read_record.hpp"

namespace rockfold {
namespace {

const Place place{"quake.csv", 0, 0, "base_acceleration.file"};

std::string fault(std::string_view text) {
  try {
    read_record(text, place);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::model);
    const auto& first = error.diagnostics()[0];
    EXPECT_EQ(first.place.file, "quake.csv");
    return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " +
           first.message;
  }
  return "";
}

TEST(Record, IsReadWithOrWithoutAHeading) {
  for (const char* text :
       {"t, ax, ay, az\n0, 0, 0, 0\n0.01, 1.5, -2, 3e-1\n", "0;0;0;0\r\n0.01;1.5;-2;0.3",
        "# El Centro\n\nT;AX;AY;AZ\n 0 0 0 0\n0.01 1.5 -2 0.3"}) {
    const TimeTable table = read_record(text, place);
    EXPECT_EQ(table.time, (std::vector<Real>{0, 0.01})) << text;
    EXPECT_EQ(table.value[1], (Vec3{1.5, -2, 0.3})) << text;
  }
}

TEST(Record, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(fault(""), "0:0: holds no rows t, ax, ay, az");
  EXPECT_EQ(fault("t,ax,ay,az\n"), "0:0: holds no rows t, ax, ay, az");
  EXPECT_EQ(fault("0,0,0\n"), "1:6: has 3 numbers, must have 4: t, ax, ay, az");
  EXPECT_EQ(fault("0,0,0,0\n0.1,0,0,0,0\n"), "2:11: has more than 4 numbers: t, ax, ay, az");
  EXPECT_EQ(fault("0,0,0,0\n0,0,0,0\n"), "2:1: time 0 s follows 0 s, times must ascend");
  EXPECT_EQ(fault("0,0,x,0\n"), "1:5: ay must be a number (m/s2), is 'x'");
  EXPECT_EQ(fault("0,nan,0,0\n").substr(0, 5), "1:3: ");
}

}  // namespace
}  // namespace rockfold
