// The progress line as text: what stays where the terminal is narrow, and its numbers.
#include "src/report/progress_line.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

const PhaseView half{"Cutting blocks", "cells", 13500, 27000, 3.0};
const LineStyle plain{80, false, false};

LineStyle of_width(int width) {
  return {width, false, false};
}

TEST(ProgressLine, ShowsBarCountRateAndTimeLeft) {
  EXPECT_EQ(progress_line(half, plain),
            "Cutting blocks [####-----]   50 %  13,500/27,000 cells  4.5k cells/s  0:03 left");
}

TEST(ProgressLine, LeavesOutRateThenCountThenBarWhereTheTerminalIsNarrow) {
  EXPECT_EQ(progress_line(half, of_width(66)),
            "Cutting blocks [####-----]   50 %  13,500/27,000 cells  0:03 left");
  EXPECT_EQ(progress_line(half, of_width(50)), "Cutting blocks [#######-------]   50 %  0:03 left");
  EXPECT_EQ(progress_line(half, of_width(36)), "Cutting blocks   50 %  0:03 left");
  EXPECT_EQ(progress_line(half, of_width(24)), "Cutting blocks   50 %");
  EXPECT_EQ(progress_line(half, of_width(8)), "Cutting");
}

TEST(ProgressLine, IsNeverWiderThanTheTerminal) {
  for (int width = 2; width < 140; ++width) {
    for (const bool unicode : {false, true}) {
      const auto line = progress_line(half, {width, unicode, false});
      const auto columns =
          std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
      EXPECT_LT(columns, width) << line;
    }
  }
}

TEST(ProgressLine, OfAnUnknownTotalCountsUp) {
  EXPECT_EQ(progress_line({"Joining", "faces", 1234567, 0, 61.0}, plain),
            "Joining  1,234,567 faces  20.2k faces/s  1:01");
}

TEST(ProgressLine, WithoutColourHasNoEscapes) {
  EXPECT_EQ(progress_line(half, {80, true, false}).find('\033'), std::string::npos);
  EXPECT_NE(progress_line(half, {80, true, true}).find('\033'), std::string::npos);
}

TEST(ProgressLine, OfALogHasNoBar) {
  EXPECT_EQ(progress_log_line(half),
            "Cutting blocks: 50 %, 13,500/27,000 cells, 4.5k cells/s, 0:03 left");
}

TEST(ProgressLine, BeforeTheFirstUnitPromisesNothing) {
  EXPECT_EQ(progress_log_line({"Time steps", "steps", 0, 100, 0.0}),
            "Time steps: 0 %, 0/100 steps");
}

TEST(ProgressText, GroupsDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(-1234567), "-1,234,567");
}

TEST(ProgressText, RoundsTimesUp) {
  EXPECT_EQ(duration_text(0), "0:00");
  EXPECT_EQ(duration_text(59.2), "1:00");
  EXPECT_EQ(duration_text(3661), "1:01:01");
  EXPECT_EQ(duration_text(1e30), "99:59:59");
}

}  // namespace
}  // namespace rockfold
