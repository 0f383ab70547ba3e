// The Nef oracle on what is known by hand and by voxels: the tests that use it rest on these.
#include "tests/cut/oracles/nef_oracle.hpp"

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/finite_joint_cases.hpp"
#include "tests/cut/models/nef_models.hpp"

namespace rockfold::test {
namespace {

// Coplanar joints are one origin to the Nef oracle: left out here, and looked at in finite_joint_cases_test.
bool has_coplanar_joints(const GridModel& m) {
  for (std::size_t i = 0; i < m.joints.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (m.joints[i].axis == m.joints[j].axis && m.joints[i].at == m.joints[j].at) return true;
  return false;
}

TEST(NefOracle, AgreesWithTheVoxelOracle) {
  for (const FiniteJointCase& c : finite_joint_cases()) {
    SCOPED_TRACE(c.name);
    const GridModel grid = grid_model(c);
    // Two crossing tunnels have floors of two origins.
    const bool origins = has_coplanar_joints(grid) || c.voids.size() > 1;
    std::vector<GridBlock> expected = blocks_of(grid).blocks;
    const std::vector<NefBlock> found = nef_blocks(model_of(grid));
    ASSERT_EQ(found.size(), expected.size());
    for (const NefBlock& n : found) {
      bool matched = false;
      for (GridBlock& g : expected) {
        if (matched || g.volume != n.volume || norm(n.centroid - g.centroid) > 1e-12) continue;
        matched = true;
        if (!origins) {
          EXPECT_EQ(n.counts, g.counts);
        }
        EXPECT_EQ(n.shells, g.shells);
        EXPECT_EQ(n.genus, g.genus);
        EXPECT_EQ(n.dead_end_area, g.dead_ends[0] + g.dead_ends[1] + g.dead_ends[2]);
      }
      EXPECT_TRUE(matched) << "volume " << n.volume << " about " << n.centroid[0] << " "
                           << n.centroid[1] << " " << n.centroid[2];
    }
  }
}

// Which blocks the random models have: neither all one nor all convex.
TEST(NefModels, AreOfManyKinds) {
  int models = 0, blocks = 0, of_one_block = 0, concave = 0, with_dead_ends = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const std::vector<NefBlock> all = nef_blocks(random_finite_joints(seed));
    ++models;
    blocks += static_cast<int>(all.size());
    of_one_block += all.size() == 1;
    for (const NefBlock& b : all) {
      concave += b.shells > 1 || b.genus > 0;
      with_dead_ends += b.dead_end_area > 0;
    }
  }
  EXPECT_GT(blocks, 4 * models);
  EXPECT_LT(of_one_block, models / 2);
  EXPECT_GT(concave, 2);
  EXPECT_GT(with_dead_ends, models / 2);
}

}  // namespace
}  // namespace rockfold::test
