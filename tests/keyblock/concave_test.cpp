// Concave and holed blocks of cut models: removable by the faces that they have.
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/bolting/bolted_models.hpp"

namespace rockfold {
namespace {

using test::cut_rock;
using test::CutRock;

/// A ring of 3 × 3 × 1 m round a pillar of 1 × 1 m, on the same rock; gravity as given.
CutRock ring_round_a_pillar(const std::string& gravity) {
  std::string text = "gravity = " + gravity + R"(
[[material]]
name = "rock"
density = 2000
[[joint_material]]
name = "smooth"
friction_angle = 10
[[solid]]
name = "base"
shape = "box"
min = [-4, -4, -2]
max = [4, 4, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "ring"
shape = "box"
min = [-1.5, -1.5, 0]
max = [1.5, 1.5, 1]
[[joint]]
name = "bed in front"
polygon = [[-2, -2, 0], [2, -2, 0], [2, 2, 0], [0.5, 2, 0], [0.5, -0.5, 0], [-2, -0.5, 0]]
[[joint]]
name = "bed behind"
polygon = [[-2, -0.5, 0], [-0.5, -0.5, 0], [-0.5, 0.5, 0], [0.5, 0.5, 0], [0.5, 2, 0], [-2, 2, 0]]
[support]
rotation = false
)";
  const char* sides[] = {"[[-0.5, -0.5, 0], [-0.5, 0.5, 0], [-0.5, 0.5, 1], [-0.5, -0.5, 1]]",
                         "[[0.5, -0.5, 0], [0.5, 0.5, 0], [0.5, 0.5, 1], [0.5, -0.5, 1]]",
                         "[[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, -0.5, 1], [-0.5, -0.5, 1]]",
                         "[[-0.5, 0.5, 0], [0.5, 0.5, 0], [0.5, 0.5, 1], [-0.5, 0.5, 1]]"};
  for (const char* side : sides) text += std::string("[[joint]]\npolygon = ") + side + "\n";
  return cut_rock(text);
}

// Its hull is a box, free to slide on its bed; the pillar in its hole leaves one direction, off the bed.
TEST(ConcaveBlocks, WithAHoleAreHeldByWhatIsInIt) {
  const CutRock pulled = ring_round_a_pillar("[0, 0, 10]");
  ASSERT_EQ(pulled.keyblocks.keyblocks.size(), 1u);
  const Keyblock& key = pulled.keyblocks.keyblocks[0];
  EXPECT_NEAR(key.volume, 8, 1e-12);
  EXPECT_EQ(pulled.blocks.convex[key.block], 0);
  EXPECT_EQ(key.mode, SlidingMode::lifting);
  ASSERT_EQ(key.removable.edges.size(), 1u);
  EXPECT_LT(norm(key.removable.edges[0] - Vec3{0, 0, 1}), 1e-12);
  EXPECT_EQ(key.removable.solid_angle, 0);

  const CutRock pushed = ring_round_a_pillar("[8, 3, -5]");
  EXPECT_TRUE(pushed.keyblocks.keyblocks.empty());
  EXPECT_EQ(pushed.keyblocks.block_class[key.block], BlockClass::stable);
}

// An L lies on a plane against the inside of a corner: two walls at its inner faces. It slides along the one that it is
// pressed on, away from the other.
TEST(ConcaveBlocks, SlideOnAnyPairOfTheirFaces) {
  const std::string model = R"(
gravity = [4, 6, -6]
[[material]]
name = "rock"
density = 2000
[[joint_material]]
name = "smooth"
friction_angle = 10
[[solid]]
name = "base"
shape = "box"
min = [-9, -9, -2]
max = [9, 9, 0]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin"]
[[solid]]
name = "post"
shape = "box"
min = [0, 0, 0]
max = [4, 4, 1]
[[solid]]
name = "angle"
shape = "prism"
base = [[-1, -1, 0], [3, -1, 0], [3, 0, 0], [0, 0, 0], [0, 3, 0], [-1, 3, 0]]
extrude = [0, 0, 1]
[[joint]]
name = "bed"
polygon = [[-1, -1, 0], [3, -1, 0], [3, 0, 0], [0, 0, 0], [0, 3, 0], [-1, 3, 0]]
[[joint]]
name = "west"
polygon = [[0, 0, 0], [0, 4, 0], [0, 4, 1], [0, 0, 1]]
[[joint]]
name = "south"
polygon = [[0, 0, 0], [4, 0, 0], [4, 0, 1], [0, 0, 1]]
[support]
rotation = false
)";
  // Pressed on both walls of the post and the bed: held.
  EXPECT_TRUE(cut_rock(model).keyblocks.keyblocks.empty());
  // Pulled to the west and north: off the west wall, along the south one and the bed.
  std::string west = model;
  west.replace(west.find("[4, 6, -6]"), 10, "[-4, 6, -6]");
  const CutRock rock = cut_rock(west);
  ASSERT_EQ(rock.keyblocks.keyblocks.size(), 1u);
  const Keyblock& key = rock.keyblocks.keyblocks[0];
  EXPECT_EQ(rock.blocks.convex[key.block], 0);
  EXPECT_EQ(key.mode, SlidingMode::two_planes);
  EXPECT_EQ((std::set<std::string>(key.planes.begin(), key.planes.end())),
            (std::set<std::string>{"bed", "south"}));
  EXPECT_LT(norm(key.direction - Vec3{-1, 0, 0}), 1e-12);
  EXPECT_NEAR(key.sliding_force, 2000 * 7 * (4 - (6 + 6) * std::tan(10 * M_PI / 180)), 1e-6);
}

}  // namespace
}  // namespace rockfold
