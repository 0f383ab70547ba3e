// Joint sets alone: largest blocks of tunnels against a sum of convex pieces, Hoek & Bray's wedge in
// a slope, the tables of three sets, scans.
#include "host/keyblock/theory/theory.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "host/keyblock/theory/slope_block.hpp"
#include "host/keyblock/theory/tunnel_block.hpp"
#include "src/base/vector.hpp"
#include "src/model/tunnel_section.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::Side;
using test::upward;

Vec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<Real> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

Real cross2(const Point2& a, const Point2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// The block of a pyramid with its apex at a point of the section's plane, as the sum of the convex
/// pieces over each edge of the section that faces the apex: joints, edge, and two planes through
/// the apex along the axis.
TheoryShape sum_of_pieces(const TunnelFrame& frame, const std::vector<Vec3>& normals,
                          const Point2& apex) {
  TheoryShape sum;
  sum.joint_area.assign(normals.size(), 0);
  const Vec3 at = frame.lifted(apex);
  const auto& section = frame.section;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Point2 &a = section[i], &b = section[(i + 1) % section.size()];
    const Point2 edge{b[0] - a[0], b[1] - a[1]}, to_apex{apex[0] - a[0], apex[1] - a[1]};
    if (cross2(edge, to_apex) >= -1e-12) continue;  // inside of the section, or beside it
    std::vector<Side> sides;
    for (std::size_t n = 0; n < normals.size(); ++n)
      sides.push_back({normals[n], at, static_cast<Index>(n)});
    const auto plane = [&](const Point2& from, const Point2& to, const Point2& inside,
                           Index origin) {
      const Vec3 along = frame.lifted({to[0] - from[0], to[1] - from[1]});
      Vec3 n = normalized(cross(along, frame.axis));
      const Vec3 x = frame.lifted(from);
      if (dot(n, frame.lifted(inside) - x) > 0) n = -n;
      const bool joint = std::any_of(normals.begin(), normals.end(),
                                     [&](const Vec3& m) { return norm(m - n) < 1e-9; });
      if (!joint) sides.push_back({n, x, origin});  // a face counted once
    };
    const Index cut = static_cast<Index>(normals.size()), free = cut + 1;
    plane(apex, a, b, cut);
    plane(apex, b, a, cut);
    plane(a, b, apex, free);
    const auto piece = test::convex_block(sides);
    if (piece.faces.size() < 4) continue;
    sum.volume += piece.volume;
    for (const auto& face : piece.faces) {
      if (face.side.origin == free) sum.free_area += face.area;
      if (face.side.origin < cut)
        sum.joint_area[static_cast<std::size_t>(face.side.origin)] += face.area;
    }
  }
  return sum;
}

void expect_equal(const TheoryShape& a, const TheoryShape& b, const char* what) {
  EXPECT_NEAR(a.volume, b.volume, 1e-6 * b.volume) << what;
  EXPECT_NEAR(a.free_area, b.free_area, 1e-6 * b.free_area) << what;
  for (std::size_t i = 0; i < a.joint_area.size(); ++i)
    EXPECT_NEAR(a.joint_area[i], b.joint_area[i], 1e-6 * b.volume + 1e-6 * b.joint_area[i]) << what;
}

TEST(TunnelBlocks, EqualTheSumOfTheirConvexPieces) {
  std::mt19937_64 random(61);
  std::uniform_real_distribution<Real> unit;
  const std::vector<Section> sections{circle_section(2, 24), horseshoe_section(5, 5, 12),
                                      rectangle_section(4, 3), d_shape_section(4, 5, 8)};
  int blocks = 0, inner = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const auto frame = tunnel_frame(360 * unit(random), 60 * unit(random),
                                    sections[static_cast<std::size_t>(trial) % sections.size()]);
    std::vector<Vec3> joints;
    for (int i = 0; i < 3; ++i) joints.push_back(random_direction(random));
    int removable = 0;
    for (const std::string& code : codes_of(3, 3)) {
      const auto normals = joint_pyramid(joints, code);
      const auto pyramid = TunnelPyramid::make(frame, normals);
      if (!pyramid) continue;
      ++removable;
      if (norm(frame.lifted(pyramid->apex())) > 100) continue;  // needles: the pieces lose digits
      ++blocks;
      const TheoryShape block = pyramid->maximum_block();
      expect_equal(block, sum_of_pieces(frame, normals, pyramid->apex()), code.c_str());
      // Nearer apexes: between the apex and a corner of the section that it faces.
      for (const Real share : {0.3, 0.8}) {
        const Point2& to = frame.section[random() % frame.section.size()];
        const Point2 apex{pyramid->apex()[0] + share * (to[0] - pyramid->apex()[0]),
                          pyramid->apex()[1] + share * (to[1] - pyramid->apex()[1])};
        const auto smaller = pyramid->block_at(apex);
        if (!smaller) continue;
        ++inner;
        EXPECT_LT(smaller->volume, block.volume);
        expect_equal(*smaller, sum_of_pieces(frame, normals, apex), code.c_str());
      }
    }
    EXPECT_EQ(removable, 6);  // n² − n of three joints in general position
  }
  EXPECT_GT(blocks, 400);
  EXPECT_GT(inner, 200);
}

TEST(TunnelBlocks, OnTheRoofOfARectangleAreTetrahedra) {
  const auto frame = tunnel_frame(20, 0, rectangle_section(4, 3));
  const std::vector<Vec3> joints{upward(60, 30), upward(60, 150), upward(60, 270)};
  const auto normals = joint_pyramid(joints, "111");
  const auto pyramid = TunnelPyramid::make(frame, normals);
  ASSERT_TRUE(pyramid);
  const Vec3 apex = frame.lifted(pyramid->apex());
  std::vector<Side> sides{{{0, 0, -1}, {0, 0, 3}, 3}};
  for (Index i = 0; i < 3; ++i) sides.push_back({normals[static_cast<std::size_t>(i)], apex, i});
  const auto block = test::convex_block(sides);
  const TheoryShape shape = pyramid->maximum_block();
  EXPECT_NEAR(shape.volume, block.volume, 1e-9 * block.volume);
  for (const auto& face : block.faces)
    EXPECT_NEAR(face.side.origin == 3
                    ? shape.free_area
                    : shape.joint_area[static_cast<std::size_t>(face.side.origin)],
                face.area, 1e-9);
  // The tetrahedron is as wide as the roof, seen along the axis.
  Real low = 1e9, high = -1e9;
  for (const auto& face : block.faces)
    for (const Vec3& x : face.corners) {
      low = std::min(low, frame.flat(x)[0]);
      high = std::max(high, frame.flat(x)[0]);
    }
  EXPECT_NEAR(high - low, 4, 1e-9);
}

// A joint along the axis: its face is seen as a side of the angle.
TEST(TunnelBlocks, WithAJointAlongTheAxis) {
  const auto frame = tunnel_frame(0, 0, circle_section(2, 32));
  const std::vector<Vec3> joints{upward(60, 90), upward(50, 200),
                                 upward(70, 300)};  // the first along it
  int found = 0;
  for (const std::string& code : codes_of(3, 3)) {
    const auto normals = joint_pyramid(joints, code);
    const auto pyramid = TunnelPyramid::make(frame, normals);
    if (!pyramid) continue;
    ++found;
    expect_equal(pyramid->maximum_block(), sum_of_pieces(frame, normals, pyramid->apex()),
                 code.c_str());
  }
  EXPECT_GT(found, 0);
}

/// 60/030, 60/150, 60/270 with φ = 20 and a slope, a tunnel and 2000 kg/m³.
Model three_sets() {
  Model model = test::model_with_joints(20);
  for (const Real direction : {30.0, 150.0, 270.0}) {
    JointSet set;
    set.name = "J" + std::to_string(model.joint_sets.size() + 1);
    set.orientation = DipOrientation{60, direction};
    set.spacing = 1;
    model.joint_sets.push_back(set);
  }
  model.theory = TheorySpec{};
  return model;
}

TEST(PyramidTable, OfThreeSetsIsThatOfBlockTheory) {
  Model model = three_sets();
  model.theory->tunnels.push_back({"adit", 20, 10, circle_section(2, 16), {}});
  model.theory->slopes.push_back({"cut", {60, 180}, {0, 180}, 10, {}});
  const TheoryReport report = joint_set_theory(model);
  ASSERT_EQ(report.pyramids.size(), 8u);
  EXPECT_EQ(report.pyramids[4].code, "100");
  std::set<std::string> held;
  for (const PyramidEntry& entry : report.pyramids) {
    EXPECT_TRUE(entry.exists);
    const auto& from = entry.removable_from;
    if (std::find(from.begin(), from.end(), "adit") == from.end()) held.insert(entry.code);
    const auto above = std::count(entry.code.begin(), entry.code.end(), '0');
    EXPECT_EQ(entry.unit.key, above < 3) << entry.code;
    if (above == 3) continue;
    const Real force[] = {1, 0.68404, 0.23869};
    EXPECT_NEAR(entry.unit.movement->sliding_force(), force[above], 5e-6) << entry.code;
  }
  EXPECT_EQ(held, (std::set<std::string>{"011", "100"}));
  for (const PyramidEntry& entry : report.pyramids)
    EXPECT_EQ(std::find(entry.removable_from.begin(), entry.removable_from.end(), "cut") !=
                  entry.removable_from.end(),
              entry.code == "100" || entry.code == "000")  // the face, and the ground behind
        << entry.code;
  ASSERT_EQ(report.excavations.size(), 2u);
  EXPECT_EQ(report.excavations[0].blocks.size(), 6u);
}

// Case E1 on the program's own table.
TEST(PyramidTable, OfSetsInGeneralPositionHasTheCountsOfBlockTheory) {
  std::mt19937_64 random(67);
  for (std::size_t n = 3; n <= 6; ++n) {
    Model model = test::model_with_joints(30);
    for (std::size_t i = 0; i < n; ++i) {
      JointSet set;
      set.name = std::to_string(i);
      set.orientation = random_direction(random);
      model.joint_sets.push_back(set);
    }
    model.theory = TheorySpec{};
    model.theory->tunnels.push_back({"adit", 33, 7, circle_section(2, 16), {}});
    std::size_t exist = 0, removable = 0;
    for (const PyramidEntry& entry : joint_set_theory(model).pyramids) {
      exist += entry.exists;
      removable += !entry.removable_from.empty();
    }
    EXPECT_EQ(exist, n * n - n + 2);
    EXPECT_EQ(removable, n * n - n);
  }
}

// Hoek & Bray's wedge (case E5), feet and pounds: the crest of joint 1 is 100 ft above the toe.
TEST(SlopeBlocks, OfHoekAndBraysWedge) {
  const Vec3 n1 = upward(45, 105), n2 = upward(70, 235), face = upward(65, 185),
             upper = upward(12, 195);
  const Vec3 crest = (100.0 / cross(n1, face)[2]) * cross(n1, face);
  const Vec3 up_face = normalized(Vec3{0, 0, 1} - face[2] * face);
  TheorySlope slope{"H&B", {65, 185}, {12, 195}, 0, {}};
  slope.height = dot(upper, crest) / dot(upper, up_face) * up_face[2];
  std::vector<TheorySet> sets{{"A", n1, std::tan(test::radians(20)), 500},
                              {"B", n2, std::tan(test::radians(30)), 1000}};
  TheoryLoads loads;
  loads.density = 160;
  loads.gravity = {0, 0, -1};
  const auto blocks = slope_blocks(sets, loads, slope, 185);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].code, "00");
  EXPECT_NEAR(blocks[0].shape.volume, 229925, 0.5);
  EXPECT_NEAR(blocks[0].shape.joint_area[0], 9349.02, 5e-3);
  EXPECT_NEAR(blocks[0].shape.joint_area[1], 9421.58, 5e-3);
  EXPECT_NEAR(blocks[0].movement->factor_of_safety(), 1.8464, 1e-4);
  EXPECT_FALSE(blocks[0].key);
  // Turned with its joints it is the same.
  for (TheorySet& set : sets) set.upward = test::rotated(set.upward, {0, 0, 1}, -70);
  const auto turned = slope_blocks(sets, loads, slope, 255);
  ASSERT_EQ(turned.size(), 1u);
  EXPECT_NEAR(turned[0].shape.volume, blocks[0].shape.volume, 1e-6);
}

TEST(SlopeBlocks, OfThreeJointsReachFromToeToCrest) {
  const std::vector<Vec3> joints{upward(60, 30), upward(60, 150), upward(60, 270)};
  const TheorySlope slope{"cut", {60, 180}, {0, 180}, 10, {}};
  const auto normals = joint_pyramid(joints, "100");
  const auto shape = largest_block(slope_frame(slope, 180), normals);
  ASSERT_TRUE(shape);
  // The same block at depth 1 behind the face, by an independent polytope.
  const Vec3 face = upward(60, 180);
  std::vector<Side> sides{{face, face, 3}};
  for (Index i = 0; i < 3; ++i) sides.push_back({normals[static_cast<std::size_t>(i)], {}, i});
  const auto block = test::convex_block(sides);
  Real low = 1e9, high = -1e9;
  for (const auto& f : block.faces)
    if (f.side.origin == 3)
      for (const Vec3& x : f.corners) low = std::min(low, x[2]), high = std::max(high, x[2]);
  const Real scale = 10 / (high - low);
  EXPECT_NEAR(shape->volume, std::pow(scale, 3) * block.volume, 1e-9 * shape->volume);
}

TEST(Scan, FindsTheDirectionsThatNeedLeastAndMostSupport) {
  Model model = three_sets();
  model.theory->tunnels.push_back({"adit", 20, 0, circle_section(2, 16), {}});
  model.theory->slopes.push_back({"cut", {70, 180}, {0, 180}, 10, {}});
  model.theory->scan = TheoryScan{15, {0, 20}};
  const TheoryReport report = joint_set_theory(model);
  const Scan& tunnel = *report.excavations[0].scan;
  const Scan& slope = *report.excavations[1].scan;
  EXPECT_EQ(tunnel.entries.size(), 48u);
  EXPECT_EQ(slope.entries.size(), 24u);
  for (const Scan* scan : {&tunnel, &slope}) {
    const auto& best = scan->entries[static_cast<std::size_t>(scan->best)];
    const auto& worst = scan->entries[static_cast<std::size_t>(scan->worst)];
    for (const ScanEntry& entry : scan->entries) {
      EXPECT_GE(entry.largest_support, (1 - 1e-9) * best.largest_support);
      EXPECT_LE(entry.largest_support, (1 + 1e-9) * worst.largest_support);
    }
    EXPECT_LT(best.largest_support, worst.largest_support);
  }
  // Sets 120° apart: so is what a slope sees.
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_NEAR(slope.entries[i].largest_support, slope.entries[(i + 8) % 24].largest_support,
                1e-6 * (1 + slope.entries[i].largest_support));
}

TEST(Codes, OfSomeDigitsAreAllChoicesAndSides) {
  EXPECT_EQ(codes_of(3, 3).size(), 8u);
  EXPECT_EQ(codes_of(5, 3).size(), 80u);
  EXPECT_EQ(codes_of(2, 2), (std::vector<std::string>{"00", "01", "10", "11"}));
  EXPECT_EQ(codes_of(3, 2).front(), "002");
}

}  // namespace
}  // namespace rockfold
