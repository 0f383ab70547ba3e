// Rotation against limit analysis by linear programming: whether contact forces at the corners of the contacts can
// balance the loads. Shares no formula with find_rotation: forces against motions.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/keyblock/face_shape.hpp"
#include "host/keyblock/motions/rotation.hpp"
#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"
#include "tests/keyblock/models/linear_program.hpp"

namespace rockfold {
namespace {

using test::Side;

/// Forces on a block, and whether some of them can balance a load.
class Equilibrium {
 public:
  /// A force of any size along a direction at a point.
  void push(const Vec3& at, const Vec3& along) {
    const Vec3 m = cross(at, along);
    columns_.push_back({along[0], along[1], along[2], m[0], m[1], m[2]});
  }
  void push_and_pull(const Vec3& at, const Vec3& along) {
    push(at, along);
    push(at, -along);
  }
  /// Any force at a point: a joint that holds.
  void hold(const Vec3& at) {
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) push_and_pull(at, axis);
  }
  /// Phase 1 of the simplex method: the most of Σ (A f)_i with A f ≤ w, f ≥ 0 (rows turned so that w ≥ 0) is Σ w.
  bool balances(const Vec3& force, const Vec3& moment) const {
    const std::array<Real, 6> w{-force[0],  -force[1],  -force[2],
                                -moment[0], -moment[1], -moment[2]};
    std::vector<std::vector<Real>> rows(6);
    std::vector<Real> cost(columns_.size(), 0);
    Real sum = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const Real sign = w[i] < 0 ? -1 : 1;
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        rows[i].push_back(sign * columns_[k][i]);
        cost[k] += sign * columns_[k][i];
      }
      rows[i].push_back(std::abs(w[i]));
      sum += std::abs(w[i]);
    }
    return test::linear_program(rows, cost) > sum * (1 - 1e-8);
  }

 private:
  std::vector<std::array<Real, 6>> columns_;
};

struct Directions {
  explicit Directions(std::uint64_t seed) : random(seed) {}
  Vec3 operator()() { return normalized({normal(random), normal(random), normal(random)}); }
  Real number() { return normal(random); }
  std::mt19937_64 random;
  std::normal_distribution<Real> normal;
};

/// A plane of contact with some random corners, and a body on it that the load presses against it.
struct OnOnePlane {
  ContactPatch patch;
  RigidBody body;
};
OnOnePlane on_one_plane(Directions& direction) {
  OnOnePlane made;
  const Vec3 n = direction(), u = normalized(cross(n, direction())), v = cross(n, u);
  std::vector<Vec3> points;
  for (int i = 0; i < 7; ++i)
    points.push_back(Vec3{1, -2, 3} + direction.number() * u + 0.6 * direction.number() * v);
  made.patch = {n, hull_in_plane(n, points), 0};
  Vec3 middle{};
  for (const Vec3& x : points) middle += (1.0 / 7) * x;
  made.body.centroid = middle + (0.4 * direction.number()) * u + (0.4 * direction.number()) * v -
                       (0.5 + std::abs(direction.number())) * n;
  made.body.mass = 2;
  made.body.inertia = {{{1.2, 0.1, 0}, {0.1, 1.3, 0.05}, {0, 0.05, 0.9}}};
  made.body.force = n + (0.8 * direction.number()) * u + (0.8 * direction.number()) * v;
  return made;
}

/// Corners that press and hold by any friction.
Equilibrium rough(const ContactPatch& patch) {
  Equilibrium forces;
  const Vec3 u = normalized(patch.corners[1] - patch.corners[0]), v = cross(patch.normal, u);
  for (const Vec3& x : patch.corners) {
    forces.push(x, -patch.normal);
    forces.push_and_pull(x, u);
    forces.push_and_pull(x, v);
  }
  return forces;
}

// On one rough plane: the block turns exactly where no forces at the corners balance the load; where the
// part of the load along the normal does so alone, F is the factor of the rest up to which they do.
TEST(RotationLimit, OnOnePlaneIsWhereNoForcesAtTheCornersBalanceTheLoad) {
  Directions direction(71);
  int turning = 0, standing = 0, factors = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    const OnOnePlane on = on_one_plane(direction);
    const ContactPatch& patch = on.patch;
    const RigidBody& body = on.body;
    const Equilibrium forces = rough(patch);
    const Vec3 pressing = dot(body.force, patch.normal) * patch.normal,
               rest = body.force - pressing;
    const auto balances = [&](Real factor) {
      const Vec3 load = pressing + factor * rest;
      return forces.balances(load, cross(body.centroid, load));
    };
    const auto rotation = find_rotation(std::span(&patch, 1), body);
    const bool turns = rotation && rotation->driving > rotation->resisting;
    ASSERT_EQ(turns, !balances(1));
    (turns ? turning : standing) += 1;
    if (!balances(0)) continue;
    const Real safety = rotation ? rotation->factor_of_safety() : 1e4;
    if (safety > 1e4 || safety < 1e-3) continue;
    const Real margin = 1e-5 * std::max(safety, 1.0);  // well above what the simplex method rounds
    ++factors;
    ASSERT_TRUE(balances(safety - margin)) << safety;
    ASSERT_FALSE(balances(safety + margin)) << safety;
  }
  EXPECT_GT(turning, 300);
  EXPECT_GT(standing, 300);
  EXPECT_GT(factors, 300);
}

/// A random convex block (of many faces or a tetrahedron) with some of its faces in contact, and a load.
struct OnPlanes {
  std::vector<ContactPatch> patches;
  RigidBody body;
};
std::vector<Side> box_with_corners_off(Directions& direction) {
  std::vector<Side> sides;
  for (const Vec3& n : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1},
                        Vec3{0, 0, -1}})
    sides.push_back({n, 1.0 * n, 0});
  for (int i = 0; i < 3; ++i) {
    const Vec3 n = direction();
    sides.push_back({n, (0.3 + 0.5 * std::abs(direction.number())) * n, 0});
  }
  return sides;
}
std::vector<Side> tetrahedron(Directions& direction) {
  std::vector<Side> sides;
  for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    const Vec3 n = normalized(corner + 0.6 * direction());
    sides.push_back({n, n, 0});
  }
  return sides;
}
OnPlanes on_planes(Directions& direction, bool four_faces) {
  const auto sides = four_faces ? tetrahedron(direction) : box_with_corners_off(direction);
  const auto block = test::convex_block(sides);
  OnPlanes made;
  for (const auto& face : block.faces)
    if (direction.random() % (four_faces ? 2 : 3) == 0)
      made.patches.push_back({face.side.normal, face.corners, 0});
  made.body.centroid = block.centroid;
  made.body.inertia = {{{1.2, 0.1, 0}, {0.1, 1.3, 0.05}, {0, 0.05, 0.9}}};
  made.body.mass = 2;
  made.body.force = direction();
  made.body.moment = (0.1 * direction.number()) * direction();
  return made;
}

/// Smooth corners of all contacts, and joints at some points.
bool holds(const OnPlanes& on, const std::vector<Vec3>& joints) {
  Equilibrium forces;
  for (const Vec3& x : joints) forces.hold(x);
  for (const ContactPatch& patch : on.patches)
    for (const Vec3& x : patch.corners) forces.push(x, -patch.normal);
  return forces.balances(on.body.force, cross(on.body.centroid, on.body.force) + on.body.moment);
}

// On several smooth planes, hinged at an edge of one that the load presses on or at the line through corners of two: a
// turn is found exactly where some hinge and the corners' forces cannot balance the load.
TEST(RotationLimit, OnSeveralPlanesIsWhereSomeHingeCannotHold) {
  Directions direction(73);
  int turning = 0, standing = 0, corners = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    SCOPED_TRACE(trial);
    const OnPlanes on = on_planes(direction, trial % 3 == 0);
    bool fails = false;
    const auto pressed = [&](const ContactPatch& patch) {
      return dot(on.body.force, patch.normal) > 1e-9;
    };
    for (const ContactPatch& patch : on.patches) {
      if (!pressed(patch)) continue;
      for (std::size_t k = 0; k < patch.corners.size(); ++k)
        fails |= !holds(on, {patch.corners[k], patch.corners[(k + 1) % patch.corners.size()]});
    }
    const auto rotations = find_rotations(on.patches, on.body);
    bool edge = false;
    for (const Rotation& rotation : rotations) {
      if (rotation.driving <= rotation.resisting) continue;
      // What turns has no balance about its hinge.
      if (rotation.about == Rotation::About::edge) {
        edge = true;
        EXPECT_FALSE(holds(on, {rotation.point, rotation.point + rotation.axis}));
      } else {
        ++corners;
        EXPECT_FALSE(holds(on, {rotation.point}));
      }
    }
    if (fails) {
      EXPECT_TRUE(edge);
    }
    (edge ? turning : standing) += 1;
  }
  EXPECT_GT(turning, 100);
  EXPECT_GT(standing, 100);
  EXPECT_GT(corners, 10);
}

// A wedge in a trough of two planes at 45° whose front hangs over the trough's end tips about the line through the front
// corners of both planes: F = M_r/M_d = 0 where its weight is in front of them.
TEST(RotationLimit, AWedgeThatOverhangsItsTroughTipsAboutTheCornersOfBothPlanes) {
  const Real c = std::sqrt(0.5);
  // Trough along y from −1 to 0; ridges at x = ±1, z = 1. The block's centroid is ahead of y = 0.
  OnPlanes on;
  on.patches = {{{-c, 0, -c}, {{0, -1, 0}, {0, 0, 0}, {-1, 0, 1}, {-1, -1, 1}}, 0},
                {{c, 0, -c}, {{0, -1, 0}, {1, -1, 1}, {1, 0, 1}, {0, 0, 0}}, 1}};
  on.body.inertia = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  on.body.mass = 1;
  on.body.force = {0, 0, -10};
  for (const Real ahead : {0.25, -0.25}) {
    on.body.centroid = {0, ahead, 0.7};
    const auto rotation = find_rotation(on.patches, on.body);
    ASSERT_EQ(rotation.has_value(), ahead > 0);
    if (!rotation) continue;
    EXPECT_NEAR(std::abs(rotation->axis[0]), 1, 1e-12);
    EXPECT_NEAR(rotation->point[1], 0, 1e-12);
    EXPECT_NEAR(rotation->driving, 2.5, 1e-12);
    EXPECT_EQ(rotation->resisting, 0);
    EXPECT_FALSE(holds(on, {rotation->point, rotation->point + rotation->axis}));
  }
}

// A block on a floor that dips 20° leans with half of its width on a wall down the dip: it can only turn about the wall's
// edge, along the floor, whose friction then resists at the foot of its centroid.
TEST(RotationLimit, AlongAFloorIsHeldByTheFriction) {
  const Real dip = test::radians(20);
  OnPlanes on;  // in the floor's frame: x down the dip
  on.patches = {
      {{0, 0, -1}, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 0, std::tan(test::radians(15))},
      {{1, 0, 0}, {{2, 1.5, 0}, {2, 2, 0}, {2, 2, 0.4}, {2, 1.5, 0.4}}, 1, 0.5}};
  on.body.centroid = {1, 1, 0.2};
  on.body.inertia = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  on.body.mass = 1;
  on.body.force = {10 * std::sin(dip), 0, -10 * std::cos(dip)};
  const auto rotation = find_rotation(on.patches, on.body);
  ASSERT_TRUE(rotation);
  EXPECT_NEAR(std::abs(rotation->axis[2]), 1, 1e-12);
  EXPECT_NEAR(rotation->driving, 10 * std::sin(dip) * 0.5, 1e-12);
  EXPECT_NEAR(rotation->resisting,
              10 * std::cos(dip) * std::tan(test::radians(15)) * std::hypot(1, 0.5), 1e-12);
}

}  // namespace
}  // namespace rockfold
