// The law of one contact point: Mohr–Coulomb friction with bonds that break, dilation and impact, taken at the end of the step.
//
// With gap g (apart positive), shear displacement Δ of the first side in the step, elastic shear stretch s₀ and dilation δ₀ before it:
//
//   trial         s = s₀ + Δ,  p = −k_n (g − δ₀)                    p: pressure
//   bonded        elastic, whatever the traction
//   strength      τ_max = min(c + p tan φ, 10 p)                    residual c, φ; c = 0 once it has been open
//   stick         k_s |s| ≤ τ_max                                   τ = −k_s s
//   slide         by Δγ along m = s/|s|:  k_s (|s| − Δγ) = c + (p + k_n Δδ) tan φ,  Δδ = tan ψ Δγ up to the dilation's limit (ψ no more than the φ in use)
//                 Δγ = (k_s |s| − c − p tan φ) / (k_s + k_n tan ψ tan φ); with 0 and 10 for c and tan φ where that is less
//   open          p + k_n Δδ < 0                                    no traction
//
// Traction is continuous where a joint opens: cohesion of a joint without bonds vanishes with its pressure, and one that dilates opens once its
// slip no longer makes up for the gap. A jump there has loads without a balance: Newton's iteration went to and fro in steps however short.
//
// (Simo & Laursen, Comput. Struct. 42, 1992, 97: return mapping of friction; dilation as a flow rule that is not associated.)
// What slip dissipates is Δγ (τ − p tan ψ) = Δγ (c + p (tan φ − tan ψ)) ≥ 0 for ψ ≤ φ.
//
// Bonds: peak cohesion, peak friction and tensile strength σ_t. They hold while forces are sought, and break where, in balance, p < −σ_t or
// k_s |s| > c + p tan φ with the peak values; balance is then sought again. So the law that Newton's method sees is continuous, and which
// bonds break does not depend on the way to the balance.
//
// The pressure at the step's end makes a step dissipate: for a convex energy e, e(g₁) − e(g₀) ≤ −p(g₁) (g₁ − g₀).
//
// Impact. A point that has been open before rebounds with `restitution` times the speed w_in with which it closed, whatever the time
// step. While it parts, its pressure is reduced by a drag that acts only beyond that speed:
//
//   p = max(0, p_spring + k_n T min(0, e w_in − ġ)),     ġ the speed of parting at the end of the step
//
// The spring alone would return more than that: for e > 0 its pressure is the discrete gradient (φ(g₁) − φ(g₀))/(g₁ − g₀) of
// φ = ½ k_n ⟨−g⟩², with which average acceleration keeps energy to the last bit (Gonzalez, J. Nonlinear Sci. 6, 1996, 449); e = 1 is this without
// drag. For e = 0 it is that of the step's end. T makes the drag as stiff as needed: at penetration x the speed exceeds e w_in by
// x/T. After closing with w_in, x is then at most w_in max(√(1 − e²)/ω, (1 − e) Δt/2) (elastic; or within one step), ω² = k_n A/m of
// the pair, so that T = P/0.01, P = max(1/ω, Δt/2), holds the restitution to 0.01 √(1 − e²). Where x is more than the impact explains, a load presses and
// parting is vibration: T = P/0.01 · w_in P/x there, and P at least. (With all of T joints under load lose their pressure at the slightest
// motion apart, and Newton's iteration seeks them one by one.)
// Along the face nothing is given back either: the shear of such a point is k_s (s + (1 − e) T_s Δ/Δt), no more than its strength, with
// T_s = 10/ω: of a stretch a tenth of its speed comes back. The stretch s slips as above.
// Restitution is that of blocks as wholes: what would set a block swinging is taken from it while an impact lasts (kernels/time/rebounds_kernel.hpp, and
// `stiffen` of kernels/time/explicit/ticks.cpp), or it would leave with less than e w_in and with more when it next hits.
// Explicit steps look at a point many times while it is pressed, and take what acts now (momentary_impact): the spring's pressure, but no more than
// brings the sides to e w_in in this substep, and holds them there until they are apart. As in implicit steps w_in is that of the last closing. Where e = 0 a
// point that shakes under its load closes and parts many times within one impact: there w_in is the largest since it was open, and fades while it
// presses less than its spring would. Of the closure w_in P is the impact's; what is deeper is borne as a load. (At the deepest point of a fall onto a spring
// that is its balance: √((w₀P)² + x_s²) of the x_s + √((w₀P)² + x_s²).) The impact's share of the shear stretch returns e² of its energy, so that an
// edge that hits comes to rest along the face too. What is closed for good is damped, as implicit steps of some length do by themselves: blocks on
// elastic joints with friction have motions that grow on their own (a cube 0.25 % below its limit of sliding, on joints stiffer than its rock).
// A joint of the cut that has never opened is elastic: waves pass through it without drag, and with e > 0 its pressure is the discrete gradient
// too, so that blocks in touch hand on what hits them.
#pragma once

#include "src/arrays/contact_arrays.hpp"

namespace rockfold {

/// Restitution is held to this share of the closing speed, and to half this share of rebounds that are a tenth of it or more: heights go by twice that, bounce by bounce.
inline constexpr Real restitution_error = 0.01;

/// Residual cohesion is no more than this times the pressure: all of it from a tenth of it on.
inline constexpr Real most_cohesion = 10;

/// Periods 1/ω over which what sticks is slowed along a face.
inline constexpr Real shear_delay = 10;

/// Of critical, of joints at the frequency 1/P, in explicit steps: as much as their steps bear, or friction shakes loose what it should hold near its
/// limit (implicit steps of a millisecond damp as much by themselves).
inline constexpr Real explicit_damping = 0.7, least_damping = 0.1;

/// Substeps h, in explicit steps: a drag of T = 1.5 h on all points is stable where (ωh)² (1 + 2 T/h) ≤ 4, that is for the (ωh)² ≤ 0.9 of
/// critical_step.cpp.
inline constexpr Real most_drag = 1.5;

/// Periods 1/ω in which, in explicit steps with e = 0, an impact is forgotten while it presses less than its spring would: its closure w_in P then presses as a
/// load does, and comes out at w_in/12, 0.7 % of the height of a fall.
inline constexpr Real impact_memory = 12;

/// `period`: 1/ω = √(m/K), s, with m = m₁ m₂/(m₁ + m₂) of two blocks and K (N/m) all that is between them.
ImpactRule impact_rule(Real restitution, Real period, Real dt);

/// The traction of a point, for the step from `memory` on. Without speeds (speed_by_gap = 0) there is no impact.
PointTraction point_traction(const JointLaw& law, const ImpactRule& impact,
                             const ContactMemory& memory, const PointMotionInStep& motion);

/// Whether bonds that held through the step from `memory` on do not bear what it came to.
bool bonds_fail(const JointLaw& law, const ContactMemory& memory, const PointTraction& now);

}  // namespace rockfold
