#include "src/run/base_motion.hpp"

#include <gtest/gtest.h>

namespace rockfold {
namespace {

/// 2 m/s² falling to −4 over 3 s from t = 1 on, as it is before and after: v and d by hand.
TEST(BaseRecord, IsIntegratedExactlyHoweverFewItsRows) {
  const TimeTable table{{1, 4}, {{2, 0, 0}, {-4, 0, 0}}};
  BaseRecord base(table);
  EXPECT_EQ(base.at(0).acceleration[0], 2);
  EXPECT_NEAR(base.at(0.5).velocity[0], 1, 1e-14);
  EXPECT_NEAR(base.at(0.5).displacement[0], 0.25, 1e-14);
  // t = 3: v = 2 + ∫(2 − 2s)ds = 2 + 4 − 4, d = 1 + 2·2 + 2²− 2³/3, s from 0 to 2.
  EXPECT_NEAR(base.at(3).velocity[0], 2, 1e-14);
  EXPECT_NEAR(base.at(3).displacement[0], 9 - 8.0 / 3, 1e-14);
  // Beyond the last row, over it in one go: at t = 4 v = −1, d = 1 + 6 + 9 − 9; then −4 on.
  EXPECT_NEAR(base.at(5).velocity[0], -5, 1e-14);
  EXPECT_NEAR(base.at(5).displacement[0], 7 - 1 - 2, 1e-13);
  EXPECT_EQ(base.at(5).acceleration[0], -4);
  EXPECT_EQ(base.at(5).acceleration[1], 0);
}

}  // namespace
}  // namespace rockfold
