// What contact is made of: the law of a joint, what a contact point remembers, what detection and the step tell each other.
// The contract between src/run (which fills the laws), kernels/contact (which holds the points) and src/io (which stores them).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Mohr–Coulomb's law of a joint, for a unit of area.
struct JointLaw {
  Real normal_stiffness = 0;   ///< Pa/m
  Real shear_stiffness = 0;    ///< Pa/m
  Real friction = 0;           ///< tan φ
  Real cohesion = 0;           ///< Pa
  Real tensile_strength = 0;   ///< Pa
  Real residual_friction = 0;  ///< tan φ once it has slipped or opened
  Real residual_cohesion = 0;  ///< Pa, then; there is no tensile strength then
  Real dilation = 0;           ///< tan ψ, ψ ≤ φ: opening by slip, …
  Real dilation_limit = std::numeric_limits<Real>::infinity();  ///< … up to this slip, m
};

/// The states of a contact point.
enum class Contact : std::uint8_t { open, stick, slide };

/// What a contact point remembers from step to step. Tangential components are those in its frame (ContactPoint).
struct ContactMemory {
  Real shear[2] = {0, 0};  ///< m, elastic shear stretch: the shear traction is −k_s times it
  Real pressed = 0;        ///< m, elastic closure; of a joint in tension negative
  Real slip = 0;           ///< m, all slip so far
  Real dilation =
      0;  ///< m, by which slip has opened the joint, and the initial stress closed it at step 0
  Real approach = 0;  ///< m/s, the largest closing speed since it last parted
  Contact state = Contact::open;
  std::uint8_t broken = 0;  ///< 1: cohesion and friction are residual, tensile strength is lost
  std::uint8_t met = 0;     ///< 1: it has been open before; what closes then is an impact
  std::uint8_t parting =
      0;  ///< 1: the step before began with its sides moving apart; in explicit steps: an impact has rebounded
  std::uint8_t loose = 0;  ///< 1: its sides have been apart, or no joint joined them: no cohesion
  std::uint8_t unused[3] = {};  ///< so that equal memories are equal bytes
};

/// How the two sides of a contact point have moved, in its frame: normal first, apart is positive.
struct PointMotionInStep {
  Real gap = 0;         ///< m, at the end of the step; penetration is negative
  Real gap_before = 0;  ///< m, at its start
  Real shear[2] = {
      0, 0};       ///< m, tangential displacement of the first side against the second in the step
  Real speed = 0;  ///< m/s, d(gap)/dt at the end of the step
  Real speed_before = 0;  ///< m/s, at its start
  Real speed_by_gap =
      0;  ///< 1/s, d(speed)/d(gap): γ/(βΔt) of Newmark's method; 0: there are no speeds
};

/// What a law answers: for a unit of area, on the first side.
struct PointTraction {
  Real traction[3] = {0, 0, 0};  ///< Pa; the normal one is ≥ 0 where the sides are pressed together
  Real tangent[9] =
      {};  ///< Pa/m, −d(traction)/d(gap, shear), row-major; not symmetric while it slides
  ContactMemory memory{};  ///< at the end of the step
  Real friction = 0;       ///< J/m², lost to slip and to broken bonds in the step, ≥ 0
  Real elastic = 0;        ///< J/m², stored at the end of the step
};

/// How impacts end at a point.
struct ImpactRule {
  Real restitution = 0;    ///< separation speed over closing speed, 0 … 1
  Real period = 0;         ///< s, P: drag of parting over stiffness, where a load presses
  Real shear_drag = 0;     ///< drag of a step's motion along the face over shear stiffness
  bool momentary = false;  ///< pressures are those of the moment, not means over a step; then:
  Real reach =
      0;  ///< s, P²/h: k · reach · Δv is the pressure that changes the speed of parting by Δv in the step h
  Real joint_drag = 0;  ///< s, over stiffness: of sides that no impact brought together
};

/// One contact point: a point of one surface opposite a point of another.
/// d = Σ weight·x(vertex) is the place of the first side from the second: weights of the first side sum to 1, of the second to −1.
/// A vertex on a face has 1 + 3 vertices, two edges 2 + 2, points inside two faces 3 + 3; unused ones repeat another with weight 0.
struct ContactPoint {
  std::int64_t key =
      0;  ///< kind and features; with the pair of parts it is the point's name as long as it lives
  Index vertex[6] =
      {};  ///< into SurfaceArrays::vertex; 0 … 2 on the first side, 3 … 5 on the second
  Real weight[6] = {};
  Real normal[3] = {};  ///< unit, from the second side to the first; the gap is normal·d + offset
  Real along[3] =
      {};  ///< unit, first tangential direction, carried by the material; the second is normal × along
  Real area = 0;          ///< m²
  Real gap_before = 0;    ///< m, at the start of the step
  Real speed_before = 0;  ///< m/s, of parting, then
  Real shear_before[2] = {
      0, 0};  ///< m, tangential components of d at the start of the step, in the frame of then
  Real offset = 0;  ///< m, so that the gap of a joint of the cut is zero at step 0
  Real period = 0;  ///< s, √(m/K) of the two blocks and all that is between them (impact_rule)
  ContactMemory memory{};
  std::int16_t law = 0;       ///< into the laws
  std::int16_t surfaces = 0;  ///< of the two sides, into ContactOptions::law_of_pair
  Index joint =
      none;  ///< that both sides are faces of (SurfaceArrays::face_joint); none: two faces that met
};
static_assert(sizeof(ContactPoint) <= 256);

/// What detection found.
struct DetectReport {
  Index pairs = 0;       ///< of convex parts whose boxes are near
  Index points = 0;      ///< contact points, open ones within reach too
  Index missed = 0;      ///< points with a negative gap that the detection before did not have
  bool rebuilt = false;  ///< whether boxes were sorted again
  bool served = false;   ///< the points are those found before
  Real deepest = 0;      ///< m, the largest penetration
};

/// Sums over all points; J.
struct ContactEnergy {
  Real elastic = 0;   ///< stored in the joints at the end of the step
  Real before = 0;    ///< at its start, over the areas of now
  Real friction = 0;  ///< lost in the step by slip and broken bonds, ≥ 0
  Real impact =
      0;  ///< lost in the step otherwise: by restitution, and by the rule at the step's end
};

/// Where contact made most energy out of nothing.
struct EnergyGain {
  Real energy = 0;     ///< J, of the pair of parts that gained most in a step
  ContactPoint point;  ///< a point of that pair
};

/// A place where two blocks touch, or are within reach of it.
struct ContactSample {
  Vec3 place{};         ///< m, of the first side
  Index block[2] = {};  ///< of the sides
  Index joint = none;   ///< into BlockArrays::origins; none: two faces that met
  Index material =
      none;  ///< whose law holds, into Model::joint_materials; none: intact rock, or a model without any
  Vec3 normal{};  ///< unit, from the second side to the first
  Contact state = Contact::open;
  Real gap = 0;            ///< m; negative: the joint has closed
  Real area = 0;           ///< m²
  Real normal_stress = 0;  ///< Pa, compression negative
  Vec3 shear{};            ///< Pa, on the first side, along the joint
  Real slip = 0;           ///< m, all slip so far
};

/// How many points are in each state.
struct ContactCount {
  Index open = 0, stick = 0, slide = 0;
  Real largest_penetration = 0;  ///< m
};

}  // namespace rockfold
