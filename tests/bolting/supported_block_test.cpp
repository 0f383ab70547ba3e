// Limit equilibrium of blocks with active and passive bolts at every angle: closed forms, vector equilibrium of wedges, and
// friction cones of contact forces.
#include "host/bolting/supported_block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "host/keyblock/motions/least_support.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real degree = std::numbers::pi / 180;
constexpr Real infinite = std::numeric_limits<Real>::infinity();

BoltType bolt_type(BoltAction action) {
  BoltType type;
  type.action = action;
  type.stiffness = 1;
  return type;
}
const BoltType active = bolt_type(BoltAction::active), passive = bolt_type(BoltAction::passive);

Keyblock block_on(const std::vector<ContactPlane>& planes, const Vec3& r) {
  Keyblock key;
  key.contact = planes;
  key.resultant = r;
  key.movement = governing_movement(planes, r);
  return key;
}

SupportedMotion with_bolts(const Keyblock& key, const std::vector<BoltAtBlock>& bolts,
                           Real target = 1) {
  return supported_motion(key, bolts, {}, target);
}

/// NaN, nothing resists, as 0.
Real safety(const SupportedMotion& motion) {
  return std::isnan(motion.held.factor_of_safety) ? 0 : motion.held.factor_of_safety;
}

// One plane ----------------------------------------------------------------------------------------------------------------

/// A block of 1000 kN on a plane that dips 50° to the east, φ = 30°.
struct SlidingBlock {
  Vec3 upward{std::sin(50 * degree), 0, std::cos(50 * degree)};
  Vec3 down_dip{std::cos(50 * degree), 0, -std::sin(50 * degree)};
  std::vector<ContactPlane> planes{
      {.normal = -upward, .area = 1, .friction = std::tan(30 * degree)}};
  Keyblock key = block_on(planes, {0, 0, -1000e3});

  /// The direction into the rock at alpha degrees from the plane's normal, towards up-dip.
  Vec3 at(Real alpha) const {
    return -std::cos(alpha * degree) * upward - std::sin(alpha * degree) * down_dip;
  }
};

/// Case G-1: force, in kN, along alpha that brings the block to F.
struct Hoek {
  Real alpha, safety;
  bool active;
  Real force;
};
constexpr Hoek hoek_table[] = {
    {0, 1, true, 684.0403},     {30, 1, true, 394.9308},    {60, 1, true, 342.0201},
    {90, 1, true, 394.9308},    {0, 1.5, true, 1347.4542},  {30, 1.5, true, 622.3625},
    {60, 1.5, true, 489.9834},  {75, 1.5, true, 486.7323},  {90, 1.5, true, 518.6354},
    {0, 1.5, false, 1347.4542}, {60, 1.5, false, 673.7271}, {90, 1.5, false, 777.9531}};

TEST(SupportedBlock, OfABoltAlongAnAngleReachesTheTargetWithHoeksForce) {
  const SlidingBlock block;
  for (const Hoek& row : hoek_table) {
    SCOPED_TRACE(row.alpha);
    const auto with = [&](Real force) {
      const BoltType& type = row.active ? active : passive;
      return with_bolts(block.key, {{&type, block.at(row.alpha), force, {}}}, row.safety).held;
    };
    EXPECT_NEAR(with(row.force * 1e3).factor_of_safety, row.safety, 2e-6);
    EXPECT_TRUE(with(row.force * 1.0001e3).adequate);
    EXPECT_FALSE(with(row.force * 0.9999e3).adequate);
  }
}

// Case G-1.
TEST(SupportedBlock, OfTwoHundredKilonewtonBoltsNeedsTwoForBalanceAndThreeForTheTarget) {
  const SlidingBlock block;
  for (const auto& [target, count] : {std::pair{1.0, 2u}, {1.5, 3u}}) {
    std::vector<BoltAtBlock> bolts(count, {&active, block.at(60), 200e3, {}});
    EXPECT_TRUE(with_bolts(block.key, bolts, target).held.adequate);
    bolts.pop_back();
    EXPECT_FALSE(with_bolts(block.key, bolts, target).held.adequate);
  }
}

// Case G-1: the optimum.
TEST(SupportedBlock, MissesWhatTheLeastSupportForceIs) {
  const SlidingBlock block;
  const SupportForce least = least_support(block.planes, *block.key.movement, 1.5);
  EXPECT_NEAR(least.force, 484.0198e3, 0.1);
  EXPECT_NEAR(with_bolts(block.key, {}, 1.5).held.missing_force, least.force, 1e-6);
  const std::vector<BoltAtBlock> half{{&active, least.direction, 0.5 * least.force, {}}};
  EXPECT_NEAR(with_bolts(block.key, half, 1.5).held.missing_force, 0.5 * least.force, 1e-6);
}

/// Along and normal to a plane of dip ψ: W, cohesion × area C, a bolt of tension T at θ to the way up the plane that presses on
/// it, or (`lifts`) pulls off it.
struct Inclined {
  Real dip, friction_angle, cohesion, weight, tension, theta;
  bool lifts;

  Real tan_phi() const { return std::tan(friction_angle * degree); }
  Real along() const { return weight * std::sin(dip * degree); }
  Real normal() const { return weight * std::cos(dip * degree); }
  Real pull() const { return tension * std::cos(theta * degree); }
  Real push() const { return (lifts ? -1 : 1) * tension * std::sin(theta * degree); }

  Real active_safety() const {
    const Real drives = along() - pull(), presses = normal() + push();
    if (presses < 0) return 0;                                   // lifted off
    return (cohesion + presses * tan_phi()) / std::abs(drives);  // down, or up the plane
  }
  Real passive_safety() const {
    const bool counts = theta <= 90;
    const Real presses = std::max(0.0, normal() + (counts ? push() : 0));
    return (cohesion + presses * tan_phi() + (counts ? pull() : 0)) / along();
  }
  Vec3 upward() const { return {std::sin(dip * degree), 0, std::cos(dip * degree)}; }
  Vec3 down_dip() const { return {std::cos(dip * degree), 0, -std::sin(dip * degree)}; }
  Vec3 axis() const {
    return -std::cos(theta * degree) * down_dip() -
           (lifts ? -1 : 1) * std::sin(theta * degree) * upward();
  }
  Keyblock key() const {
    return block_on({{.normal = -upward(), .area = 1, .friction = tan_phi(), .cohesion = cohesion}},
                    {0, 0, -weight});
  }
};

/// All angles with weak and strong bolts; those that drive the block up the plane and lift it off among them.
std::vector<Inclined> inclined_blocks() {
  std::vector<Inclined> all;
  for (const auto& [dip, phi] : {std::pair{50.0, 30.0}, {35.0, 30.0}, {40.0, 32.0}, {20.0, 38.0}})
    for (const Real cohesion : {0.0, 120e3})
      for (const Real tension : {30e3, 236e3, 655e3, 1800e3})
        for (int theta = 0; theta <= 180; theta += 2)
          for (const bool lifts : {false, true})
            all.push_back({dip, phi, cohesion, 1000e3, tension, Real(theta), lifts});
  return all;
}

TEST(SupportedBlock, OnOnePlaneIsTheClosedFormAtEveryAngle) {
  int up = 0, off = 0, down = 0;
  for (const Inclined& block : inclined_blocks()) {
    SCOPED_TRACE(testing::Message() << "dip " << block.dip << " theta " << block.theta << " T "
                                    << block.tension << " lifts " << block.lifts);
    const Real expected = block.active_safety();
    const auto anchored = with_bolts(block.key(), {{&active, block.axis(), block.tension, {}}});
    EXPECT_NEAR(safety(anchored), expected, 1e-9 * (1 + expected));
    const Real held = block.passive_safety();
    const auto bolted = with_bolts(block.key(), {{&passive, block.axis(), block.tension, {}}});
    EXPECT_NEAR(safety(bolted), held, 1e-9 * (1 + held));
    const bool lifted = block.normal() + block.push() < 0;
    (lifted ? off : block.pull() > block.along() ? up : down) += 1;
    EXPECT_EQ(anchored.mode, lifted ? SlidingMode::lifting : SlidingMode::single_plane);
    EXPECT_NEAR(anchored.forces[0].axial, block.tension, 0);
  }
  EXPECT_GT(std::min({up, off, down}), 50);
}

// Dip 35°, φ = 30°, T = 236 kN a meganewton of weight: an anchor that drives.
TEST(SupportedBlock, IsLessSafeByAnAnchorThatDrivesIt) {
  const auto with = [](Real theta, const BoltType& type) {
    const Inclined block{35, 30, 0, 1000e3, 236e3, theta, false};
    return safety(with_bolts(block.key(), {{&type, block.axis(), block.tension, {}}}));
  };
  EXPECT_NEAR(with(150, active), 0.6955, 1e-4);
  EXPECT_NEAR(with(170, active), 0.6162, 1e-4);
  EXPECT_NEAR(with(150, passive), 0.8245, 1e-4);  // no more than without
}

// Contact forces -----------------------------------------------------------------------------------------------------------

/// Whether non-negative sums of the generators reach p: no plane through two of them that leaves all on one side parts it
/// from them. Exact but for rounding; brute force.
bool cone_reaches(const std::vector<Vec3>& generators, const Vec3& p) {
  for (std::size_t i = 0; i < generators.size(); ++i)
    for (std::size_t j = 0; j < generators.size(); ++j) {
      const Vec3 n = cross(generators[i], generators[j]);
      if (norm(n) < 1e-12) continue;
      const Vec3 m = normalized(n);
      const bool facet = std::all_of(generators.begin(), generators.end(),
                                     [&](const Vec3& g) { return dot(m, g) >= -1e-12; });
      if (facet && dot(m, p) < -1e-13 * norm(p)) return false;
    }
  return true;
}

/// Forces that a plane can put on the block with tan φ / F: edges of its friction cone, one of them along `towards`.
void add_friction_cone(const ContactPlane& plane, Real factor, const Vec3& towards,
                       std::vector<Vec3>& cone) {
  constexpr int edges = 12;
  const Vec3 flat = towards - dot(towards, plane.normal) * plane.normal;
  const Vec3 u = normalized(flat), v = cross(plane.normal, u);
  for (int k = 0; k < edges; ++k) {
    const Real angle = 2 * std::numbers::pi * k / edges;
    cone.push_back(normalized(-plane.normal + (plane.friction / factor) *
                                                  (std::cos(angle) * u + std::sin(angle) * v)));
  }
}

/// The largest F for which contact forces with tan φ / F balance r.
Real largest_factor(const std::vector<ContactPlane>& planes, const Vec3& r, const Vec3& towards) {
  const auto holds = [&](Real factor) {
    std::vector<Vec3> cone;
    for (const ContactPlane& plane : planes) add_friction_cone(plane, factor, towards, cone);
    return cone_reaches(cone, -1.0 * r);
  };
  Real low = 1e-3, high = 1e3;
  if (!holds(low)) return 0;
  if (holds(high)) return infinite;
  for (int step = 0; step < 45; ++step) {
    const Real middle = std::sqrt(low * high);
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

TEST(SupportedBlock, OnOnePlaneIsTheBestThatContactForcesCanDo) {
  for (const Inclined& block : inclined_blocks()) {
    if (block.cohesion > 0 || static_cast<int>(block.theta) % 10 != 0) continue;
    const Keyblock key = block.key();
    const Vec3 r = key.resultant + block.tension * block.axis();
    const Real best = largest_factor(key.contact, r, block.down_dip());
    const Real own = safety(with_bolts(key, {{&active, block.axis(), block.tension, {}}}));
    SCOPED_TRACE(testing::Message() << "dip " << block.dip << " theta " << block.theta);
    EXPECT_NEAR(own, best, 1e-7 * (1 + best));
  }
}

// Two planes ---------------------------------------------------------------------------------------------------------------

/// x of a + b + c columns: x_0 a + x_1 b + x_2 c = v (Cramer).
std::array<Real, 3> components(const Vec3& v, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Real d = dot(a, cross(b, c));
  return {dot(v, cross(b, c)) / d, dot(a, cross(v, c)) / d, dot(a, cross(b, v)) / d};
}

/// Vector equilibrium of a block on two planes, written down for itself: r = D s + N_1 n_1 + N_2 n_2.
struct Equilibrium {
  SlidingMode mode = SlidingMode::at_rest;
  Vec3 s{};
  Real safety = infinite;
};

Equilibrium equilibrium(const std::vector<ContactPlane>& planes, const Vec3& r,
                        const std::vector<BoltAtBlock>& passives) {
  const Vec3 &n1 = planes[0].normal, &n2 = planes[1].normal;
  const auto enters = [&](const Vec3& s) {
    return dot(s, n1) > 1e-9 * norm(s) || dot(s, n2) > 1e-9 * norm(s);
  };
  // What passive bolts do against s: all of their force up to 90°.
  const auto bolts = [&](const Vec3& s) {
    Vec3 sum{};
    for (const BoltAtBlock& b : passives)
      if (dot(b.axis, s) <= 0) sum += b.axial * b.axis;
    return sum;
  };
  if (!enters(r)) {
    const Vec3 s = normalized(r);
    return {SlidingMode::lifting, s, -dot(bolts(s), s) / norm(r)};
  }
  for (const ContactPlane& plane : planes) {
    const Real presses = dot(r, plane.normal);
    const Vec3 slides = r - presses * plane.normal;
    if (presses <= 0 || enters(slides)) continue;
    const Vec3 s = normalized(slides), p = bolts(s);
    const Real n = std::max(0.0, presses + dot(p, plane.normal));
    return {SlidingMode::single_plane, s,
            (plane.cohesion + plane.friction * n - dot(p, s)) / norm(slides)};
  }
  const Vec3 line = normalized(cross(n1, n2)), s = dot(line, r) < 0 ? -1.0 * line : line;
  const auto [drives, first, second] = components(r, s, n1, n2);
  if (first < 0 || second < 0 || drives <= 0) return {};
  const Vec3 p = bolts(s);
  const auto [against, more_first, more_second] = components(p, s, n1, n2);
  const Real resists = planes[0].cohesion + planes[1].cohesion +
                       planes[0].friction * std::max(0.0, first + more_first) +
                       planes[1].friction * std::max(0.0, second + more_second) - against;
  return {SlidingMode::two_planes, s, resists / drives};
}

// 4,000 wedges, with none to three bolts of each kind in any direction: all modes without and with the anchors.
TEST(SupportedBlock, OnTwoPlanesIsTheVectorEquilibriumOfWedges) {
  std::mt19937_64 random(90);
  std::normal_distribution<Real> normal;
  std::uniform_real_distribution<Real> share(0, 1);
  const auto any_direction = [&] {
    return normalized({normal(random), normal(random), normal(random)});
  };
  std::array<std::array<int, 5>, 5> seen{};
  int bounded = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    SCOPED_TRACE(trial);
    std::vector<ContactPlane> planes;
    for (int k = 0; k < 2; ++k)
      planes.push_back({.normal = any_direction(),
                        .area = 1,
                        .friction = std::tan(10 * degree + 35 * degree * share(random)),
                        .cohesion = trial % 2 == 0 ? 0 : 0.2 * share(random)});
    const Vec3 r{0, 0, -1};
    const Keyblock key = block_on(planes, r);
    if (key.movement && key.movement->mode == SlidingMode::lifting) continue;  // tests of its own
    std::vector<BoltAtBlock> anchors, passives;
    for (int k = static_cast<int>(4 * share(random)); k > 0; --k)
      anchors.push_back({&active, any_direction(), share(random), {}});
    for (int k = static_cast<int>(4 * share(random)); k > 0; --k)
      passives.push_back({&passive, any_direction(), share(random), {}});
    Vec3 loads = r;
    for (const BoltAtBlock& b : anchors) loads += b.axial * b.axis;
    const Equilibrium expected = equilibrium(planes, loads, passives);
    std::vector<BoltAtBlock> bolts = anchors;
    bolts.insert(bolts.end(), passives.begin(), passives.end());
    const SupportedMotion found = with_bolts(key, bolts);
    ASSERT_EQ(found.mode, expected.mode);
    if (std::isinf(expected.safety)) {
      EXPECT_TRUE(std::isinf(found.held.factor_of_safety));
    } else {
      EXPECT_NEAR(safety(found), expected.safety, 1e-9 * (1 + std::abs(expected.safety)));
    }
    const auto before = key.movement ? key.movement->mode : SlidingMode::at_rest;
    ++seen[static_cast<std::size_t>(before)][static_cast<std::size_t>(found.mode)];
    // Contact forces in any direction can do no less: friction across the line of sliding adds to what equilibrium counts.
    if (trial % 2 == 0 && passives.empty() && found.mode == SlidingMode::two_planes &&
        bounded < 60) {
      ++bounded;
      EXPECT_LE(safety(found), largest_factor(planes, loads, expected.s) * (1 + 1e-7));
    }
  }
  const auto count = [&](SlidingMode a, SlidingMode b) {
    return seen[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  };
  using enum SlidingMode;
  for (const SlidingMode a : {single_plane, two_planes})
    for (const SlidingMode b : {lifting, single_plane, two_planes}) EXPECT_GT(count(a, b), 10);
  EXPECT_EQ(bounded, 60);
}

// On a floor, μ = 0.5: 30 of 50 kN drive it along, 40 kN press or lift.
TEST(SupportedBlock, AtRestMayBeDrivenByAnAnchor) {
  const std::vector<ContactPlane> floor{{.normal = {0, 0, -1}, .area = 1, .friction = 0.5}};
  const Keyblock key = block_on(floor, {0, 0, -100e3});
  EXPECT_FALSE(key.movement);
  const auto with = [&](const Vec3& axis) {
    return with_bolts(key, {{&active, normalized(axis), 50e3, {}}});
  };
  EXPECT_EQ(with({0, 0, -1}).mode, SlidingMode::at_rest);
  EXPECT_TRUE(std::isinf(with({0, 0, -1}).held.factor_of_safety));
  EXPECT_EQ(with({3, 0, -4}).mode, SlidingMode::single_plane);
  EXPECT_NEAR(safety(with({3, 0, -4})), 0.5 * (100 + 40) / 30, 1e-12);
  EXPECT_NEAR(safety(with({3, 0, 4})), 0.5 * (100 - 40) / 30, 1e-12);
}

// Active bolts carry their load without any displacement, passive ones what is missing then.
TEST(SupportedBlock, MobilisesActiveBoltsAtOnceAndPassiveOnesByDisplacement) {
  const SlidingBlock block;  // lacks 342 kN at α = 60° active, of which 200 kN are there
  BoltType stiff = passive;
  stiff.stiffness = 10e6;
  const Real lacks =
      1000e3 * (std::sin(50 * degree) - std::cos(50 * degree) * std::tan(30 * degree));
  const Vec3 up_dip = -1.0 * block.down_dip;
  const auto held =
      with_bolts(block.key, {{&active, up_dip, 200e3, {}}, {&stiff, up_dip, 400e3, {}}}).held;
  EXPECT_EQ(held.mobilised[0], 1);
  EXPECT_NEAR(held.mobilised[1], (lacks - 200e3) / 400e3, 1e-9);
  EXPECT_NEAR(held.displacement, (lacks - 200e3) / 10e6, 1e-12);
  const auto enough =
      with_bolts(block.key, {{&active, up_dip, 400e3, {}}, {&stiff, up_dip, 400e3, {}}}).held;
  EXPECT_EQ(enough.mobilised, (std::vector<Real>{1, 0}));
  EXPECT_EQ(enough.displacement, 0);
}

// Falling ------------------------------------------------------------------------------------------------------------------

TEST(SupportedBlock, ThatFallsHasForceOverWeight) {
  const Keyblock key = block_on({{.normal = {0, 0, 1}, .area = 1}}, {0, 0, -15.588e3});
  for (const BoltType& type : {active, passive})
    for (const Real force : {1e3, 10e3, 15.6e3, 100e3}) {
      const auto held = with_bolts(key, {{&type, {0, 0, 1}, force, {}}}, 2).held;
      // Forces that cancel to 1e-12 of their size are none.
      EXPECT_NEAR(held.factor_of_safety, force / 15.588e3, 1e-11 * (1 + force / 15.588e3));
      EXPECT_EQ(held.adequate, force > 2 * 15.588e3);
      EXPECT_NEAR(held.missing_force, std::max(0.0, 2 * 15.588e3 - force), 1e-6);
    }
  EXPECT_TRUE(std::isnan(with_bolts(key, {}, 2).held.factor_of_safety));
  EXPECT_FALSE(with_bolts(key, {}, 2).held.adequate);
}

// Beside a vertical wall: the anchor carries, and presses the block on the wall. λ W = T (cos θ + sin θ tan φ).
TEST(SupportedBlock, ThatFallsAlongAWallIsHeldByFrictionWhereAnAnchorPressesOnIt) {
  const Real tan_phi = std::tan(30 * degree), weight = 100e3;
  // Rock above: no anchor lifts it.
  const Keyblock key = block_on(
      {{.normal = {1, 0, 0}, .area = 1, .friction = tan_phi}, {.normal = {0, 0, 1}, .area = 1}},
      {0, 0, -weight});
  ASSERT_EQ(key.movement->mode, SlidingMode::lifting);
  for (const Real tension : {50e3, 90e3, 130e3, 142e3, 500e3})
    for (const Real theta : {0.0, 0.1, 20.0, 45.0, 80.0, 90.0, 100.0, 119.0}) {
      SCOPED_TRACE(testing::Message() << tension << " at " << theta);
      const Vec3 axis{std::sin(theta * degree), 0, std::cos(theta * degree)};
      const auto found = with_bolts(key, {{&active, axis, tension, {}}});
      const Real factor = tension * (axis[2] + axis[0] * tan_phi) / weight;
      EXPECT_NEAR(safety(found), factor, 1e-9 * (1 + factor));
      // Just where r + P_a is held.
      const Vec3 r = Vec3{0, 0, -weight} + tension * axis;
      const auto movement = governing_movement(key.contact, r);
      EXPECT_EQ(found.held.in_balance, !movement || movement->sliding_force() <= 0);
      EXPECT_EQ(found.held.adequate, factor >= 1);
    }
  for (const Real theta : {121.0, 150.0, 180.0}) {  // the anchor alone would pull it down
    const Vec3 axis{std::sin(theta * degree), 0, std::cos(theta * degree)};
    const Real expected = 50e3 * axis[0] * tan_phi / (weight - 50e3 * axis[2]);
    EXPECT_NEAR(safety(with_bolts(key, {{&active, axis, 50e3, {}}})), expected, 1e-9);
  }
}

}  // namespace
}  // namespace rockfold
