// Bolts in blocks whose joints are meshes, against the same joints as planes.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/bolting/bolted_models.hpp"
#include "tests/keyblock/models/half_space_block.hpp"
#include "tests/keyblock/models/rough_square.hpp"

namespace rockfold {
namespace {

using test::CutRock;

/// A bench whose upper half slides 35/310 on a rough joint.
const std::string slab = R"(
[[material]]
density = 2700
[[joint_material]]
friction_angle = 30
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [10, 10, 10]
continues = ["zmin"]
[[joint]]
dip = 35
dip_direction = 310
point = [5, 5, 5]
[support]
target_factor_of_safety = 1.3
)";

std::string bolt(const std::string& type) {
  return "[[bolt]]\ncollar = [4.5, 5.5, 10]\ndirection = [0.2, -0.3, -1]\nlength = 12\n"
         "force_capacity = 2e6\ndisplacement_capacity = 0.02\naction = '" +
         type + "'\n";
}

CutRock cut_rock(const std::string& text, Real noise) {
  CutRock rock;
  rock.model = parse_model(text, "m.toml", {}, Purpose::support);
  if (noise > 0) {
    unsigned seed = 0;
    for (const Joint& joint : rock.model.joints) {
      const auto& dip = std::get<DipOrientation>(joint.plane.orientation);
      test::add_mesh(rock.model, test::rough_square(test::upward(dip.dip, dip.dip_direction),
                                                    joint.plane.point, 30, 2, noise, ++seed));
    }
    rock.model.joints.clear();
  }
  Progress progress;
  rock.blocks = flatten_blocks(cut_blocks(rock.model, progress), rock.model);
  rock.keyblocks = find_keyblocks(rock.blocks, rock.model);
  return rock;
}

BlockSupport only_support(const CutRock& rock) {
  const BoltingReport report = support_blocks(rock.blocks, rock.keyblocks, rock.model);
  EXPECT_EQ(report.keyblocks.size(), 1u);
  return report.keyblocks.empty() ? BlockSupport{} : report.keyblocks[0];
}

TEST(BoltsThroughMeshes, HoldSlidingBlocksAsThroughPlanes) {
  for (const char* type : {"active", "passive"})
    for (const Real noise : {1e-6, 1e-4, 1e-3}) {
      SCOPED_TRACE(testing::Message() << type << ", noise " << noise);
      const BlockSupport plane = only_support(cut_rock(slab + bolt(type), 0)),
                         mesh = only_support(cut_rock(slab + bolt(type), noise));
      EXPECT_EQ(mesh.crossings.size(), 1u);
      EXPECT_NEAR(mesh.held.factor_of_safety / plane.held.factor_of_safety, 1,
                  noise < 1e-3 ? 1e-3 : 2e-3);
    }
}

TEST(BoltsThroughMeshes, HoldFallingBlocksAsThroughPlanes) {
  const std::string text = test::roof_wedge +
                           "[[bolt]]\ncollar = [0.2, 0.1, 0]\n"
                           "direction = [0, 0, 2]\nlength = 3\n"
                           "force_capacity = 40e3\n"
                           "displacement_capacity = 0.02\n";
  const BlockSupport plane = only_support(cut_rock(text, 0));
  for (const Real noise : {1e-6, 1e-5}) {
    SCOPED_TRACE(noise);
    const BlockSupport mesh = only_support(cut_rock(text, noise));
    EXPECT_EQ(mesh.crossings.size(), 1u);
    // A surface that is off by half of 30 m times the noise changes the block of 1 m by three times as much.
    EXPECT_NEAR(mesh.held.factor_of_safety / plane.held.factor_of_safety, 1, 1e-3 + 90 * noise);
  }
}

}  // namespace
}  // namespace rockfold
