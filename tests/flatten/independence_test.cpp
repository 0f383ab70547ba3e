// The same joints in another order, or on another number of threads: the same blocks, bit for bit.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <omp.h>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/flatten/array_difference.hpp"

namespace rockfold::test {
namespace {

class Independence : public testing::Test {
 protected:
  void TearDown() override { omp_set_num_threads(threads_before); }
  const int threads_before = omp_get_max_threads();
};

void shuffle(Model& model, unsigned seed) {
  std::mt19937 random(seed);
  std::shuffle(model.joints.begin(), model.joints.end(), random);
  std::shuffle(model.joint_sets.begin(), model.joint_sets.end(), random);
}

Model random_planes(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::normal_distribution<Real> gauss;
  std::uniform_real_distribution<Real> unit;
  Model model = box_model({0, 0, 0}, {10, 7, 5});
  for (int i = 0; i < count; ++i)
    add_joint(model, Vec3{gauss(random), gauss(random), gauss(random)},
              {10 * unit(random), 7 * unit(random), 5 * unit(random)});
  return model;
}

Model three_sets(Real spacing) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_set(model, DipOrientation{60, 90}, spacing, {});
  add_set(model, DipOrientation{70, 200}, 1.1 * spacing, {});
  add_set(model, DipOrientation{20, 320}, 0.9 * spacing, {0.1, 0, 0});
  return model;
}

// Steps, a cavity, a touching second solid, and sets whose planes fall on faces: merged faces with holes, several cells a
// block, coplanar faces of different origin.
Model solids_and_sets() {
  Model model = box_model({0, 0, 0}, {8, 8, 8});
  model.solids.push_back(box_solid("step", {4, -1, 4}, {9, 9, 9}, false));
  model.solids.push_back(box_solid("cave", {1, 1, 1}, {3, 3, 3}, false));
  model.solids.push_back(box_solid("ledge", {8, 2, 0}, {10, 12, 3}));
  add_set(model, DipOrientation{0, 0}, 2, {0, 0, 0});
  add_set(model, DipOrientation{55, 77}, 3, {4, 4, 4});
  add_joint(model, Vec3{1, 1, 0}, {4, 4, 4});
  add_joint(model, Vec3{1, -1, 0}, {4, 4, 4});
  add_joint(model, Vec3{0, 1, 1}, {4, 4, 4});
  return model;
}

void expect_independent_of_order(const Model& model) {
  const BlockArrays expected = cut(model).arrays;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Model shuffled = model;
    shuffle(shuffled, seed);
    EXPECT_EQ(first_difference(expected, cut(shuffled).arrays), "") << "shuffle " << seed;
  }
}

TEST_F(Independence, OfTheOrderOfRandomPlanes) {
  for (unsigned seed = 0; seed < 10; ++seed) expect_independent_of_order(random_planes(seed, 30));
}
TEST_F(Independence, OfTheOrderOfJointSets) {
  expect_independent_of_order(three_sets(1));
}
TEST_F(Independence, OfTheOrderOfJointsInSolids) {
  expect_independent_of_order(solids_and_sets());
}

// Planes that nearly meet, within and about the tolerance: what is decided does not depend on who asks first. Where five
// or more planes miss a point by about the tolerance no answer is right, and cutting may say so: then in any order.
TEST_F(Independence, OfTheOrderOfNearlyConcurrentPlanes) {
  std::mt19937 random(3);
  std::normal_distribution<Real> gauss;
  const auto outcome = [](const Model& model, BlockArrays& arrays) -> std::string {
    try {
      arrays = cut(model).arrays;
      return "";
    } catch (const Error& error) {
      return error.what();
    }
  };
  for (int i = 0; i < 40; ++i) {
    Model model = box_model({-5, -5, -5}, {5, 5, 5});
    for (int j = 0; j < 8; ++j) {
      const Vec3 n = normalized({gauss(random), gauss(random), gauss(random)});
      add_joint(model, n, (17 * std::pow(10.0, -12 + i % 5) * gauss(random)) * n);
    }
    BlockArrays expected, found;
    const std::string message = outcome(model, expected);
    for (unsigned seed = 1; seed <= 3; ++seed) {
      Model shuffled = model;
      shuffle(shuffled, seed);
      EXPECT_EQ(outcome(shuffled, found), message);
      EXPECT_EQ(first_difference(expected, found), "");
    }
  }
}

// Joints that coincide to the tolerance but not exactly, so that the first of them defines the plane.
TEST_F(Independence, OfTheOrderOfJointsThatCoincide) {
  Model model = random_planes(5, 12);
  for (int i = 0; i < 6; ++i) {
    Joint twin = model.joints[i];
    twin.plane.point[i % 3] += (i % 2 ? 1e-10 : -1e-10);
    model.joints.push_back(
        twin);  // the same name: which of the two a face is named after does not show
  }
  expect_independent_of_order(model);
}

TEST_F(Independence, OfTheNumberOfThreads) {
  for (const Model& model : {random_planes(1, 40), three_sets(0.8), solids_and_sets()}) {
    omp_set_num_threads(1);
    const Blocks one = cut(model);
    for (const int threads : {2, 3, 4}) {
      omp_set_num_threads(threads);
      const Blocks many = cut(model);
      EXPECT_EQ(first_difference(one.arrays, many.arrays), "") << threads << " threads";
      EXPECT_EQ(many.cutting.totals.intent.doubts, one.cutting.totals.intent.doubts);
      EXPECT_EQ(many.cutting.totals.joint_area, one.cutting.totals.joint_area);
      EXPECT_EQ(many.cutting.totals.cells, one.cutting.totals.cells);
      EXPECT_EQ(many.cutting.totals.solid_volume, one.cutting.totals.solid_volume);
    }
  }
}

// Bit for bit the same is more than the blocks: totals are sums, and sums depend on order.
TEST_F(Independence, OfTotalsToo) {
  const Model model = three_sets(0.9);
  const CutTotals expected = cut(model).cutting.totals;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Model shuffled = model;
    shuffle(shuffled, seed);
    const CutTotals found = cut(shuffled).cutting.totals;
    EXPECT_EQ(found.joint_area, expected.joint_area);
    EXPECT_EQ(found.solid_volume, expected.solid_volume);
    EXPECT_EQ(found.cells, expected.cells);
  }
}

}  // namespace
}  // namespace rockfold::test
