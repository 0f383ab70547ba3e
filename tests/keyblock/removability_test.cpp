// Removability of finite blocks by their actual faces: linear programming, Shi's theorem in integers and
// the program agree on 100,000 random convex blocks; the space of removable directions.
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/motions/pyramid.hpp"
#include "host/keyblock/motions/single_block.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"
#include "tests/keyblock/models/linear_program.hpp"

namespace rockfold {
namespace {

using test::linear_program;
using test::Side;
using Int3 = std::array<std::int64_t, 3>;

Int3 cross_of(const Int3& a, const Int3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot_of(const Int3& a, const Int3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether {u : n·u ≤ 0} is the origin alone: the normals span space positively, that is, each of
/// ±e_d is a non-negative combination of three of them (Carathéodory). In integers, exact.
bool is_empty_cone(const std::vector<Int3>& normals) {
  const auto combines = [&](const Int3& target) {
    for (const Int3& a : normals)
      for (const Int3& b : normals)
        for (const Int3& c : normals)
          if (dot_of(a, cross_of(b, c)) > 0 && dot_of(target, cross_of(b, c)) >= 0 &&
              dot_of(target, cross_of(c, a)) >= 0 && dot_of(target, cross_of(a, b)) >= 0)
            return true;
    return false;
  };
  for (std::size_t d = 0; d < 3; ++d)
    for (const std::int64_t sign : {1, -1}) {
      Int3 axis{};
      axis[d] = sign;
      if (!combines(axis)) return false;
    }
  return true;
}

/// Whether some u ≠ 0 has n·u ≤ 0 for all n: the largest ±u_d in the unit cube, u = p − q.
bool has_direction_by_linear_programming(const std::vector<Vec3>& normals) {
  std::vector<std::vector<Real>> rows;
  for (const Vec3& n : normals) rows.push_back({n[0], n[1], n[2], -n[0], -n[1], -n[2], 0});
  for (std::size_t k = 0; k < 6; ++k) {
    std::vector<Real> row(7, 0);
    row[k] = row[6] = 1;
    rows.push_back(row);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    std::vector<Real> cost(6, 0);
    cost[k] = 1;
    cost[(k + 3) % 6] = -1;
    if (linear_program(rows, cost) > 1e-7) return true;
  }
  return false;
}

// 100,000 finite blocks from 4 to 8 half-spaces about the origin, one to three of them free. Shi:
// removable if the joint pyramid is not empty (the block pyramid is, for the block is finite).
TEST(Removability, ByLinearProgrammingAndByTheProgramEqualsShisTheoremOn100000ConvexBlocks) {
  std::mt19937_64 random(19);
  std::uniform_int_distribution<std::int64_t> coordinate(-9, 9);
  std::uniform_real_distribution<Real> distance(0.5, 1.5);
  int finite = 0, removable = 0;
  while (finite < 100'000) {
    const std::size_t planes = 4 + random() % 5, free = 1 + random() % 3;
    std::vector<Int3> integers;
    std::vector<Side> sides;
    while (sides.size() < planes) {
      const Int3 n{coordinate(random), coordinate(random), coordinate(random)};
      if (n == Int3{}) continue;
      const Vec3 unit =
          normalized({static_cast<Real>(n[0]), static_cast<Real>(n[1]), static_cast<Real>(n[2])});
      sides.push_back({unit, distance(random) * unit, static_cast<Index>(integers.size())});
      integers.push_back(n);
    }
    if (!is_empty_cone(integers)) continue;  // infinite: Shi's block pyramid is not empty
    const test::ConvexBlock block = test::convex_block(sides);
    std::vector<Int3> joints;
    std::vector<Vec3> joint_normals;
    std::vector<BlockFace> faces;
    bool open = false;
    for (const auto& face : block.faces) {
      const auto i = static_cast<std::size_t>(face.side.origin);
      faces.push_back({.normal = face.side.normal, .area = face.area});
      if (i < free) {
        open = true;
        continue;
      }
      faces.back().contact_area = face.area;
      joints.push_back(integers[i]);
      joint_normals.push_back(face.side.normal);
    }
    if (!open) continue;  // the free planes miss the block
    ++finite;
    const bool shi = joints.empty() || !is_empty_cone(joints);
    removable += shi;
    ASSERT_EQ(has_direction_by_linear_programming(joint_normals), shi) << "block " << finite;
    const bool found = judge_block(faces, {0, 0, -1}, 0).block_class != BlockClass::tapered;
    ASSERT_EQ(found, shi) << "block " << finite;
    ASSERT_EQ(
        joints.empty() || is_removable(joint_normals, {}) || removable_direction(joint_normals),
        shi);
  }
  EXPECT_GT(removable, 20'000);
  EXPECT_LT(removable, 95'000);
}

constexpr Real pi = std::numbers::pi;

TEST(RemovableSpace, OfConesWithKnownAngles) {
  EXPECT_NEAR(removable_space({}).solid_angle, 4 * pi, 1e-12);
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_NEAR(removable_space(std::vector{x}).solid_angle, 2 * pi, 1e-12);
  EXPECT_NEAR(removable_space(std::vector{x, y}).solid_angle, pi, 1e-12);
  const auto octant = removable_space(std::vector{x, y, z});
  EXPECT_NEAR(octant.solid_angle, pi / 2, 1e-12);
  EXPECT_EQ(octant.edges.size(), 3u);
  EXPECT_EQ(removable_space(std::vector{x, -x}).solid_angle, 0);
  EXPECT_EQ(removable_space(std::vector{x, -x, y}).solid_angle, 0);
  const auto line = removable_space(std::vector{x, -x, y, -y});
  EXPECT_EQ(line.solid_angle, 0);
  EXPECT_EQ(line.edges.size(), 2u);
  const auto ray = removable_space(std::vector{x, -x, y, -y, z});
  ASSERT_EQ(ray.edges.size(), 1u);
  EXPECT_EQ(ray.edges[0], -z);
  EXPECT_EQ(removable_space(std::vector{x, -x, y, -y, z, -z}).edges.size(), 0u);
}

// The solid angles of all joint pyramids of some sets fill the sphere.
TEST(RemovableSpace, OfAllJointPyramidsFillTheSphere) {
  std::mt19937_64 random(5);
  std::normal_distribution<Real> normal;
  for (std::size_t n = 1; n <= 6; ++n) {
    std::vector<Vec3> joints;
    for (std::size_t i = 0; i < n; ++i)
      joints.push_back(normalized({normal(random), normal(random), normal(random)}));
    Real sum = 0;
    for (std::size_t bits = 0; bits < (std::size_t{1} << n); ++bits) {
      std::string code;
      for (std::size_t i = 0; i < n; ++i) code += (bits >> i & 1) ? '1' : '0';
      sum += removable_space(joint_pyramid(joints, code)).solid_angle;
    }
    EXPECT_NEAR(sum, 4 * pi, 1e-9) << n;
  }
}

}  // namespace
}  // namespace rockfold
