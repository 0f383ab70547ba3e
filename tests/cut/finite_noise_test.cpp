// The finite cases under oblique maps, near the origin and at map coordinates, with corners off by noise far below the tolerance: the
// same blocks, in any order of the joints and on any number of threads. finite_joint_cases_test.cpp has them without noise.
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/draw.hpp"
#include "tests/cut/models/finite_joint_cases.hpp"
#include "tests/cut/oracles/conservation.hpp"

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
    const std::array<std::array<Vec3, 3>, 2> columns{
        {{{{2, 1, 0}, {0, 1, 0.5}, {1, 0, 3}}},
         {{{1.3, -0.2, 0.7}, {0.1, 0.9, 0.3}, {-0.4, 0.6, 1.1}}}}};
    std::vector<Place> all;
    for (const auto& c : columns) {
      const std::string name = "map " + std::to_string(all.size() / 2);
      all.push_back({name, {c, {0.1, -0.2, 0.3}}, 1e-15});
      all.push_back(
          {name + ", far away", {{100 * c[0], 100 * c[1], 100 * c[2]}, {5e5, 4e6, 300}}, 1e-12});
    }
    return all;
  }();
  return list;
}

class FiniteCasesWithNoise : public testing::TestWithParam<FiniteJointCase> {
 protected:
  const GridModel grid = grid_model(GetParam());

  Real size(const AffineMap& map) const {
    return norm(map({1.0 * grid.size[0], 1.0 * grid.size[1], 1.0 * grid.size[2]}) - map({}));
  }
  Placing placing(const Place& at, Real noise, unsigned seed) const {
    return {.map = at.map,
            .straight = false,
            .noise = noise * size(at.map),
            .normals_of_corners = seed % 2 == 0,
            .prisms = noise == 0 && seed % 3 == 0,
            .seed = seed};
  }
};

// Volumes are off by the noise times the surface, some 10 times the volume over the size; dead-end areas likewise.
TEST_P(FiniteCasesWithNoise, HaveTheSameBlocks) {
  unsigned seed = 0;
  for (const Place& at : places())
    for (const Real noise : {0.0, 1e-14, 1e-13, 1e-12, 1e-11}) {
      SCOPED_TRACE(testing::Message() << at.name << ", noise " << noise << ", seed " << ++seed);
      GridModel shuffled = grid;
      Draw(seed).shuffle(shuffled.joints);
      try {
        const Blocks found = cut(model_of(shuffled, placing(at, noise, seed)));
        // Planes that noise parts overlap as two layers, each with its own name and area (G27).
        if (found.cutting.totals.intent.slivers == 0 || GetParam().name != "G27") {
          EXPECT_EQ(differences(found, blocks_of(shuffled), at.map, 100 * (noise + at.rounding)),
                    none_differ);
        }
        EXPECT_NEAR(sum(found.arrays.volume) / found.cutting.totals.solid_volume, 1, 1e-12);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

// Where coplanar joints overlap (G27) the first listed has the area: not the same in another order.
TEST_P(FiniteCasesWithNoise, DoNotDependOnOrderAndThreads) {
  for (const Place& at : places())
    for (const Real noise : {0.0, 1e-11}) {
      SCOPED_TRACE(testing::Message() << at.name << ", noise " << noise);
      try {
        EXPECT_EQ(dependences(model_of(grid, placing(at, noise, 4)), size(at.map),
                              GetParam().name != "G27"),
                  none_differ);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

INSTANTIATE_TEST_SUITE_P(, FiniteCasesWithNoise, testing::ValuesIn(finite_joint_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace rockfold::test
