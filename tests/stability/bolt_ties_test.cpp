// Which bodies a bolt ties together, where and how strongly.
#include "host/stability/bolt_ties.hpp"

#include <gtest/gtest.h>

#include "host/stability/rock_mass.hpp"
#include "tests/bolting/bolted_models.hpp"

namespace rockfold {
namespace {

/// Three cubes of a metre on a held one, and a bolt of 3.5 m from the top straight down the middle: 0.5 m of it are in the held one.
RigidMass pile_with_bolt(const std::string& type) {
  const Model model = parse_model(R"(
gravity = [0, 0, -10]
[[material]]
name = "rock"
density = 2700
[[joint_material]]
name = "rough"
friction_angle = 35
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 4]
[[joint_set]]
name = "bed"
dip = 0
dip_direction = 0
spacing = 1
origin = [0, 0, 1]
[[fixed]]
where = {face = "rock.zmin"}
[[bolt]]
name = "rod"
collar = [0.5, 0.5, 4]
direction = [0, 0, -1]
length = 3.5
force_capacity = 250e3
displacement_capacity = 0.02
)" + type,
                                  "m.toml", {}, Purpose::support);
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  return rigid_mass(cutting, flatten_blocks(cutting, model), model);
}

/// The body whose centre is at this height.
Index body_at(const RigidMass& mass, Real z) {
  for (std::size_t b = 0; b < mass.bodies.size(); ++b)
    if (std::abs(mass.bodies[b].centre[2] - z) < 1e-9) return static_cast<Index>(b);
  return none;
}

// 60 kN/m of bond: 1 m of a cube would bear 60 kN beyond the plate's 20 kN, the 0.5 m beyond all of them 30 kN.
TEST(BoltTies, TieEachBodyToTheOneInWhichTheBoltEnds) {
  const RigidMass mass = pile_with_bolt("bond_strength = 60e3\nplate_capacity = 20e3\n");
  ASSERT_EQ(mass.bodies.size(), 3);
  ASSERT_EQ(mass.ties.size(), 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const BoltTie& tie = mass.ties[k];
    const Real height = 3.5 - static_cast<Real>(k);
    EXPECT_EQ(tie.body, (std::array<Index, 2>{body_at(mass, height), none})) << k;
    EXPECT_NEAR(tie.at[2], height, 1e-9);
    EXPECT_EQ(tie.axis, (Vec3{0, 0, -1}));
    EXPECT_EQ(tie.least, 0);
    EXPECT_NEAR(tie.most, 30e3, 1e-6);
    EXPECT_EQ(tie.bolt, "rod.1");
  }
}

// The steel bears 250 kN: what blocks nearer to the collar may take is not there for those behind.
TEST(BoltTies, ShareWhatTheSteelBearsFromTheCollarOn) {
  const RigidMass mass = pile_with_bolt("bond_strength = 400e3\nplate_capacity = 20e3\n");
  ASSERT_EQ(mass.ties.size(), 2);
  EXPECT_NEAR(mass.ties[0].most, 200e3, 1e-6);
  EXPECT_NEAR(mass.ties[1].most, 50e3, 1e-6);
}

// A plate presses on the first block alone, by what the bolt was tightened to.
TEST(BoltTies, ActiveOnesPullWithAllOfItOnTheBlockUnderThePlate) {
  const RigidMass mass =
      pile_with_bolt("bond_strength = 60e3\nplate_capacity = 20e3\naction = \"active\"\n");
  ASSERT_EQ(mass.ties.size(), 3);
  EXPECT_EQ(mass.ties[0].least, mass.ties[0].most);
  EXPECT_EQ(mass.ties[1].least, 0);
  EXPECT_EQ(mass.ties[2].least, 0);
}

}  // namespace
}  // namespace rockfold
