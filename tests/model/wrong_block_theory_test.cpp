// Wrong loads of block theory and wrong [block_theory]: where the error is found and what it says.
#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

// One case a line.
// clang-format off

namespace rockfold {
namespace {

// ROCK is 5 lines: what is added starts in line 6.
#define WATER ROCK "[[water]]\n"
#define JOINT ROCK "[[joint]]\nname = 'J'\ndip = 3\ndip_direction = 0\npoint = [0, 0, 0]\n"
#define THEORY ROCK "[block_theory]\n"
#define TUNNEL ROCK "[[block_theory.tunnel]]\ntrend = 0\nsection = 'circle'\nradius = 2\n"
#define SLOPE ROCK "[[block_theory.slope]]\n"

TEST(WrongWater, IsRefused) {
  const Wrong cases[] = {
      {WATER, 6, 1, "water[1].pressure", "must have one of pressure, table or head"},
      {WATER "pressure = 1\nhead = 2", 8, 8, "water[1].head", "has both pressure and head"},
      {WATER "pressure = -1", 7, 12, "water[1].pressure", "must be >= 0 (Pa)"},
      {WATER "head = 1\ndrains = 1", 8, 10, "water[1].drains", "must be true or false"},
      {WATER "head = 1\nlaw = 'linear'", 8, 7, "water[1].law", "must be \"hydrostatic\", \"drained\""},
      {WATER "head = 1\nlaw = 'hydrostatic'\ndrains = true", 8, 7, "water[1].law", "but drains is true"},
      {WATER "head = 1\ndrains = false\nlaw = 'mid_height'", 9, 7, "water[1].law", "but drains is false"},
      {WATER "head = 'high'", 7, 8, "water[1].head", "must be a number"},
      {WATER "head = 1\ndensity = 0", 8, 11, "water[1].density", "must be > 0"},
      {WATER "table = 5", 7, 9, "water[1].table", "must be a plane, {point = [0, 0, 5]}"},
      {WATER "table = {dip = 3, point = [0, 0, 0]}", 7, 9, "water[1].table.dip_direction", "is missing"},
      {WATER "head = 1\njoints = ['K']", 8, 11, "water[1].joints[1]", "there is no joint named \"K\""},
      {JOINT "[[water]]\nhead = 1\njoints = ['J', 'J']", 13, 16, "water[1].joints[2]", "already given"},
      {WATER "head = 1\n[[water]]\nhead = 2", 8, 1, "water[2]", "without joints was given before"},
      {"gravity = [0, 0, 0]\n" WATER "head = 1", 7, 1, "water[1]", "gravity is zero"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongSupport, OfGroupsIsRefused) {
  expect_error({ROCK "[support]\nlargest_group = 0", 7, 17, "support.largest_group", "must be an integer, 1 to 1000"});
  expect_error({ROCK "[support]\nrotation = 1", 7, 12, "support.rotation", "must be true or false"});
}

TEST(WrongBlockTheory, IsRefused) {
  const Wrong cases[] = {
      {THEORY "materal = 'a'", 7, 1, "block_theory.materal", "did you mean \"material\"?"},
      {THEORY "tunnel = 3", 7, 10, "block_theory.tunnel", "write [[block_theory.tunnel]]"},
      {ROCK "[[block_theory.tunnel]]\nsection = 'circle'\nradius = 1", 6, 0, "block_theory.tunnel[1].trend", "is missing"},
      {ROCK "[[block_theory.tunnel]]\ntrend = 0\nsection = 'oval'", 8, 11, "block_theory.tunnel[1].section", "must be \"circle\""},
      {TUNNEL "plunge = 90", 10, 10, "block_theory.tunnel[1].plunge", ">= 0 and < 90"},
      {SLOPE "dip = 60\ndip_direction = 0", 6, 0, "block_theory.slope[1].height", "is missing"},
      {SLOPE "dip = 60\ndip_direction = 0\nheight = 0", 9, 10, "block_theory.slope[1].height", "must be > 0 (m)"},
      {SLOPE "dip = 0\ndip_direction = 0\nheight = 3\nupper_dip = 0", 7, 7, "block_theory.slope[1].dip", "a slope face is not level"},
      {SLOPE "dip = 40\ndip_direction = 0\nheight = 3\nupper_dip = 40", 10, 13, "block_theory.slope[1].upper_dip", "must be < dip's 40"},
      {THEORY "scan = {step = 5}", 7, 8, "block_theory.scan", "neither a [[block_theory.tunnel]] nor"},
      {TUNNEL "[block_theory.scan]\nstep = 0", 11, 8, "block_theory.scan.step", "must be 1 to 90"},
      {TUNNEL "[block_theory.scan]\nplunges = [90]", 11, 12, "block_theory.scan.plunges[1]", "0 to 89"},
      {THEORY "[block_theory.monte_carlo]\n", 7, 0, "block_theory.monte_carlo", "there is no [[block_theory.tunnel]]"},
      {TUNNEL "[block_theory.monte_carlo]\nrealisations = 1", 11, 16, "block_theory.monte_carlo.realisations", "an integer, 2 to"},
      {TUNNEL "[block_theory.monte_carlo]\nconfidence = 1", 11, 14, "block_theory.monte_carlo.confidence", "> 0 and < 1"},
      {TUNNEL "[block_theory.monte_carlo]\nlength = -1", 11, 10, "block_theory.monte_carlo.length", "must be > 0 (m)"},
      {TUNNEL "[block_theory.monte_carlo]\nseed = -1", 11, 8, "block_theory.monte_carlo.seed", "an integer >= 0"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

/// What a model lacks for `rockfold theory`.
std::vector<std::string> lacks(const std::string& text) {
  std::vector<std::string> keys;
  for (const auto& error : errors_of(text, {}, Purpose::theory)) keys.push_back(error.place.key);
  return keys;
}

TEST(BlockTheory, NeedsJointSetsAndADensityButNoSolid) {
  const std::string sets = "[[joint_set]]\ndip = 60\ndip_direction = 0\nspacing = 1\n[[joint_material]]\nfriction_angle = 30\n";
  const std::string rock = "[[material]]\ndensity = 2700\n", theory = "[block_theory]\n";
  using Keys = std::vector<std::string>;
  EXPECT_EQ(lacks(sets + rock + theory), Keys{});
  EXPECT_EQ(lacks(sets + rock), Keys{"block_theory"});
  EXPECT_EQ(lacks(rock + theory), Keys{"joint_set"});
  EXPECT_EQ(lacks(sets + theory), Keys{"material"});
  EXPECT_EQ(lacks(sets + "[[material]]\n" + theory), Keys{"material[1].density"});
  EXPECT_EQ(lacks("gravity = [0, 0, 0]\n" + sets + rock + theory), Keys{"gravity"});
  std::string many = rock + theory + "[[joint_material]]\nfriction_angle = 30\n";
  for (int i = 0; i < 11; ++i) many += "[[joint_set]]\ndip = 60\ndip_direction = " + std::to_string(i) + "\nspacing = 1\n";
  EXPECT_EQ(lacks(many), Keys{"joint_set"});
}

TEST(InitialStress, NeedsStiffJointsInBlockTheory) {
  const std::string rock = ROCK "[[material]]\ndensity = 2700\n[[joint_set]]\ndip = 60\ndip_direction = 0\nspacing = 1\n[initial_stress]\nvalue = [[-1, 0, 0], [0, -1, 0], [0, 0, -1]]\n";
  const auto errors = errors_of(rock + "[[joint_material]]\nname = 'soft'\nfriction_angle = 30\n", {}, Purpose::support);
  ASSERT_EQ(errors.size(), 1u) << listed(errors);
  EXPECT_NE(errors[0].message.find("\"soft\" has no normal_stiffness and shear_stiffness"), std::string::npos);
  EXPECT_TRUE(errors_of(rock + "[[joint_material]]\nfriction_angle = 30\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n", {}, Purpose::support).empty());
}

}  // namespace
}  // namespace rockfold
