// Which joints the names of [[water]] mean.
#include <gtest/gtest.h>

#include "host/keyblock/water/water.hpp"
#include "src/model/joint_name.hpp"

namespace rockfold {

TEST(JointNames, OfATableMeanAllItsJoints) {
  EXPECT_TRUE(is_joint_of("map", "map"));
  EXPECT_TRUE(is_joint_of("map.J1", "map"));
  EXPECT_FALSE(is_joint_of("map2", "map"));
  EXPECT_FALSE(is_joint_of("map", "map.J1"));
  EXPECT_FALSE(is_joint_of("rock.interface", "rock")) << "that of solid \"rock\"";
}

TEST(Water, OfATableActsInAllItsJoints) {
  std::vector<Water> waters(2);
  waters[0].joints = {"map"};
  EXPECT_EQ(water_of(waters, "map.J1"), &waters[0]);
  EXPECT_EQ(water_of(waters, "bed"), &waters[1]);
}

}  // namespace rockfold
