// law.hpp on the device.
#pragma once

#include <limits>

#include "kernels/contact/law.hpp"
#include "kernels/device/device_kernel.hpp"

namespace rockfold::contact {

namespace math = device::math;

// As fmax and fmin, which compilers call as functions for the sake of numbers that are none.
KOKKOS_INLINE_FUNCTION Real larger(Real a, Real b) {
  return a > b ? a : b;
}
KOKKOS_INLINE_FUNCTION Real smaller(Real a, Real b) {
  return a < b ? a : b;
}

KOKKOS_INLINE_FUNCTION ImpactRule impact_rule(Real restitution, Real period, Real dt) {
  ImpactRule rule;
  rule.restitution = restitution;
  rule.period = larger(period, 0.5 * dt);
  if (dt > 0) rule.shear_drag = (1 - restitution) * shear_delay * period / dt;
  return rule;
}

/// Of a point whose step is explicit (kernels/time/explicit).
KOKKOS_INLINE_FUNCTION ImpactRule explicit_rule(Real restitution, Real period, Real dt) {
  ImpactRule rule;
  rule.restitution = restitution;
  rule.period = larger(period, 0.5 * dt);
  rule.momentary = true;
  if (restitution < 1)
    rule.joint_drag = larger(2 * least_damping * rule.period,
                             smaller(2 * explicit_damping * rule.period, most_drag * dt));
  if (dt > 0) {
    rule.reach = rule.period * rule.period / dt;
    rule.shear_drag = rule.joint_drag / dt;
  }
  return rule;
}

/// Over one step; p > 0 presses.
struct Pressure {
  Real value = 0;      ///< Pa, what acts
  Real stiffness = 0;  ///< Pa/m, −d(value)/d(gap)
};

/// The mean over a step that does exactly the work of ½ k ⟨−g⟩².
KOKKOS_INLINE_FUNCTION Pressure mean_pressure(Real k, Real g0, Real g1) {
  const Real x0 = larger(0.0, -g0), x1 = larger(0.0, -g1);
  Pressure p;
  if (x0 > 0 && x1 > 0) {
    p.value = 0.5 * k * (x0 + x1);
    p.stiffness = 0.5 * k;
  } else if (x0 > 0 || x1 > 0) {  // it opens or closes within the step
    const Real closing = g0 - g1;
    p.value = 0.5 * k * (x1 * x1 - x0 * x0) / closing;
    p.stiffness = (k * x1 - p.value) / closing;
  }
  return p;
}

/// That of the step's end.
KOKKOS_INLINE_FUNCTION Pressure end_pressure(Real k, Real g1) {
  Pressure p;
  p.value = -k * g1;
  p.stiffness = k;
  return p;
}

/// In an explicit step: of what is open the speed of now; of what is pressed the largest since it began to close, or, where nothing is given back and it
/// fades, since it was open. `parting` tells that it has turned.
KOKKOS_INLINE_FUNCTION void watch_approach(const ImpactRule& rule, const PointMotionInStep& motion,
                                           bool open, ContactMemory& memory) {
  const Real closing = -motion.speed_before;
  const bool again = memory.parting && closing > 0 && rule.restitution > 0;
  if (open || again || closing > memory.approach) memory.approach = larger(0.0, closing);
  memory.parting = !open && !(closing > 0);
}

/// Of what presses in an explicit step, the share that an impact explains.
KOKKOS_INLINE_FUNCTION Real share_of_impact(const ImpactRule& rule, Real approach, Real g1) {
  return g1 < 0 ? smaller(1.0, -approach * rule.period / g1) : 0;
}

/// Of what presses at a point, the share by which blocks are rigid: whole up to twice the depth that its impact explains, since a load presses with it.
KOKKOS_INLINE_FUNCTION Real rigid_share(Real period, Real approach, Real g1) {
  ImpactRule rule;
  rule.period = period;
  return share_of_impact(rule, 2 * approach, g1);
}

/// In an explicit step: what an impact has stretched along a face returns e² of its energy, by a stiffness as much greater (Walton & Braun, J. Rheol. 30,
/// 1986, 949). s: the elastic stretch at the step's end.
KOKKOS_INLINE_FUNCTION void release(const ImpactRule& rule, const ContactMemory& before, Real share,
                                    const PointMotionInStep& motion, Real* s) {
  const Real* was = before.shear;
  const Real length = math::sqrt(was[0] * was[0] + was[1] * was[1]);
  const Real back = -(was[0] * motion.shear[0] + was[1] * motion.shear[1]);
  if (!(back > 0)) return;
  const Real given = 1 - share * (1 - rule.restitution * rule.restitution),
             way = back / length;  // of `length`
  const Real along = way > given * length ? given * length - way : length - way / given;
  for (int i = 0; i < 2; ++i) s[i] += was[i] / length * (along - (length - way));
}

/// Keeps account of the closing speed that a rebound is measured by.
KOKKOS_INLINE_FUNCTION void remember_approach(const PointMotionInStep& motion,
                                              ContactMemory& memory) {
  const Real closing = -motion.speed_before;
  if (closing > 0) {
    memory.approach = memory.parting ? closing : larger(memory.approach, closing);
    memory.parting = 0;
  } else {
    memory.parting = 1;
  }
}

/// In an explicit step: what is deeper than the impact explains presses as a spring that is damped critically while it parts, the rest no harder than
/// brings the sides to the speed of their rebound in this step.
KOKKOS_INLINE_FUNCTION Pressure momentary_impact(Real k, const ImpactRule& rule,
                                                 const ContactMemory& memory,
                                                 const PointMotionInStep& motion, Real g1) {
  Pressure p;
  if (!(g1 < 0)) return p;
  p = end_pressure(k, g1);
  if (rule.restitution >= 1 || !(rule.reach > 0)) return p;
  const Real beyond = motion.speed - rule.restitution * memory.approach;
  const Real depth = -g1 - memory.approach * rule.period - 2 * rule.period * larger(0.0, beyond);
  const Real loaded = k * larger(0.0, depth), most = k * rule.reach * larger(0.0, -beyond);
  p.value = smaller(p.value, loaded + most);
  return p;
}

/// Of the closing speed, by how much a rebound may be too fast. Where nothing rebounds, the time in which a load relaxes goes with its inverse.
KOKKOS_INLINE_FUNCTION Real rebound_error(const ImpactRule& rule) {
  return restitution_error * (rule.restitution > 0 ? 0.5 * larger(rule.restitution, 0.1) : 1);
}

/// Of a point that has been open before; g: gap less dilation at both ends of the step (law.hpp, "Impact").
KOKKOS_INLINE_FUNCTION Pressure impact_pressure(Real k, const ImpactRule& rule,
                                                const ContactMemory& memory,
                                                const PointMotionInStep& motion, Real g0, Real g1) {
  if (rule.momentary) return momentary_impact(k, rule, memory, motion, g1);
  const Real approach = memory.approach;
  Pressure p;
  if (rule.restitution > 0)
    p = mean_pressure(k, g0, g1);
  else if (g1 < 0)
    p = end_pressure(k, g1);
  const Real beyond = motion.speed - rule.restitution * approach;
  if (!(beyond > 0) || rule.restitution >= 1) return p;
  const Real depth = larger(0.0, -g1), explained = approach * rule.period;
  const bool whole = explained >= depth, least = explained <= restitution_error * depth;
  const Real share = whole ? 1 : least ? restitution_error : explained / depth;
  const Real delay = share * rule.period / rebound_error(rule), drag = k * delay * beyond;
  p.value -= drag;
  p.stiffness += k * delay * motion.speed_by_gap + (whole || least ? 0 : drag / depth);
  if (!(p.value > 0)) p.value = p.stiffness = 0;
  return p;
}

/// Shear that a pressure bears: cohesion + friction · pressure.
struct StrengthLine {
  Real cohesion = 0, friction = 0;
};

/// Slip that a line of strength asks for, and what it adds to the opening.
struct Slip {
  Real length = 0;    ///< m, Δγ
  Real opening = 0;   ///< m, Δδ
  Real dilation = 0;  ///< d(Δδ)/d(Δγ): tan ψ, or 0 at the dilation's limit
};

/// `trial`: k_s |s|; p: the pressure before the joint dilates.
KOKKOS_INLINE_FUNCTION Slip find_slip(const JointLaw& law, const StrengthLine& line, Real trial,
                                      Real p, Real slip_before) {
  Slip s;
  const Real room = larger(0.0, law.dilation_limit - slip_before);
  const Real missing = trial - line.cohesion - line.friction * p;
  s.dilation = room > 0 ? smaller(law.dilation, law.residual_friction) : 0;
  s.length = missing / (law.shear_stiffness + law.normal_stiffness * s.dilation * line.friction);
  if (s.length > room && s.dilation > 0) {  // it comes to the limit within the step
    s.opening = s.dilation * room;
    s.dilation = 0;
    s.length = (missing - law.normal_stiffness * s.opening * line.friction) / law.shear_stiffness;
  } else {
    s.opening = s.dilation * s.length;
  }
  return s;
}

/// Nothing holds: what was stored in shear is lost.
KOKKOS_INLINE_FUNCTION void open(const JointLaw& law, PointTraction& out) {
  ContactMemory& m = out.memory;
  out.friction = 0.5 * law.shear_stiffness * (m.shear[0] * m.shear[0] + m.shear[1] * m.shear[1]);
  m.shear[0] = m.shear[1] = m.pressed = 0;
  m.state = Contact::open;
  m.broken = m.met = m.loose = 1;
}

/// Pa: bonds bear whatever comes while forces are sought.
inline constexpr Real unlimited = std::numeric_limits<Real>::max();

/// The pressure, what shear bears at most, and how both change.
struct Strength {
  Real pressure = 0, shear = 0;  ///< Pa
  Real slope = 0;                ///< d(shear)/d(pressure)
  Real by_gap = 0;               ///< Pa/m, −d(pressure)/d(gap)
  Real by_shear[2] = {0, 0};     ///< Pa/m, −d(pressure)/d(shear): of dilation
};

/// What bears shear without bonds. Sides that have been apart do not grow together, and those that no joint joined never did: they have no
/// cohesion.
KOKKOS_INLINE_FUNCTION StrengthLine residual_line(const JointLaw& law,
                                                  const ContactMemory& before) {
  return {before.loose ? 0 : law.residual_cohesion, law.residual_friction};
}

/// Of that line under a pressure ≥ 0.
KOKKOS_INLINE_FUNCTION Strength residual_strength(const StrengthLine& line, const Pressure& p) {
  const Real whole = line.cohesion + p.value * line.friction, most = most_cohesion * p.value;
  if (whole <= most) return {p.value, whole, line.friction, p.stiffness};
  return {p.value, most, most_cohesion, p.stiffness};
}

/// Slip along m = s/|s| until the stretch s is one that strength bears. False where no pressure is left, with what dilation adds.
KOKKOS_INLINE_FUNCTION bool slide(const JointLaw& law, StrengthLine line, const Pressure& p,
                                  const Real* s, Real length, Strength& now, PointTraction& out) {
  const Real ks = law.shear_stiffness, kn = law.normal_stiffness, trial = ks * length;
  Slip slip = find_slip(law, line, trial, p.value, out.memory.slip);
  if ((most_cohesion - line.friction) * (p.value + kn * slip.opening) < line.cohesion) {
    line = {0, most_cohesion};
    slip = find_slip(law, line, trial, p.value, out.memory.slip);
  }
  now.pressure = p.value + kn * slip.opening;
  if (now.pressure < 0) return false;
  // dΔγ = (k_s m·dΔ + tan φ k dg)/h, k = −dp/dg of the trial
  const Real h = ks + kn * slip.dilation * line.friction;
  now.shear = line.cohesion + line.friction * now.pressure;
  now.slope = line.friction;
  now.by_gap = p.stiffness * (1 - kn * slip.dilation * line.friction / h);
  out.memory.state = Contact::slide;
  for (int i = 0; i < 2; ++i) {
    const Real m = length > 0 ? s[i] / length : 0;
    now.by_shear[i] = -kn * slip.dilation * ks / h * m;
    out.memory.shear[i] = now.shear / ks * m;
  }
  out.memory.slip += slip.length;
  out.memory.dilation += slip.opening;
  // Nothing but rounding where ψ = φ without cohesion.
  out.friction += larger(0.0, slip.length * now.shear - slip.opening * now.pressure);
  return true;
}

/// Tractions with shear −k_s v, no more than the strength; v = s + drag · way.
KOKKOS_INLINE_FUNCTION void shear(const JointLaw& law, const Strength& now, const Real* s,
                                  const Real* way, Real drag, PointTraction& out) {
  const Real ks = law.shear_stiffness;
  const Real v[2] = {s[0] + drag * way[0], s[1] + drag * way[1]};
  const Real length = math::sqrt(v[0] * v[0] + v[1] * v[1]);
  const bool whole = ks * length <= now.shear;
  const Real share = whole ? ks : now.shear / length;
  out.traction[0] = now.pressure;
  out.tangent[0] = now.by_gap;
  for (int i = 0; i < 2; ++i) {
    const Real along = whole ? 0 : v[i] / length, slope = now.slope * along;
    out.traction[1 + i] = -share * v[i];
    out.tangent[1 + i] = now.by_shear[i];
    out.tangent[3 * (1 + i)] = -slope * now.by_gap;
    for (int j = 0; j < 2; ++j)
      out.tangent[3 * (1 + i) + 1 + j] =
          (1 + drag) * share * ((i == j) - (whole ? 0 : along * v[j] / length)) -
          slope * now.by_shear[j];
  }
}

/// m: the closure whose energy ½ k x² is stored at the end. In an impact, of the true closure no more than what was put in: a long step
/// that ends deep has not compressed the joint by that much.
KOKKOS_INLINE_FUNCTION Real stored_closure(const JointLaw& law, const ContactMemory& before,
                                           const PointMotionInStep& motion, bool impact,
                                           const PointTraction& out) {
  if (!impact) return out.traction[0] / law.normal_stiffness;
  const Real closure = larger(0.0, out.memory.dilation - motion.gap);
  const Real put_in = out.traction[0] * (motion.gap_before - motion.gap);
  const Real had = 0.5 * law.normal_stiffness * before.pressed * before.pressed;
  return smaller(closure, math::sqrt(2 * larger(0.0, had + put_in) / law.normal_stiffness));
}

/// Whether bonds hold that are stronger than what is left once they are broken.
KOKKOS_INLINE_FUNCTION bool is_bonded(const JointLaw& law, const ContactMemory& memory) {
  return !memory.broken && (law.tensile_strength > 0 || law.cohesion > law.residual_cohesion ||
                            law.friction > law.residual_friction);
}

/// Whether bonds that have held through the step cannot bear what it has come to.
KOKKOS_INLINE_FUNCTION bool overloads_bonds(const JointLaw& law, const ContactMemory& before,
                                            const PointTraction& now) {
  const Real* t = now.traction;
  return is_bonded(law, before) &&
         (t[0] < -law.tensile_strength ||
          math::sqrt(t[1] * t[1] + t[2] * t[2]) > larger(0.0, law.cohesion + t[0] * law.friction));
}

/// J/m²: what slip takes in an explicit step, whose forces do the mean of their work at both ends; s: the trial stretch.
KOKKOS_INLINE_FUNCTION Real mean_friction(const JointLaw& law, const ContactMemory& before,
                                          const ContactMemory& after, const Real* s, Real length,
                                          const Strength& now) {
  const Real slip = after.slip - before.slip, opening = after.dilation - before.dilation;
  const Real along = length > 0 ? (before.shear[0] * s[0] + before.shear[1] * s[1]) / length : 0;
  return larger(0.0, 0.5 * slip * (law.shear_stiffness * along + now.shear) -
                         0.5 * opening * (law.normal_stiffness * before.pressed + now.pressure));
}

/// The law of law.hpp. `held`: as if nothing slipped.
KOKKOS_INLINE_FUNCTION PointTraction traction(const JointLaw& law, const ImpactRule& rule,
                                              const ContactMemory& before,
                                              const PointMotionInStep& motion, bool held = false) {
  PointTraction out;
  out.memory = before;
  ContactMemory& memory = out.memory;
  const Real g0 = motion.gap_before - before.dilation, g1 = motion.gap - before.dilation;
  const bool bonded = is_bonded(law, before), moving = motion.speed_by_gap > 0;
  const bool impact = before.met && moving, momentary = rule.momentary && impact;
  const bool gives_back =
      !before.met && moving && rule.restitution > 0 && !rule.momentary && !bonded;
  if (impact && !momentary) remember_approach(motion, memory);
  if (momentary) watch_approach(rule, motion, g1 > 0, memory);
  Pressure p = end_pressure(law.normal_stiffness, g1);  // < 0: what dilation must make up for
  if (impact || gives_back) {
    p = impact ? impact_pressure(law.normal_stiffness, rule, memory, motion, g0, g1)
               : mean_pressure(law.normal_stiffness, g0, g1);
    if (g1 > 0 && (law.dilation > 0 || !(p.value > 0))) {
      p.value -= law.normal_stiffness * g1;
      p.stiffness += law.normal_stiffness;
    }
  }
  if (momentary && !(rule.restitution > 0) && p.value < -law.normal_stiffness * g1)
    memory.approach *= 1 - rule.period / (impact_memory * rule.reach);
  if (rule.momentary && !impact && (p.value > 0 || bonded)) {
    const Real damped = p.value - law.normal_stiffness * rule.joint_drag * motion.speed;
    p.value = bonded ? damped : larger(damped, 0.5 * p.value);
  }
  Real s[2] = {before.shear[0] + motion.shear[0], before.shear[1] + motion.shear[1]};
  if (momentary) release(rule, before, share_of_impact(rule, memory.approach, g1), motion, s);
  const Real length = math::sqrt(s[0] * s[0] + s[1] * s[1]);
  Strength now{p.value, unlimited, 0, p.stiffness};
  const StrengthLine line = residual_line(law, before);
  if (!bonded && !held) now = residual_strength(line, p);
  if (bonded || held || (p.value >= 0 && law.shear_stiffness * length <= now.shear)) {
    memory.state = Contact::stick;
    for (int i = 0; i < 2; ++i) memory.shear[i] = s[i];
  } else if (!slide(law, line, p, s, length, now, out)) {
    open(law, out);
    return out;
  } else if (rule.momentary) {
    out.friction = mean_friction(law, before, memory, s, length, now);
  }
  const bool drags = rule.momentary || (impact && !bonded);
  shear(law, now, s, motion.shear, drags ? rule.shear_drag : 0, out);
  const Real closure = memory.dilation - motion.gap;
  const Real pressed = rule.momentary
                           ? (bonded ? closure : larger(0.0, closure))
                           : stored_closure(law, before, motion, impact || gives_back, out);
  memory.pressed = pressed;
  out.elastic = 0.5 * law.normal_stiffness * pressed * pressed;
  for (const double stretch : memory.shear)
    out.elastic += 0.5 * law.shear_stiffness * stretch * stretch;
  return out;
}

}  // namespace rockfold::contact
