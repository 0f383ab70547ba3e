// Rotations about edges and corners: toppling columns by the closed form, overhanging slabs, and
// random blocks whose rotation is carried out.
#include "host/keyblock/motions/rotation.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/bodies.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/motions/least_support.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::model_with_joints;
using test::radians;
using test::Side;

/// A column of width b (down the dip), height h and depth 1.3 on a joint that dips to +x.
BlockArrays column_on_a_slope(Real dip, Real b, Real h) {
  test::BlockArraysBuilder builder;
  const Index base = builder.joint("base"), free = builder.solid_face("free");
  const Vec3 down{std::cos(radians(dip)), 0, -std::sin(radians(dip))};
  const Vec3 out{std::sin(radians(dip)), 0, std::cos(radians(dip))};
  const Vec3 at{2, 3, 5};
  builder.block(test::convex_block({{-out, at, base},
                                    {out, at + h * out, free},
                                    {down, at + b * down, free},
                                    {-down, at, free},
                                    {{0, 1, 0}, at + Vec3{0, 1.3, 0}, free},
                                    {{0, -1, 0}, at, free}}));
  builder.rock();
  return builder.blocks;
}

// Goodman & Bray (1976): a column topples where b/h < tan ψ and does not slide where φ > ψ.
TEST(Rotation, OfAColumnOnASlopeIsTopplingByTheClosedForm) {
  for (const Real dip : {10.0, 25.0, 40.0})
    for (const Real slenderness : {1.5, 3.0, 8.0}) {
      const Real b = 0.7, h = slenderness * b;
      const auto report = find_keyblocks(column_on_a_slope(dip, b, h), model_with_joints(80));
      const Real safety = b / (h * std::tan(radians(dip)));
      const Real sliding = std::tan(radians(80)) / std::tan(radians(dip));
      EXPECT_EQ(report.keyblocks.size(), safety < 1 ? 1u : 0u) << dip << " " << slenderness;
      const Keyblock& key = safety < 1 ? report.keyblocks.at(0) : report.stable.at(0);
      EXPECT_EQ(key.mode, SlidingMode::rotation);
      EXPECT_LT(safety, sliding);
      EXPECT_NEAR(key.factor_of_safety, safety, 1e-9);
      ASSERT_FALSE(key.rotations.empty());
      EXPECT_EQ(key.rotations[0].about, Rotation::About::edge);
      EXPECT_NEAR(key.rotations[0].driving, key.weight * std::sin(radians(dip)) * h / 2, 1e-6);
      EXPECT_NEAR(key.rotations[0].resisting, key.weight * std::cos(radians(dip)) * b / 2, 1e-6);
      EXPECT_NEAR(std::abs(key.rotations[0].axis[1]), 1, 1e-12);
      EXPECT_EQ(key.planes, std::vector<std::string>{"base"});
    }
}

TEST(Rotation, GovernsOnlyWhereItIsLessSafeThanSliding) {
  const auto blocks = column_on_a_slope(40, 1, 1);  // b/h / tan ψ = 1.19
  const auto slides = find_keyblocks(blocks, model_with_joints(39)).keyblocks.at(0);
  EXPECT_EQ(slides.mode, SlidingMode::single_plane);
  ASSERT_FALSE(slides.rotations.empty());
  EXPECT_GT(slides.rotations[0].factor_of_safety(), slides.factor_of_safety);
  const auto slender = column_on_a_slope(40, 1, 2);
  const auto turns = find_keyblocks(slender, model_with_joints(39)).keyblocks.at(0);
  EXPECT_EQ(turns.mode, SlidingMode::rotation);  // slides too, but less so
}

TEST(Rotation, CanBeSwitchedOff) {
  Model model = model_with_joints(80);
  model.support->rotation = false;
  const auto report = find_keyblocks(column_on_a_slope(25, 0.7, 5), model);
  EXPECT_TRUE(report.keyblocks.empty());
}

// The support of a toppling column acts at the middle of its free faces.
TEST(Rotation, SupportBringsItToTheTarget) {
  const auto key =
      find_keyblocks(column_on_a_slope(25, 0.7, 5), model_with_joints(80)).keyblocks.at(0);
  const Rotation& rotation = key.rotations[0];
  // About the axis, at any point q that the reported direction is tangential to: the lever arm is
  // what the force's definition says: F (M_d − P a) = M_r.
  const Real arm = (1.5 * rotation.driving - rotation.resisting) / (1.5 * key.support_force);
  EXPECT_GT(arm, 0.5 * 5);  // the free faces' centre is higher than the block's
  EXPECT_LT(arm, 5);
  EXPECT_LT(dot(key.support_direction, key.direction), 0);
}

// Columns that would slide and turn: the support that is told holds both, and is never less than for sliding alone.
TEST(Rotation, SupportHoldsSlidingTooAndEachOfTheTurns) {
  int both = 0;
  for (const Real dip : {20.0, 30.0, 40.0})
    for (const Real width : {0.5, 1.0, 1.6, 2.5})
      for (const Real phi : {12.0, 25.0, 35.0}) {
        SCOPED_TRACE(testing::Message() << dip << " " << width << " " << phi);
        const BlockArrays blocks = column_on_a_slope(dip, width, 3);
        Model model = model_with_joints(phi);
        const auto found = [&] {
          const auto report = find_keyblocks(blocks, model);
          return (report.keyblocks.empty() ? report.stable : report.keyblocks).at(0);
        };
        const Keyblock key = found();
        const Vec3 p = key.support_force * key.support_direction;
        const auto bodies = Bodies(blocks, model);
        const std::vector<Index> batch(static_cast<std::size_t>(blocks.block_count()), 0);
        const Vec3 at = bodies.free_centre(bodies.body({key.block}, batch));
        auto conditions = support_conditions(key.contact, *key.movement, 1.5);
        bool slides = conditions[0].deficit > 0, turns = false;
        for (const Rotation& rotation : key.rotations) {
          conditions.push_back(support_condition(rotation, at, 1.5));
          turns |= conditions.back().deficit > 0;
        }
        for (const SupportCondition& c : conditions)
          EXPECT_GE(dot(c.gain, p) - c.deficit, -1e-6 * std::abs(c.deficit));
        both += slides && turns;
        model.support->rotation = false;
        EXPECT_GE(key.support_force, found().support_force * (1 - 1e-12));
      }
  EXPECT_GT(both, 5);
}

/// A horizontal slab [0,a]×[0,a] at z = 1 … 1.5 that rests on one cube, and on others that fall.
BlockArrays overhanging_slab(Real a, bool along_an_edge) {
  test::BlockArraysBuilder builder;
  const Index joint = builder.joint("bed"), free = builder.solid_face("free");
  const auto box = [&](const Vec3& low, const Vec3& high, Index bottom, Index top) {
    return test::convex_block({{{-1, 0, 0}, low, free},
                               {{1, 0, 0}, high, free},
                               {{0, -1, 0}, low, free},
                               {{0, 1, 0}, high, free},
                               {{0, 0, -1}, low, bottom},
                               {{0, 0, 1}, high, top}});
  };
  const Real deep = along_an_edge ? a : 1;
  builder.block(box({0, 0, 1}, {a, a, 1.5}, joint, free));
  builder.block(box({0, 0, 0}, {1, deep, 1}, joint, joint));
  builder.rock();
  // The builder takes faces of equal area for neighbours: say by hand that the slab lies on the cube.
  auto& blocks = builder.blocks;
  std::erase_if(blocks.interfaces, [](const auto& i) { return i.block[0] == 0; });
  std::erase_if(blocks.interfaces, [&](const auto& i) {
    return i.block[0] == 1 && blocks.face_normal[static_cast<std::size_t>(i.face[0])][2] > 0;
  });
  Index under_slab = none, on_cube = none;
  for (Index f = 0; f < blocks.face_begin[1]; ++f)
    if (blocks.face_normal[static_cast<std::size_t>(f)][2] < 0) under_slab = f;
  for (Index f = blocks.face_begin[1]; f < blocks.face_begin[2]; ++f)
    if (blocks.face_normal[static_cast<std::size_t>(f)][2] > 0) on_cube = f;
  blocks.interfaces.insert(blocks.interfaces.begin(),
                           {.block = {0, 1}, .face = {under_slab, on_cube}, .area = deep});
  return blocks;
}

TEST(Rotation, OfASlabThatOverhangsIsAboutTheEdgeOfWhatIsLeftUnderIt) {
  const auto turning = find_keyblocks(overhanging_slab(2.2, true), model_with_joints(30));
  ASSERT_EQ(turning.keyblocks.size(), 1u);
  const Keyblock& key = turning.keyblocks[0];
  EXPECT_EQ(key.mode, SlidingMode::rotation);
  ASSERT_FALSE(key.rotations.empty());
  EXPECT_EQ(key.rotations[0].about, Rotation::About::edge);
  EXPECT_NEAR(key.rotations[0].point[0], 1, 1e-12);
  EXPECT_NEAR(key.rotations[0].axis[1], 1, 1e-12);  // +x end goes down
  EXPECT_TRUE(std::isnan(key.factor_of_safety));
  EXPECT_NEAR(key.rotations[0].driving, key.weight * 0.1, 1e-9 * key.weight);
  EXPECT_TRUE(find_keyblocks(overhanging_slab(1.9, true), model_with_joints(30)).keyblocks.empty());
}

TEST(Rotation, OfASlabOnOneOfItsCornersIsAboutTheCornerOfItsSupport) {
  const auto report = find_keyblocks(overhanging_slab(2.2, false), model_with_joints(30));
  ASSERT_EQ(report.keyblocks.size(), 1u);
  const Rotation& rotation = report.keyblocks[0].rotations[0];
  EXPECT_EQ(rotation.about, Rotation::About::corner);
  EXPECT_LT(norm(rotation.point - Vec3{1, 1, 1}), 1e-12);
  EXPECT_LT(norm(rotation.axis - normalized({-1, 1, 0})), 1e-9);  // by symmetry
}

/// Some faces of a random convex block in contact, and a load.
struct RandomCase {
  std::vector<ContactPatch> patches;
  RigidBody body;
};
RandomCase random_case(std::mt19937_64& random) {
  std::normal_distribution<Real> normal;
  const auto direction = [&] {
    return normalized({normal(random), normal(random), normal(random)});
  };
  std::vector<Side> sides;
  for (const Vec3& n : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1},
                        Vec3{0, 0, -1}})
    sides.push_back({n, 1.0 * n, 0});
  for (int i = 0; i < 3; ++i) {
    const Vec3 n = direction();
    sides.push_back({n, (0.3 + 0.5 * std::abs(normal(random))) * n, 0});
  }
  const auto block = test::convex_block(sides);
  RandomCase made;
  for (const auto& face : block.faces)
    if (random() % 3 == 0)
      made.patches.push_back(
          {face.side.normal, face.corners, static_cast<Index>(made.patches.size())});
  made.body = {
      .centroid = block.centroid,
      .inertia = {{{1 + 0.2 * std::abs(normal(random)), 0.1, 0}, {0.1, 1.3, 0.05}, {0, 0.05, 0.9}}},
      .mass = 2,
      .force = direction(),
      .moment = (0.1 * normal(random)) * direction()};
  return made;
}

// What is said to turn is turned by a small angle: no corner of a contact enters the rock by more
// than the second order, and the loads do work.
TEST(Rotation, OfRandomBlocksEntersNoRockAndIsDriven) {
  std::mt19937_64 random(41);
  int edges = 0, corners = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const RandomCase made = random_case(random);
    const auto rotation = find_rotation(made.patches, made.body);
    if (!rotation) continue;
    (rotation->about == Rotation::About::edge ? edges : corners) += 1;
    const Real angle = 1e-5;
    for (const ContactPatch& patch : made.patches)
      for (const Vec3& x : patch.corners) {
        const Vec3 moved = rotation->point +
                           test::rotated(x - rotation->point, rotation->axis, test::degrees(angle));
        EXPECT_LE(dot(moved - x, patch.normal), 10 * angle * angle);
      }
    const Vec3 centroid = rotation->point + test::rotated(made.body.centroid - rotation->point,
                                                          rotation->axis, test::degrees(angle));
    const Real work = dot(made.body.force, centroid - made.body.centroid) +
                      angle * dot(made.body.moment, rotation->axis);
    EXPECT_NEAR(work / angle, rotation->driving - rotation->resisting, 1e-4);
  }
  EXPECT_GT(edges, 100);
  EXPECT_GT(corners, 20);
}

TEST(Rotation, TurnsWithTheModel) {
  std::mt19937_64 random(43);
  std::normal_distribution<Real> normal;
  int found = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const RandomCase made = random_case(random);
    const Vec3 axis = normalized({normal(random), normal(random), normal(random)});
    const Real angle = 180 * normal(random);
    const auto turned = [&](const Vec3& x) { return test::rotated(x, axis, angle); };
    RandomCase other = made;
    for (ContactPatch& patch : other.patches) {
      patch.normal = turned(patch.normal);
      for (Vec3& x : patch.corners) x = turned(x);
    }
    const Mat3 q{{turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})}};  // columns as rows
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        Real sum = 0;
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) sum += q[a][i] * made.body.inertia[a][b] * q[b][k];
        other.body.inertia[i][k] = sum;
      }
    other.body.centroid = turned(made.body.centroid);
    other.body.force = turned(made.body.force);
    other.body.moment = turned(made.body.moment);
    const auto before = find_rotation(made.patches, made.body);
    const auto after = find_rotation(other.patches, other.body);
    ASSERT_EQ(before.has_value(), after.has_value());
    if (!before) continue;
    ++found;
    EXPECT_NEAR(after->driving, before->driving, 1e-10);
    EXPECT_NEAR(after->resisting, before->resisting, 1e-10);
    EXPECT_LT(norm(after->axis - turned(before->axis)), 1e-10);
  }
  EXPECT_GT(found, 200);
}

}  // namespace
}  // namespace rockfold
