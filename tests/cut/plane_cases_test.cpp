// Boxes cut by through-going planes, against exact answers.
#include "tests/cut/models/plane_cases.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/cut/oracles/complex_check.hpp"

namespace rockfold::test {
namespace {

class PlaneCases : public testing::TestWithParam<PlaneCase> {};

// A block's volume differs from the exact one (a) because a given plane is off by the rounding of its point: at most
// that times the block's surface; (b) because its corners are rounded: at most 1e-14·L times the surface, and never more
// than 1e-9 of the volume, since exact arithmetic measures what doubles cannot.
TEST_P(PlaneCases, HaveTheExactCountsAndVolumes) {
  const PlaneCase& c = GetParam();
  const auto [model, offset_error] = model_of(c);
  const Blocks blocks = cut(model);
  const BlockArrays& a = blocks.arrays;
  ASSERT_EQ(a.block_count(), c.blocks);
  EXPECT_EQ(sum_of_counts(a), c.sum);
  EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});

  std::vector<Index> order(a.block_count());
  for (Index b = 0; b < a.block_count(); ++b) order[b] = b;
  std::sort(order.begin(), order.end(),
            [&](Index x, Index y) { return a.volume[x] < a.volume[y]; });
  const Real size = blocks.complex().planes.model_size();
  Index next = 0;
  for (const auto& [count, text] : c.volumes) {
    const long double exact = fraction(text);
    for (Index i = 0; i < count; ++i) {
      const Index b = order[next++];
      const Real surface = surface_area(a, b);
      const Real allowed = 1.01 * offset_error * surface +
                           std::min(1e-14 * size * surface, 1e-9 * static_cast<Real>(exact));
      EXPECT_LE(std::abs(a.volume[b] - exact), allowed) << "block " << b << " of volume " << text;
    }
  }
  const Real box = (c.high[0] - c.low[0]) * (c.high[1] - c.low[1]) * (c.high[2] - c.low[2]);
  EXPECT_NEAR(sum(a.volume), box, 1e-12 * box);
  EXPECT_NEAR(blocks.cutting.totals.solid_volume, box, 1e-12 * box);
}

// The same planes from the other side: nothing but the sense of the normals changes.
TEST_P(PlaneCases, DoNotDependOnTheSenseOfTheNormals) {
  Model model = model_of(GetParam()).model;
  const Blocks up = cut(model);
  for (std::size_t j = 0; j < model.joints.size(); j += 2) {
    Vec3& n = std::get<Vec3>(model.joints[j].plane.orientation);
    for (Real& x : n) x = -x;
  }
  const Blocks mixed = cut(model);
  EXPECT_EQ(mixed.arrays.volume, up.arrays.volume);
  EXPECT_EQ(mixed.arrays.vertex, up.arrays.vertex);
  EXPECT_EQ(mixed.arrays.corner_vertex, up.arrays.corner_vertex);
  EXPECT_EQ(mixed.arrays.face_normal, up.arrays.face_normal);
}

INSTANTIATE_TEST_SUITE_P(, PlaneCases, testing::ValuesIn(plane_cases()),
                         [](const auto& test) { return test.param.name; });

// The cube's mirror planes by dip and dip direction: all pass through one point, and only because the sines and cosines of
// mirror-image angles are mirror images.
class MirrorPlanes : public testing::Test {
 protected:
  Model model = box_model({-1, -1, -1}, {1, 1, 1});
  void SetUp() override {
    for (const Real dip_direction : {135.0, 225.0})
      add_joint(model, DipOrientation{90, dip_direction}, {});
    for (const Real dip_direction : {0.0, 90.0, 180.0, 270.0})
      add_joint(model, DipOrientation{45, dip_direction}, {});
  }
  void expect_equal_blocks(Index count, const Counts& of_each) {
    const Blocks blocks = cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), count);
    for (Index b = 0; b < count; ++b) {
      EXPECT_EQ(counts_of(blocks.arrays, b), of_each);
      EXPECT_NEAR(blocks.arrays.volume[b], 8.0 / count, 1e-14);
    }
    EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
    EXPECT_EQ(blocks.cutting.totals.intent.doubts, 0);
  }
};

TEST_F(MirrorPlanes, SixOfThemMakeTwentyFourTetrahedra) {
  expect_equal_blocks(24, {4, 6, 4});
}

TEST_F(MirrorPlanes, AllNineMakeFortyEightOrthoschemes) {
  add_joint(model, DipOrientation{0, 0}, {});
  add_joint(model, DipOrientation{90, 0}, {});
  add_joint(model, DipOrientation{90, 90}, {});
  expect_equal_blocks(48, {4, 6, 4});
}

TEST_F(MirrorPlanes, MayBeGivenByTheirOppositeDipDirections) {
  add_joint(model, DipOrientation{90, 315}, {});
  add_joint(model, DipOrientation{90, 45}, {});
  add_joint(model, DipOrientation{45, 360}, {});
  expect_equal_blocks(24, {4, 6, 4});
}

TEST_F(MirrorPlanes, MayMeetElsewhereThanInTheOrigin) {
  const Vec3 centre{512.5, -96.75, 33.125};
  std::get<BoxShape>(model.solids[0].shape) = {{511.5, -97.75, 32.125}, {513.5, -95.75, 34.125}};
  for (Joint& joint : model.joints) joint.plane.point = centre;
  expect_equal_blocks(24, {4, 6, 4});
}

// Angles whose values are not exact: seven planes through a vertical axis, 180/7° apart.
TEST(PlanesThroughALine, MakeOneSectorEach) {
  Model model = box_model({-1, -1, -1}, {1, 1, 1});
  for (int i = 0; i < 7; ++i) add_joint(model, DipOrientation{90, i * 180.0 / 7 + 1}, {});
  const Blocks blocks = cut(model);
  EXPECT_EQ(blocks.arrays.block_count(), 14);
  EXPECT_NEAR(sum(blocks.arrays.volume), 8, 8e-12);
}

TEST(PlanesThroughALine, OfAnyDirection) {
  for (const int planes : {3, 5, 6, 9}) {
    Model model = box_model({-1, -2, -1.5}, {1.25, 1, 1});
    const Vec3 axis{0.3, -0.5, 0.8}, u{0.8, 0, -0.3}, w{0.15, 0.73, 0.4};  // u, w ⟂ axis
    for (int i = 0; i < planes; ++i) {
      const Real t = 3.14159 * i / planes + 0.1;
      const Vec3 n{std::cos(t) * u[0] + std::sin(t) * w[0], std::cos(t) * u[1] + std::sin(t) * w[1],
                   std::cos(t) * u[2] + std::sin(t) * w[2]};
      add_joint(model, n, {0.1, 0.07, -0.05});
    }
    (void)axis;
    const Blocks blocks = cut(model);
    EXPECT_EQ(blocks.arrays.block_count(), 2 * planes);
    EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace rockfold::test
