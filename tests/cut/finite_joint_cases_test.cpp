// Finite joints on a grid: reference cases, straight, under affine maps, with noise, far away, in any order.
#include "tests/cut/models/finite_joint_cases.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/oracles/conservation.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> none_differ;

Index total(const std::array<Index, 3>& squares) {
  return squares[0] + squares[1] + squares[2];
}

class FiniteJointCases : public testing::TestWithParam<FiniteJointCase> {
 protected:
  const GridModel grid = grid_model(GetParam());
  const GridBlocks expected = blocks_of(grid);

  void expect_as_placed(const Placing& placing, Real tolerance) {
    const Blocks found = cut(model_of(grid, placing));
    const AffineMap map = placing.straight ? AffineMap{} : placing.map;
    EXPECT_EQ(differences(found, expected, map, tolerance), none_differ);
  }
};

INSTANTIATE_TEST_SUITE_P(, FiniteJointCases, testing::ValuesIn(finite_joint_cases()),
                         [](const auto& test) { return test.param.name; });

// The oracle that all tests below trust, against the enumeration: slits of dead-end joints count as boundary there, so that
// shells and genus can be compared where there are none.
TEST_P(FiniteJointCases, AreWhatTheOracleSays) {
  const FiniteJointCase& c = GetParam();
  using Key = std::tuple<Index, Index>;
  std::map<Key, int> by_table, by_oracle;
  for (const auto& b : c.blocks) {
    EXPECT_EQ(b.euler, 1 + b.cavities - b.genus) << "the table itself";
    by_table[{b.volume, b.euler}] += b.count;
  }
  for (const GridBlock& b : expected.blocks) ++by_oracle[{b.volume, b.open_euler}];
  EXPECT_EQ(by_oracle, by_table);
  EXPECT_EQ(total(expected.separating), c.separating);
  EXPECT_EQ(total(expected.dead_ends), c.dead_ends);
  for (const GridBlock& b : expected.blocks) {
    if (total(b.dead_ends) > 0) continue;
    const auto same = std::find_if(c.blocks.begin(), c.blocks.end(), [&](const auto& t) {
      return t.volume == b.volume && t.cavities + 1 == b.shells && t.genus == b.genus;
    });
    EXPECT_NE(same, c.blocks.end()) << b.volume << " shells " << b.shells << " genus " << b.genus;
  }
}

TEST_P(FiniteJointCases, AreCutExactly) {
  const Blocks found = cut(model_of(grid));
  EXPECT_EQ(differences(found, expected), none_differ);
  const Vec3 corner{1.0 * grid.size[0], 1.0 * grid.size[1], 1.0 * grid.size[2]};
  EXPECT_EQ(losses(found, norm(corner)), none_differ);
}

// Oblique maps of small integers (all of the box' coordinates stay exact), of angles, and a left-handed one.
const std::vector<AffineMap>& maps() {
  static const std::vector<AffineMap> list{
      {{{{2, 1, 0}, {0, 1, 0.5}, {1, 0, 3}}}, {}},
      {{{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}}}, {0.1, 0.2, 0.3}},
      {{{{1.3, -0.2, 0.7}, {0.1, 0.9, 0.3}, {-0.4, 0.6, 1.1}}}, {-7.7, 3.3, 0.01}},
      {{{{0.1, 1.7, 0.2}, {1.1, 0.3, -0.6}, {0.3, 0.2, 0.9}}}, {1, 2, 3}},
      {{{{1, 1e-3, 0}, {0, 1, 1e-3}, {1e-3, 0, 1}}}, {}},
  };
  return list;
}

AffineMap scaled(AffineMap map, Real by) {
  for (Vec3& c : map.column) c = by * c;
  return map;
}

TEST_P(FiniteJointCases, KeepTheirTopologyUnderAffineMaps) {
  for (std::size_t i = 0; i < maps().size(); ++i) {
    SCOPED_TRACE(testing::Message() << "map " << i);
    expect_as_placed({.map = maps()[i], .straight = false}, 1e-12);
  }
}

TEST_P(FiniteJointCases, MayBeDugInAPrism) {
  for (std::size_t i = 0; i < maps().size(); ++i) {
    SCOPED_TRACE(testing::Message() << "map " << i);
    expect_as_placed({.map = maps()[i], .straight = false, .prisms = true}, 1e-12);
  }
}

// Corners and points off by up to 1e-10 m: volumes are off by about that times the surface.
TEST_P(FiniteJointCases, BearNoiseOfTenthsOfNanometres) {
  for (std::size_t i = 0; i < maps().size(); ++i)
    for (const unsigned seed : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << "map " << i << " seed " << seed);
      expect_as_placed({.map = maps()[i], .straight = false, .noise = 1e-10, .seed = seed}, 1e-8);
    }
}

// The normals too from corners that are off.
TEST_P(FiniteJointCases, BearNoiseInTheirNormals) {
  for (std::size_t i = 0; i < maps().size(); ++i)
    for (const unsigned seed : {4, 5}) {
      SCOPED_TRACE(testing::Message() << "map " << i << " seed " << seed);
      expect_as_placed({.map = maps()[i],
                        .straight = false,
                        .noise = 1e-11,
                        .normals_of_corners = true,
                        .seed = seed},
                       1e-9);
    }
}

TEST_P(FiniteJointCases, MayLieFarFromTheOrigin) {
  for (std::size_t i = 0; i < maps().size(); ++i) {
    SCOPED_TRACE(testing::Message() << "map " << i);
    AffineMap map = maps()[i];
    map.shift = {1e4, -1e4, 1e4};  // whose doubles are 2e-12 m apart
    expect_as_placed({.map = map, .straight = false}, 1e-10);
  }
}

// Map coordinates, whose doubles are 9e-10 m apart: a site of some hundred metres.
TEST_P(FiniteJointCases, MayBeGivenInMapCoordinates) {
  for (std::size_t i = 0; i < maps().size(); ++i) {
    SCOPED_TRACE(testing::Message() << "map " << i);
    AffineMap map = scaled(maps()[i], 100);
    map.shift = {5e5, 5e6, 1e3};
    expect_as_placed({.map = map, .straight = false}, 1e-10);
  }
  AffineMap shift;
  shift.shift = {5e5, 5e6, 1e3};
  expect_as_placed({.map = shift, .straight = false}, 1e-12);
}

TEST_P(FiniteJointCases, DoNotDependOnTheOrderOfJoints) {
  GridModel shuffled = grid;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::shuffle(shuffled.joints.begin(), shuffled.joints.end(), random);
    const AffineMap& map = maps()[seed];
    EXPECT_EQ(differences(cut(model_of(shuffled, {.map = map, .straight = false})),
                          blocks_of(shuffled), map),
              none_differ);
  }
}

// The corners of a polygon may start anywhere and run either way.
TEST_P(FiniteJointCases, DoNotDependOnTheSenseOfPolygons) {
  Model model = model_of(grid, {.map = maps()[2], .straight = false});
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    auto& corners = model.joints[j].polygon;
    std::rotate(corners.begin(), corners.begin() + static_cast<int>(j % 4), corners.end());
    if (j % 2 == 0) std::reverse(corners.begin(), corners.end());
    if (j % 3 == 0) {
      Vec3& n = std::get<Vec3>(model.joints[j].plane.orientation);
      n = -n;
    }
  }
  EXPECT_EQ(differences(cut(model), expected, maps()[2]), none_differ);
}

}  // namespace
}  // namespace rockfold::test
