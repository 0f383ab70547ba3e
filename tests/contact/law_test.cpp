// The law of one contact point: every path by hand, its tangent against differences, what it dissipates, impacts at any time step.
#include "kernels/contact/law.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

JointLaw rough() {
  JointLaw law;
  law.normal_stiffness = 4e9;
  law.shear_stiffness = 1.5e9;
  law.friction = 0.7;
  law.cohesion = 3e4;
  law.tensile_strength = 1e4;
  law.residual_friction = 0.5;
  law.residual_cohesion = 5e3;
  law.dilation = 0.2;
  law.dilation_limit = 4e-5;
  return law;
}

JointLaw plain(Real friction) {
  JointLaw law;
  law.normal_stiffness = 2e9;
  law.shear_stiffness = 1e9;
  law.friction = law.residual_friction = friction;
  return law;
}

/// A point that is carried through steps without speeds.
struct Point {
  JointLaw law;
  ContactMemory memory{};
  Real gap = 0;
  PointTraction last{};

  const PointTraction& move(Real to_gap, Real a, Real b = 0) {
    PointMotionInStep m;
    m.gap_before = gap;
    m.gap = gap = to_gap;
    m.shear[0] = a;
    m.shear[1] = b;
    last = point_traction(law, {}, memory, m);
    if (bonds_fail(law, memory, last)) {
      memory.broken = 1;
      last = point_traction(law, {}, memory, m);
    }
    memory = last.memory;
    return last;
  }
};

TEST(JointLaw, GoesOpenStickSlideStickOpen) {
  Point p{plain(0.5)};
  EXPECT_EQ(p.move(1e-6, 0).memory.state, Contact::open);
  p.move(-1e-6, 1e-7);  // 2 kPa of pressure carry 1 kPa of shear; 0.1 kPa acts
  EXPECT_EQ(p.memory.state, Contact::stick);
  EXPECT_DOUBLE_EQ(p.last.traction[0], 2000);
  EXPECT_DOUBLE_EQ(p.last.traction[1], -100);
  p.move(-1e-6, 3e-6);
  EXPECT_EQ(p.memory.state, Contact::slide);
  EXPECT_NEAR(p.last.traction[1], -1000, 1e-9);
  EXPECT_NEAR(p.memory.slip, 3.1e-6 - 1e-6, 1e-18);
  EXPECT_NEAR(p.last.friction, 1000 * 2.1e-6, 1e-15);
  p.move(-1e-6, -5e-7);  // reversal: elastic at first
  EXPECT_EQ(p.memory.state, Contact::stick);
  EXPECT_NEAR(p.last.traction[1], -500, 1e-9);
  p.move(-1e-6, -2e-6);
  EXPECT_EQ(p.memory.state, Contact::slide);
  EXPECT_NEAR(p.last.traction[1], 1000, 1e-9);
  EXPECT_EQ(p.move(1e-9, 0).memory.state, Contact::open);
  for (const Real t : p.last.traction) EXPECT_EQ(t, 0);
  EXPECT_EQ(p.memory.shear[0], 0);
}

TEST(JointLaw, HoldsTensionUntilItBreaksAndNeverAgain) {
  Point p{rough()};
  p.move(2e-6, 0);  // 8 kPa of 10
  EXPECT_EQ(p.memory.state, Contact::stick);
  EXPECT_NEAR(p.last.traction[0], -8000, 1e-9);
  p.move(2.6e-6, 0);
  EXPECT_EQ(p.memory.state, Contact::open);
  EXPECT_EQ(p.memory.broken, 1);
  EXPECT_EQ(p.move(1e-9, 0).memory.state, Contact::open);
}

TEST(JointLaw, FallsToItsResidualStrengthWhenItFirstSlips) {
  JointLaw law = rough();
  law.dilation = 0;
  Point p{law};
  const Real pressure = 4e9 * 1e-5, peak = 3e4 + 0.7 * pressure, residual = 5e3 + 0.5 * pressure;
  p.move(-1e-5, 0.999 * peak / 1.5e9);
  EXPECT_EQ(p.memory.state, Contact::stick);
  EXPECT_EQ(p.memory.broken, 0);
  p.move(-1e-5, 0.002 * peak / 1.5e9);
  EXPECT_EQ(p.memory.state, Contact::slide);
  EXPECT_NEAR(-p.last.traction[1], residual, 1e-9 * residual);
  p.move(-1e-5, -0.1 * residual / 1.5e9);
  p.move(-1e-5, 0.2 * residual / 1.5e9);
  EXPECT_NEAR(-p.last.traction[1], residual, 1e-9 * residual);
}

/// Cohesion 5 kPa, friction 0.5, all of it left after slip.
JointLaw ductile() {
  JointLaw law = plain(0.5);
  law.cohesion = law.residual_cohesion = 5e3;
  return law;
}

TEST(JointLaw, KeepsCohesionThatSlipDoesNotTake) {
  Point p{ductile()};
  for (int slip = 0; slip < 3; ++slip) {  // 20 kPa of pressure: 5 + 0.5 · 20
    p.move(-1e-5, 4e-5);
    EXPECT_EQ(p.memory.state, Contact::slide);
    EXPECT_NEAR(-p.last.traction[1], 15e3, 1e-6);
  }
}

TEST(JointLaw, HasNoCohesionOnceItHasBeenOpen) {
  Point p{ductile()};
  p.move(-1e-5, 4e-5);
  p.move(1e-6, 0);
  EXPECT_EQ(p.memory.state, Contact::open);
  p.move(-1e-5, 4e-5);
  EXPECT_EQ(p.memory.state, Contact::slide);
  EXPECT_NEAR(-p.last.traction[1], 10e3, 1e-6);
}

TEST(JointLaw, LeavesNoForceOfItsCohesionWhereItOpens) {
  Point p{ductile()};
  p.move(-1e-5, 4e-5);
  for (const Real pressure : {1e3, 100.0, 1.0}) {  // its shear is at most ten times that
    p.move(-pressure / 2e9, 4e-5);
    EXPECT_NEAR(-p.last.traction[1], std::min(5e3 + 0.5 * pressure, 10 * pressure), 1e-6);
  }
  for (const Real t : p.move(1e-12, 0).traction) EXPECT_EQ(t, 0);
}

TEST(JointLaw, DilatesBySlipUpToItsLimit) {
  JointLaw law = rough();
  law.cohesion = law.residual_cohesion = law.tensile_strength = 0;
  law.residual_friction = law.friction;
  Point p{law};
  p.move(-1e-5, 0);
  Real slip = 0;
  for (int step = 0; step < 12; ++step) {
    p.move(-1e-5, 6e-5);
    EXPECT_GT(p.memory.slip, slip);
    slip = p.memory.slip;
    const Real opening = 0.2 * std::min(slip, 4e-5);
    EXPECT_NEAR(p.memory.dilation, opening, 1e-18);
    EXPECT_NEAR(p.last.traction[0], 4e9 * (1e-5 + opening), 1e-6);
    EXPECT_NEAR(-p.last.traction[1], 0.7 * p.last.traction[0], 1e-6);
  }
  EXPECT_NEAR(p.memory.dilation, 8e-6, 1e-18);
}

TEST(
    JointLaw,
    ForgetsNothingInAStepThatIsTakenInParts) {  // stick and slide are exact for any division of a straight path
  Point one{plain(0.5)}, many{plain(0.5)};
  one.move(-1e-6, 0);
  many.move(-1e-6, 0);
  one.move(-1e-6, 7e-6, -3e-6);
  for (int i = 0; i < 100; ++i) many.move(-1e-6, 7e-8, -3e-8);
  EXPECT_NEAR(one.memory.slip, many.memory.slip, 1e-16);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(one.last.traction[d], many.last.traction[d], 1e-8);
}

struct RandomStep {
  ContactMemory memory{};
  PointMotionInStep motion{};
  ImpactRule rule{};
};

RandomStep draw(std::mt19937& random, const JointLaw& law) {
  std::uniform_real_distribution<Real> unit(-1, 1);
  RandomStep r;
  const Real size = 3e-5;
  r.memory.shear[0] = 1e-5 * unit(random);
  r.memory.shear[1] = 1e-5 * unit(random);
  r.memory.broken = unit(random) > 0;
  r.memory.met = r.memory.loose = r.memory.broken && unit(random) > 0;
  r.memory.slip = unit(random) > 0 ? 1e-4 : 2e-5;
  r.memory.dilation = law.dilation * std::min(r.memory.slip, law.dilation_limit);
  r.memory.approach = 0.02 * (1 + unit(random));
  r.motion.gap_before = size * unit(random);
  r.motion.gap = r.motion.gap_before + size * unit(random);
  r.motion.shear[0] = size * unit(random);
  r.motion.shear[1] = size * unit(random);
  const Real dt = 1e-3;
  r.motion.speed_before = 0.05 * unit(random);
  r.motion.speed_by_gap = 2 / dt;
  r.motion.speed = 2 / dt * (r.motion.gap - r.motion.gap_before) - r.motion.speed_before;
  r.rule.restitution = unit(random) > 0 ? 0 : 0.5 * (1 + unit(random));
  r.rule.period = 1e-4 * (1.01 + unit(random));
  r.rule.shear_drag = 1 + unit(random);
  return r;
}

TEST(JointLaw, TangentIsTheDerivativeOfTheTraction) {
  std::mt19937 random(3);
  const JointLaw law = rough();
  int smooth = 0;
  for (int n = 0; n < 10000; ++n) {
    const RandomStep r = draw(random, law);
    const PointTraction at = point_traction(law, r.rule, r.memory, r.motion);
    // Differences of 1e-11 m of tractions of 1e5 Pa: rounding 1e-11/1e-11 relative to 1e5·1e-16.
    const Real h = 1e-11;
    for (int j = 0; j < 3; ++j) {
      PointTraction side[2];
      bool same = true;
      for (int s = 0; s < 2; ++s) {
        PointMotionInStep m = r.motion;
        const Real by = s == 0 ? -h : h;
        (j == 0 ? m.gap : m.shear[j - 1]) += by;
        if (j == 0) m.speed += m.speed_by_gap * by;
        side[s] = point_traction(law, r.rule, r.memory, m);
        same = same && side[s].memory.state == at.memory.state &&
               side[s].memory.broken == at.memory.broken &&
               (side[s].traction[0] > 0) == (at.traction[0] > 0) &&
               (side[s].memory.slip < law.dilation_limit) == (at.memory.slip < law.dilation_limit);
      }
      const Real g = r.motion.gap - r.memory.dilation;
      if (!same || std::abs(g) < 2 * h) continue;  // a kink between them
      ++smooth;
      for (int i = 0; i < 3; ++i) {
        const Real slope = -(side[1].traction[i] - side[0].traction[i]) / (2 * h);
        // curvature ~ k/size over h: 1e-6 of k; drag is stiffer by delay·speed_by_gap
        EXPECT_NEAR(at.tangent[3 * i + j], slope, 3e-5 * law.normal_stiffness)
            << n << " " << i << j << " state " << static_cast<int>(at.memory.state);
      }
    }
  }
  EXPECT_GT(smooth, 25000);
}

/// Along random ways through opening, slip and rebound no traction jumps: halving a way often enough leaves no more than its length explains.
TEST(JointLaw, HasNoJumps) {
  std::mt19937 random(11);
  for (const Real cohesion : {0.0, 5e3})
    for (const Real dilation : {0.0, 0.2}) {
      JointLaw law = rough();
      law.cohesion = law.residual_cohesion = cohesion;
      law.friction = law.residual_friction;
      law.tensile_strength = 0;
      law.dilation = dilation;
      for (int n = 0; n < 2000; ++n) {
        const RandomStep from = draw(random, law), to = draw(random, law);
        const auto at = [&](Real share) {
          PointMotionInStep m = from.motion;
          const Real by = share * (to.motion.gap - from.motion.gap);
          m.gap += by;
          m.speed += m.speed_by_gap * by;
          for (int i = 0; i < 2; ++i) m.shear[i] += share * (to.motion.shear[i] - m.shear[i]);
          return point_traction(law, from.rule, from.memory, m);
        };
        Real low = 0, high = 1;
        const auto jump = [&](Real a, Real b) {
          const PointTraction s = at(a), t = at(b);
          return std::max({std::abs(s.traction[0] - t.traction[0]),
                           std::abs(s.traction[1] - t.traction[1]),
                           std::abs(s.traction[2] - t.traction[2])});
        };
        for (int i = 0; i < 40; ++i) {  // to the half with the larger change
          const Real middle = 0.5 * (low + high);
          (jump(low, middle) > jump(middle, high) ? high : low) = middle;
        }
        EXPECT_LT(jump(low, high), 1e-2) << n << " " << cohesion << " " << dilation;  // of 1e5 Pa
      }
    }
}

TEST(JointLaw, NeverDissipatesLessThanNothing) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> unit(-1, 1);
  for (int path = 0; path < 10000; ++path) {
    Point p{rough()};
    if (path % 2 == 0) p.law.residual_friction = 0.1;  // below tan ψ
    Real elastic = 0;
    for (int step = 0; step < 20; ++step) {
      const Real before = p.gap;
      const Real to = 1e-5 * (unit(random) - 0.5);
      const Real a = 2e-5 * unit(random), b = 2e-5 * unit(random);
      const ContactMemory start = p.memory;
      p.move(to, a, b);
      ASSERT_GE(p.last.friction, 0);
      ASSERT_GE(p.last.elastic, 0);
      // What the rock has put in is stored, lost to friction, or lost by the rule at the step's end. An open gap or a first
      // break apart (its peak strength is no potential), that is never less than nothing.
      const Real work =
          -(p.last.traction[0] * (to - before) + p.last.traction[1] * a + p.last.traction[2] * b);
      // 1 J/m² is the size of all of them
      ASSERT_GE(work - (p.last.elastic - elastic) - p.last.friction, -1e-12)
          << path << " " << step << " was " << static_cast<int>(start.state) << " is "
          << static_cast<int>(p.last.memory.state);
      elastic = p.last.elastic;
    }
  }
}

/// Of a point that sticks after it has been open; the gap stays.
TEST(Impact, DragAlongTheFaceOnlyDissipatesAndIsNoMoreThanTheStrength) {
  std::mt19937 random(17);
  std::uniform_real_distribution<Real> unit(-1, 1);
  const JointLaw law = plain(0.5);
  const ImpactRule rule = impact_rule(0, 1e-3, 2e-4);
  EXPECT_EQ(impact_rule(1, 1e-3, 2e-4).shear_drag, 0);
  PointMotionInStep m;
  m.gap = m.gap_before = -1e-5;
  m.speed_by_gap = 1e4;
  ContactMemory memory;
  memory.met = memory.loose = memory.broken = 1;
  memory.pressed = 1e-5;
  Real elastic = 0.5 * law.normal_stiffness * 1e-10, lost = 0;
  for (int step = 0; step < 10000; ++step) {
    for (Real& way : m.shear) way = 1e-6 * unit(random);
    const PointTraction now = point_traction(law, rule, memory, m);
    EXPECT_LE(std::hypot(now.traction[1], now.traction[2]), 0.5 * 2e9 * 1e-5 * (1 + 1e-12));
    const Real work = -(now.traction[1] * m.shear[0] + now.traction[2] * m.shear[1]);
    const Real by_drag = work - (now.elastic - elastic) - now.friction;
    ASSERT_GE(by_drag, -1e-12) << step;
    lost += by_drag;
    elastic = now.elastic;
    memory = now.memory;
  }
  EXPECT_GT(lost, 0);
}

TEST(JointLaw, IsTheSameInATurnedFrame) {
  std::mt19937 random(5);
  const JointLaw law = rough();
  const Real c = std::cos(0.83), s = std::sin(0.83);
  const auto turn = [&](Real* v) {
    const Real a = v[0], b = v[1];
    v[0] = c * a - s * b;
    v[1] = s * a + c * b;
  };
  for (int n = 0; n < 1000; ++n) {
    RandomStep r = draw(random, law);
    PointTraction one = point_traction(law, r.rule, r.memory, r.motion);
    turn(r.memory.shear);
    turn(r.motion.shear);
    const PointTraction two = point_traction(law, r.rule, r.memory, r.motion);
    turn(one.traction + 1);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(one.traction[i], two.traction[i], 1e-9 * 1e5);
    EXPECT_NEAR(one.friction, two.friction, 1e-14);
    EXPECT_NEAR(one.tangent[0], two.tangent[0], 1e-6 * 4e9 * 1e-6);
  }
}

/// A mass that flies against a joint, in average acceleration: what it leaves with over what it came with.
Real rebound(Real restitution, Real omega_dt, Real phase) {
  JointLaw law = plain(0);
  const Real mass = 3, area = 0.7, stiffness = law.normal_stiffness * area;
  const Real dt = omega_dt * std::sqrt(mass / stiffness), speed = 0.4;
  const ImpactRule rule = impact_rule(restitution, std::sqrt(mass / stiffness), dt);
  ContactMemory memory;
  memory.met = memory.loose = memory.broken = 1;
  Real gap = phase * speed * dt, v = -speed;
  for (int step = 0; step < 1000000; ++step) {
    PointMotionInStep m;
    m.gap_before = gap;
    m.speed_before = v;
    m.speed_by_gap = 2 / dt;
    const auto excess = [&](Real end) {  // rises with the speed at the end
      m.speed = end;
      m.gap = gap + dt * (v + end) / 2;
      return mass * (end - v) / dt - area * point_traction(law, rule, memory, m).traction[0];
    };
    Real low = -2 * speed, high = 2 * speed;
    for (int i = 0; i < 90; ++i) (excess((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
    excess((low + high) / 2);
    memory = point_traction(law, rule, memory, m).memory;
    gap = m.gap;
    v = m.speed;
    if (gap > 0 && v > 0) break;
    if (std::abs(v) < 1e-6 * speed && memory.parting) break;  // creeps
  }
  return v / speed;
}

TEST(Impact, ReboundsAsRestitutionSaysWhateverTheTimeStep) {
  for (const Real e : {0.0, 0.1, 0.25, 0.5, 0.75, 0.9, 1.0})
    for (const Real omega_dt : {0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0})
      for (int i = 0; i < 9; ++i) {
        const Real ratio = rebound(e, omega_dt, 0.01 + 0.12 * i);
        // the law's estimate, and its next order
        EXPECT_NEAR(ratio, e,
                    restitution_error * (1 + 2 * restitution_error) * std::sqrt(1 - e * e) + 1e-9)
            << e << " at " << omega_dt;
      }
}

}  // namespace
}  // namespace rockfold
