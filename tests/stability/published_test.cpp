// Limit analysis beside published figures, and beside statics where it is exact.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "host/stability/movement.hpp"
#include "host/stability/sliding.hpp"
#include "host/stability/spring_mass.hpp"
#include "src/base/vector.hpp"
#include "tests/stability/factors.hpp"
#include "tests/stability/planar_mass.hpp"

namespace rockfold {
namespace {

using test::bound_of;
using test::degree;
using test::factors_of;
using test::PlanarMass;
using test::Point2;

void expect_factor(const RigidMass& mass, Real expected) {
  const auto& [bound, sliding] = factors_of(mass);
  EXPECT_NEAR(bound.factor, expected, 1e-5 * expected);
  EXPECT_EQ(sliding.answer, Sliding::Answer::fails);
  EXPECT_NEAR(sliding.factor, expected, 1e-4 * expected);
}

void expect_stands(const RigidMass& mass) {
  const auto& [bound, sliding] = factors_of(mass);
  EXPECT_TRUE(std::isinf(bound.factor));
  EXPECT_EQ(sliding.answer, Sliding::Answer::stands);
}

/// It turns over, whatever its strength; the mechanism.
Mechanism expect_turns_over(const RigidMass& mass) {
  const auto& [bound, sliding] = factors_of(mass);
  EXPECT_EQ(bound.factor, 0);
  EXPECT_EQ(sliding.answer, Sliding::Answer::falls);
  const auto moving = moving_blocks(mass, sliding.mechanism, sliding.balance);
  EXPECT_TRUE(std::any_of(moving.begin(), moving.end(), [](const auto& b) { return b.turns; }));
  return sliding.mechanism;
}

// Goodman & Bray, Toppling of rock slopes (Proc. Rock Engineering for Foundations and Slopes, Boulder 1976, vol. 2, 201-234); also Hoek & Bray,
// Rock Slope Engineering, and Wyllie & Mah. They need tan φ = 0.7855 (38.15°).
constexpr Index goodman_bray_blocks = 16;
constexpr Real goodman_bray_friction = 0.785544;  // their equations, to more digits

/// Blocks 10 m wide on a base that dips by 30° towards −x in steps of 1 m; they grow by 4 m up to the tenth, then shrink by 6 m.
/// A horizontal force, N, holds block 1.
RigidMass toppling_slope(Real friction, Real anchor = 0) {
  PlanarMass planar;
  const auto at = [](Real x, Real z) {
    const Real c = std::cos(30 * degree), s = std::sin(30 * degree);
    return Point2{x * c - z * s, x * s + z * c};
  };
  const auto top = [](Index n) { return n + (n <= 10 ? 4.0 * n : 40.0 - 6.0 * (n - 10)); };
  for (Index n = 1; n <= goodman_bray_blocks; ++n) {
    const Real left = 10.0 * (n - 1), right = 10.0 * n;
    planar.add_block({at(left, n), at(right, n), at(right, top(n)), at(left, top(n))});
    planar.add_contact(n - 1, none, at(left, n), at(right, n), friction);
  }
  for (Index n = 2; n <= goodman_bray_blocks; ++n) {
    const Real x = 10.0 * (n - 1);
    planar.add_contact(n - 2, n - 1, at(x, n), at(x, std::min(top(n - 1), top(n))), friction);
  }
  RigidMass mass = planar.mass();
  mass.bodies[0].force[0] += anchor;
  return mass;
}

class OnSprings {
 public:
  OnSprings(RigidMass mass, Real factor) : mass_(std::move(mass)) {
    state_ = springs_.settle(1 / factor, springs_.start(), 1e-6);
  }
  Ending ending() const { return state_.ending; }
  /// A letter for each block: it rests, slides or topples.
  std::string motions() const {
    const auto velocity = springs_.velocities(state_);
    Real fastest = 0;
    for (const BodyVelocity& v : velocity) fastest = std::max(fastest, norm(v.velocity));
    std::string letters;
    for (const BodyVelocity& v : velocity)
      letters += norm(v.velocity) < 1e-6 * fastest ? 'r'
                 : norm(v.spin) < 1e-6 * fastest   ? 's'
                                                   : 't';
    return letters;
  }
  /// What presses in each contact, N.
  std::vector<Real> forces() const {
    std::vector<Real> sum(mass_.contacts.size(), 0);
    for (std::size_t p = 0; p < scaled_.points().size(); ++p)
      sum[scaled_.points()[p].contact] += std::max(0.0, state_.pressure[p]) * scaled_.force_scale();
    return sum;
  }

 private:
  RigidMass mass_;
  ScaledMass scaled_{mass_};
  SpringMass springs_{scaled_};
  SpringMass::State state_;
};

TEST(Published, GoodmanAndBraysSlopeFailsAtTheirFriction) {
  const RigidMass slope = toppling_slope(goodman_bray_friction);
  EXPECT_EQ(OnSprings(slope, 0.999).ending(), Ending::stands);
  const OnSprings failing(slope, 1.001);
  EXPECT_EQ(failing.ending(), Ending::creeps);
  EXPECT_EQ(failing.motions(), "sssttttttttttrrr");
}

// Forces of blocks 4 to 13 on those before them, kN. Blocks 1 to 3 slide together: what is between them is not determined.
TEST(Published, GoodmanAndBraysBlocksPressAsTheySay) {
  const std::vector<Real> published{2825.5, 3978.0, 4637.4, 4837.0, 4594.8,
                                    3922.1, 2826.7, 1556.0, 825.7,  292.5};
  const std::vector<Real> force = OnSprings(toppling_slope(goodman_bray_friction), 1.0001).forces();
  for (std::size_t k = 0; k < published.size(); ++k)
    EXPECT_NEAR(force[goodman_bray_blocks + 2 + k] / 1e3, published[k], 1e-3 * 4837) << k + 4;
}

// Horizontal forces by their equations; at 0.65 they print 2013 kN a metre.
TEST(Published, GoodmanAndBraysAnchorHoldsTheSlope) {
  for (const auto& [friction, force] : {std::pair{0.65, 2012.9e3}, std::pair{0.70, 1114.0e3}}) {
    EXPECT_EQ(OnSprings(toppling_slope(friction, 0.998 * force), 1).ending(), Ending::creeps);
    EXPECT_EQ(OnSprings(toppling_slope(friction, 1.002 * force), 1).ending(), Ending::stands);
  }
}

// Limit equilibrium knows no dilation: their blocks 1 to 3 slide down the base. By the flow rule of the bound they would have to rise from it,
// which takes a fifth more.
TEST(Published, GoodmanAndBraysFrictionIsBelowTheBound) {
  const Bound bound = bound_of(toppling_slope(goodman_bray_friction));
  EXPECT_GT(bound.below.factor, 1);
  const auto velocity_of = [&](Index n) { return bound.above.velocity[n - 1].velocity; };
  for (const Index n : {1, 2, 3}) {
    const Vec3 v = velocity_of(n);
    const Real along = -v[0] * std::cos(30 * degree) - v[2] * std::sin(30 * degree);
    const Real up = -v[0] * std::sin(30 * degree) + v[2] * std::cos(30 * degree);
    EXPECT_NEAR(up / along, goodman_bray_friction / bound.above.factor, 1e-5) << n;
  }
}

/// Equal blocks on each other, each with this x of its left side, pulled along x by a share of their weight.
RigidMass tower(Real width, Real height, const std::vector<Real>& left, Real friction,
                Real seismic = 0) {
  PlanarMass planar(20e3, seismic);
  for (Index k = 0; k < static_cast<Index>(left.size()); ++k) {
    const Real x = left[k], z = k * height;
    planar.add_block({{x, z}, {x + width, z}, {x + width, z + height}, {x, z + height}});
    const Real below = k > 0 ? left[k - 1] : x;
    planar.add_contact(k, k > 0 ? k - 1 : none, {std::max(x, below), z},
                       {std::min(x, below) + width, z}, friction);
  }
  return planar.mass();
}

// The blocks of Ferris & Tin-Loi (2001), 0.4 m by 0.175 m with μ = 0.65, on each other: shear is α of the weight in each joint, and the resultant
// of all leaves the base at α = width / height.
TEST(Published, ATowerStandsUntilItsResultantLeavesTheBase) {
  for (const Index blocks : {2, 4, 12}) {
    const std::vector<Real> upright(static_cast<std::size_t>(blocks), 0);
    const Real slenderness = 0.4 / (0.175 * blocks);
    for (const Real share : {0.3, 0.7, 0.999}) {
      const Real pull = share * slenderness;
      EXPECT_NEAR(bound_of(tower(0.4, 0.175, upright, 0.65, pull)).factor, 0.65 / pull,
                  1e-5 * 0.65 / pull);
    }
    for (const Real share : {1.001, 1.2})
      expect_turns_over(tower(0.4, 0.175, upright, 0.65, share * slenderness));
  }
}

// The top joint is smoother: what fails is one block.
TEST(Published, ATowersTopBlockSlidesOffASmootherJoint) {
  for (const std::size_t blocks : {2, 4, 12}) {
    RigidMass mass = tower(0.4, 0.175, std::vector<Real>(blocks, 0), 0.65, 0.15);
    mass.contacts.back().friction = 0.2;
    expect_factor(mass, 0.2 / 0.15);
  }
}

// μ = 0.65 is below its slenderness of 2.3.
TEST(Published, AFlatBlockSlidesWhereThePullIsItsFriction) {
  for (const Real pull : {0.64, 0.66, 2.2})
    expect_factor(tower(0.4, 0.175, {0}, 0.65, pull), 0.65 / pull);
  expect_turns_over(tower(0.4, 0.175, {0}, 0.65, 2.3));
}

/// The k-th block from the top hangs over by `share` / 2k of its length: the sum grows without end, as the harmonic series.
std::vector<Real> harmonic(Index blocks, Real share) {
  std::vector<Real> left{0};
  for (Index k = blocks - 1; k > 0; --k) left.push_back(left.back() + share / (2.0 * k));
  return left;
}
/// All by as much: those on the lowest have their centroid over its edge at 1/blocks.
std::vector<Real> leaning(Index blocks, Real share) {
  std::vector<Real> left;
  for (Index k = 0; k < blocks; ++k) left.push_back(share * k / blocks);
  return left;
}

// The harmonic stack hangs over as far as one block on each other can: ½ (1 + ½ + … ) of a length.
TEST(Published, StacksStandWhileCentroidsAreOverTheBlockBelow) {
  for (const Index blocks : {2, 3, 5, 8, 12})
    for (const auto& shape : {harmonic, leaning}) {
      expect_stands(tower(1, 0.3, shape(blocks, 0.9999), 0.65));
      expect_turns_over(tower(1, 0.3, shape(blocks, 1.0001), 0.65));
    }
}

RigidMass block_on_incline(Real width, Real height, Real dip, Real friction) {
  const Point2 along{std::cos(dip), -std::sin(dip)}, up{std::sin(dip), std::cos(dip)};
  const auto at = [&](Real s, Real t) {
    return Point2{s * along[0] + t * up[0], s * along[1] + t * up[1]};
  };
  PlanarMass planar;
  planar.add_block({at(0, 0), at(width, 0), at(width, height), at(0, height)});
  planar.add_contact(0, none, at(0, 0), at(width, 0), friction);
  return planar.mass();
}

// It topples where width / height < tan(dip) (Hoek & Bray). Blocks 10 m wide on 40°: those of 3DEC's verification (SlidingBlock).
TEST(Published, ABlockOnAnInclineSlidesOrTopples) {
  struct Case {
    Real width, height, dip, angle;
  };
  for (const auto& [width, height, dip, angle] : {Case{10, 10, 40, 40.1}, Case{10, 5, 40, 20},
                                                  Case{0.5, 1, 26.56, 60}, Case{1, 2.5, 21.8, 50}})
    expect_factor(block_on_incline(width, height, dip * degree, std::tan(angle * degree)),
                  std::tan(angle * degree) / std::tan(dip * degree));
  for (const auto& [width, height, dip, angle] :
       {Case{10, 25, 40, 40}, Case{0.5, 1, 26.57, 60}, Case{1, 2.5, 21.81, 50}}) {
    const Mechanism toppling =
        expect_turns_over(block_on_incline(width, height, dip * degree, std::tan(angle * degree)));
    // About its foot, which stays: the centre moves across the way to it.
    const auto& [velocity, spin] = toppling.velocity[0];
    const Vec3 foot{width * std::cos(dip * degree), 0.5, -width * std::sin(dip * degree)};
    const Vec3 centre = block_on_incline(width, height, dip * degree, 1).bodies[0].centre;
    EXPECT_GT(spin[1], 0);
    EXPECT_LT(norm(velocity + cross(spin, foot - centre)), 1e-6 * norm(velocity)) << dip;
  }
}

/// The same numbers everywhere (Knuth's MMIX).
class Random {
 public:
  Real between(Real low, Real high) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return low + (high - low) * static_cast<Real>(state_ >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 2026;
};

/// Two planes under a wedge, and what presses on them, of its weight, where it slides along their line.
struct TwoPlanes {
  std::array<Vec3, 2> normal;  ///< unit, into the wedge
  std::array<Real, 2> friction{}, press{};
  Vec3 line{};  ///< unit, down along both

  explicit TwoPlanes(Random& random) {
    for (int k = 0; k < 2; ++k) {
      const Real dip = random.between(30, 75) * degree, to = random.between(0, 360) * degree;
      normal[k] = {std::sin(dip) * std::cos(to), std::sin(dip) * std::sin(to), std::cos(dip)};
      friction[k] = std::tan(random.between(15, 45) * degree);
    }
    line = normalized(cross(normal[0], normal[1]));
    if (line[2] > 0) line = -line;
    const Real c = dot(normal[0], normal[1]);
    for (int k = 0; k < 2; ++k) press[k] = (normal[k][2] - c * normal[1 - k][2]) / (1 - c * c);
  }
  bool slides_on_both() const { return press[0] > 0 && press[1] > 0; }

  /// By statics of forces alone: along the line; where it would have to pull at one plane, down the other.
  Real factor() const {
    if (slides_on_both()) return (press[0] * friction[0] + press[1] * friction[1]) / -line[2];
    const int k = press[0] > 0 ? 0 : 1;
    return friction[k] * normal[k][2] / std::hypot(normal[k][0], normal[k][1]);
  }

  /// Its centre is at 0.
  RigidMass wedge(const std::array<std::vector<Vec3>, 2>& corner) const {
    RigidMass mass;
    mass.bodies.push_back({0, {}, {0, 0, -1e6}, {}});
    for (int k = 0; k < 2; ++k) {
      ContactArea area;
      area.body = {0, none};
      area.normal = normal[k];
      area.corner = corner[k];
      if (dot(cross(corner[k][1] - corner[k][0], corner[k][2] - corner[k][0]), normal[k]) < 0)
        std::reverse(area.corner.begin(), area.corner.end());
      area.friction = friction[k];
      area.joint = "joint";
      mass.contacts.push_back(area);
    }
    return mass;
  }
};

// Both areas go through its centre of gravity: no force has a moment. Hoek & Bray, Rock Slope Engineering: wedge failure.
TEST(Published, WedgesOfWhichForcesDecideFailByTheStaticsOfTwoPlanes) {
  Random random;
  int on_both = 0, on_one = 0;
  while (on_both + on_one < 40) {
    const TwoPlanes planes(random);
    ++(planes.slides_on_both() ? on_both : on_one);
    std::array<std::vector<Vec3>, 2> strip;
    for (int k = 0; k < 2; ++k) {
      const Vec3 along = 10.0 * planes.line, across = cross(planes.line, planes.normal[k]);
      strip[k] = {-along - across, along - across, along + across, across - along};
    }
    const auto& [bound, sliding] = factors_of(planes.wedge(strip));
    EXPECT_NEAR(sliding.factor, planes.factor(), 1e-3 * planes.factor()) << on_both + on_one;
    EXPECT_GT(bound.above.factor, (1 - 1e-5) * planes.factor());
  }
  EXPECT_GE(on_both, 20);
  EXPECT_GE(on_one, 8);
}

// Tetrahedra that rest on two faces. Some pressures on these balance the moments, too: they need not turn.
TEST(Published, TetrahedraSlideByTheStaticsOfTwoPlanes) {
  Random random;
  for (int tried = 0, tested = 0; tested < 30; ++tried) {
    ASSERT_LT(tried, 1000);
    const TwoPlanes planes(random);
    const Vec3 toe{}, top = -10.0 * planes.line;
    std::array<Vec3, 2> side;  // up each plane, away from the line
    for (int k = 0; k < 2; ++k) {
      Vec3 away = cross(planes.line, planes.normal[k]);
      if (dot(away, planes.normal[1 - k]) < 0) away = -away;
      const Real along = random.between(-3, -1), up = random.between(3, 8);
      side[k] = along * planes.line + up * away;
    }
    const bool between = side[0][2] > toe[2] && side[1][2] > toe[2];
    if (std::min(planes.press[0], planes.press[1]) < 0.05 || planes.line[2] > -0.17 || !between)
      continue;
    ++tested;
    const Vec3 centre = 0.25 * (toe + top + side[0] + side[1]);
    std::array<std::vector<Vec3>, 2> face;
    for (int k = 0; k < 2; ++k) face[k] = {toe - centre, top - centre, side[k] - centre};
    EXPECT_NEAR(factors_of(planes.wedge(face)).sliding.factor, planes.factor(),
                1e-3 * planes.factor())
        << tested;
  }
}

// The factor by which friction may be divided is 1 at their limit, and their mechanism is the one that is found.
TEST(Published, GoodmanAndBraysSlopeHasFactorOne) {
  const RigidMass slope = toppling_slope(goodman_bray_friction);
  const auto& [bound, sliding] = factors_of(slope);
  EXPECT_NEAR(sliding.factor, 1, 1e-2);
}

// The lowest block is pulled out from under the others: they go with it, and all their weight presses on the base.
TEST(Published, APulledBlockCarriesWhatStandsOnIt) {
  for (const std::size_t blocks : {2, 4}) {
    RigidMass mass = tower(4, 1, std::vector<Real>(blocks, 0), 0.65);
    mass.bodies[0].force[0] = -0.5 * mass.bodies[0].force[2];
    expect_factor(mass, 0.65 * blocks / 0.5);
  }
}

// All joints fail at once; a state of collapse exists.
TEST(Published, ATowerSlidesWhereThePullIsItsFriction) {
  for (const std::size_t blocks : {2, 3, 5, 12})
    for (const Real share : {0.3, 0.7, 0.98}) {
      const Real pull = share * 0.4 / (0.175 * blocks);
      expect_factor(tower(0.4, 0.175, std::vector<Real>(blocks, 0), 0.65, pull), 0.65 / pull);
    }
}

}  // namespace
}  // namespace rockfold
