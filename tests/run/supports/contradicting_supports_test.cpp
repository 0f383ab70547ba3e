// [[fixed]] that prescribe different displacements of the same rock at some time of the analysis.
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/run/fixed_contradiction.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real end = 10;  // s

/// A box, x and y from 0 to 1, z from -2 to 0.
std::optional<Contradiction> contradiction(const std::string& cover, const std::string& supports) {
  const Model model = parse_model(R"(
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.3
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, -2]
max = [1, 1, 0]
[cover]
)" + cover + "\n[analysis]\ntype = 'quasi_static'\ntime_step = 1\nsteps = 10\n" +
                                      supports,
                                  "m.toml", {}, Purpose::run);
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  return find_contradiction(fixed_points(cutting, build_covers(cutting, model, silent), model),
                            model.fixed, end);
}

std::string hold(const std::string& where, const std::string& more = "") {
  return fmt::format("[[fixed]]\nwhere = {{{}}}\n{}\n", where, more);
}

const std::string tetrahedra = "spacing = 0.5", block = "lattice = 'block'",
                  rigid = "lattice = 'block'\norder = 0";
const std::string bottom = "face = 'rock.zmin'", top = "face = 'rock.zmax'",
                  left = "face = 'rock.xmin'", low = "block_at = [0.5, 0.5, -1.9]",
                  high = "block_at = [0.5, 0.5, -0.1]";
const std::string later = "value_table = [[0, 0, 0, 0], [4, 0, 0, 0], [6, 0, 0, -0.1]]",
                  after_end = "value_table = [[0, 0, 0, 0], [10, 0, 0, 0], [12, 0, 0, -0.1]]";

TEST(ContradictingSupports, OfOneFaceAreFoundByThoseOfOneComponent) {
  const std::string sides = hold(left, "components = ['x']") + hold(bottom, "components = ['z']");
  const auto moved = contradiction(
      tetrahedra, sides + hold(bottom, "components = ['y', 'z']\nvalue = [0, 0, 0.1]"));
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->condition, (std::array<Index, 2>{1, 2}));
  EXPECT_EQ(moved->axis, 2);
  EXPECT_TRUE(moved->same_rock);
  EXPECT_EQ(moved->displacement, (std::array<Real, 2>{0, 0.1}));
  EXPECT_FALSE(contradiction(tetrahedra, sides + hold(bottom, "components = ['z']")));
  EXPECT_FALSE(
      contradiction(tetrahedra, sides + hold(bottom, "components = ['y']\nvalue = [0, 1, 0]")));
}

TEST(ContradictingSupports, OfOneBlockTwiceNamedAreFoundWhereTheyDifferOnlyLater) {
  for (const std::string& cover : {block, rigid, tetrahedra}) {
    SCOPED_TRACE(cover);
    const auto found = contradiction(cover, hold(low) + hold(high, later));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->same_rock);
    EXPECT_EQ(found->axis, 2);
    EXPECT_EQ(found->from, 4);
    EXPECT_EQ(found->time, 6);
    EXPECT_EQ(found->displacement, (std::array<Real, 2>{0, -0.1}));
    EXPECT_FALSE(contradiction(cover, hold(low) + hold(high)));
    EXPECT_FALSE(contradiction(cover, hold(low) + hold(high, after_end)));
    EXPECT_FALSE(contradiction(
        cover, hold(low, "components = ['x', 'y']") + hold(high, "components = ['z']\n" + later)));
  }
}

TEST(ContradictingSupports, ThatAgreeInOtherWordsAreNone) {
  const std::string as_table = "value_table = [[0, 0, 0, 0.2], [3, 0, 0, 0.2]]";
  EXPECT_FALSE(
      contradiction(tetrahedra, hold(bottom, "value = [0, 0, 0.2]") + hold(bottom, as_table)));
}

TEST(ContradictingSupports, OfAPointInRockThatIsHeldIsOfTheSameRock) {
  const std::string inside = "point = [0.3, 0.6, -2]";
  const auto found = contradiction(tetrahedra, hold(bottom) + hold(inside, "value = [0.01, 0, 0]"));
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->same_rock);
  EXPECT_EQ(found->axis, 0);
  EXPECT_FALSE(contradiction(tetrahedra, hold(bottom) + hold(inside)));
}

TEST(ContradictingSupports, ApartAreNoneWhereTheRockBetweenThemStrains) {
  const std::string moved = "value = [0, 0, 0.01]";
  EXPECT_FALSE(contradiction(tetrahedra, hold(bottom) + hold(top, moved)));
  EXPECT_FALSE(contradiction(block, hold(bottom) + hold(top, moved)));
  EXPECT_TRUE(contradiction(rigid, hold(bottom) + hold(top, moved)));
}

TEST(ContradictingSupports, OfCoversThatCannotFollowAreNotOfTheSameRock) {
  // The block strains linearly: a point of the middle lies half way between bottom and top.
  const auto found =
      contradiction(block, hold(bottom) + hold(top, "value = [0, 0, 0.02]") +
                               hold("point = [0.3, 0.4, -1]", "value = [0, 0, 0.015]"));
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->same_rock);
  EXPECT_FALSE(contradiction(
      block, hold(bottom) + hold(top, "value = [0, 0, 0.02]") +
                 hold("point = [0.3, 0.4, -1]", "value = [0, 0, 0.01]\ncomponents = ['z']")));
}

TEST(ContradictingSupports, OnSpringsOfGivenStiffnessGive) {
  const std::string spring = "value = [0, 0, 0.1]\nmethod = 'penalty'\nstiffness = 1e9";
  EXPECT_FALSE(contradiction(tetrahedra, hold(bottom) + hold(bottom, spring)));
  EXPECT_TRUE(contradiction(
      tetrahedra, hold(bottom) + hold(bottom, "value = [0, 0, 0.1]\nmethod = 'penalty'")));
}

}  // namespace
}  // namespace rockfold
