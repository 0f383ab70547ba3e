// The plane cases under affine maps, near the origin and at map coordinates, with planes off by noise far below the tolerance: the
// same blocks, in any order of the joints and on any number of threads.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/cut/models/draw.hpp"
#include "tests/cut/models/plane_cases.hpp"
#include "tests/cut/oracles/conservation.hpp"
#include "tests/cut/oracles/voxel_oracle.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> none_differ;

struct Place {
  std::string name;
  AffineMap map;
  Real rounding;  // of a corner, over the model's size
};

const std::vector<Place>& places() {
  static const std::vector<Place> list = [] {
    const std::array<std::array<Vec3, 3>, 3> columns{
        {{{{2, 1, 0}, {0, 1, 0.5}, {1, 0, 3}}},
         {{{1.3, -0.2, 0.7}, {0.1, 0.9, 0.3}, {-0.4, 0.6, 1.1}}},
         {{{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}}}}};
    std::vector<Place> all;
    for (const auto& c : columns) {
      const std::string name = "map " + std::to_string(all.size() / 2);
      all.push_back({name, {c, {0.1, -0.2, 0.3}}, 1e-15});
      all.push_back(
          {name + ", far away", {{100 * c[0], 100 * c[1], 100 * c[2]}, {5e5, 4e6, 300}}, 1e-11});
    }
    return all;
  }();
  return list;
}

struct Placed {
  Model model;
  Real size;
};

// Each plane's point is off by up to `noise`·size along each axis, and its unit normal by up to `noise`.
Placed place(const PlaneCase& c, const AffineMap& map, Real noise, unsigned seed) {
  Draw draw(seed);
  const auto off = [&](Vec3 x, Real by) {
    for (Real& v : x) v += draw.uniform(-by, by);
    return x;
  };
  const Vec3 diagonal = map(c.high) - map(c.low);
  Placed placed{{}, norm(diagonal)};
  const auto normal = [&](const Vec3& n) {
    return normalized(n[0] * map.square(0) + n[1] * map.square(1) + n[2] * map.square(2));
  };
  std::vector<std::pair<Vec3, Vec3>> faces;
  for (int d = 0; d < 3; ++d)
    for (const bool upper : {false, true}) {
      Vec3 n{};
      n[d] = (upper ? 1 : -1) * (map.determinant() > 0 ? 1 : -1);
      faces.emplace_back(normal(n), map(upper ? c.high : c.low));
    }
  placed.model.solids.push_back(convex_solid("rock", faces));
  for (Joint& j : model_of(c).model.joints)
    add_joint(placed.model, off(normal(std::get<Vec3>(j.plane.orientation)), noise),
              off(map(j.plane.point), noise * placed.size));
  draw.shuffle(placed.model.joints);
  return placed;
}

class PlaneCasesWithNoise : public testing::TestWithParam<PlaneCase> {
 protected:
  const PlaneCase& c = GetParam();

  // A plane's noise moves a block's volume by less than its area, below 2·size², times some 2·noise·size for tilt and shift; 10
  // planes at most bound a block. Slivers of F4a: 1e-9 m.
  void expect_blocks(const Blocks& blocks, const Place& at, Real noise, Real size) {
    const BlockArrays& a = blocks.arrays;
    ASSERT_EQ(a.block_count(), c.blocks);
    EXPECT_EQ(sum_of_counts(a), c.sum);
    for (Index b = 0; b < a.block_count(); ++b) {
      EXPECT_EQ(a.genus[b], 0);
      EXPECT_EQ(a.shell_count[b], 1);
    }
    std::vector<Real> found = a.volume, expected;
    std::sort(found.begin(), found.end());
    const Real scale = std::abs(at.map.determinant());
    for (const auto& [count, text] : c.volumes)
      expected.insert(expected.end(), count, static_cast<Real>(fraction(text)) * scale);
    const Real tolerance =
        40 * (noise + at.rounding) * size * size * size + (c.name == "F4a" ? 2e-9 * scale : 0);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], tolerance);
    EXPECT_NEAR(sum(found), blocks.cutting.totals.solid_volume, 1e-12 * sum(found));
  }
};

TEST_P(PlaneCasesWithNoise, HaveTheSameBlocks) {
  unsigned seed = 0;
  for (const Place& at : places())
    for (const Real noise : {0.0, 1e-14, 1e-13, 1e-12, 1e-11}) {
      SCOPED_TRACE(testing::Message() << at.name << ", noise " << noise << ", seed " << ++seed);
      try {
        const Placed placed = place(c, at.map, noise, seed);
        expect_blocks(cut(placed.model), at, noise, placed.size);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

TEST_P(PlaneCasesWithNoise, DoNotDependOnOrderAndThreads) {
  for (const Place& at : places())
    for (const Real noise : {0.0, 1e-11}) {
      SCOPED_TRACE(testing::Message() << at.name << ", noise " << noise);
      try {
        const Placed placed = place(c, at.map, noise, 7);
        EXPECT_EQ(dependences(placed.model, placed.size), none_differ);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

INSTANTIATE_TEST_SUITE_P(, PlaneCasesWithNoise, testing::ValuesIn(plane_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace rockfold::test
