// What an analysis hands back: plain numbers for JSON documents and for the result file.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "src/arrays/bolt_arrays.hpp"
#include "src/arrays/contact_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/base/types.hpp"
#include "src/run/farthest_off_place.hpp"
#include "src/run/settling.hpp"

namespace rockfold {

/// Stress as xx yy zz xy yz zx, Pa, tension positive.
using Stress = std::array<Real, 6>;

/// One state worth storing: t = 0, every `output.every` steps, and the last.
struct StoredState {
  Index step = 0;
  StateArrays motion;                  ///< of every physical cover; holds the time
  std::vector<Stress> element_stress;  ///< [nR + E] in the element numbering of CoverArrays
  std::vector<Stress> block_stress;    ///< [B] mean over each block's volume
  std::vector<Stress> nodal_stress;    ///< [K] at RunInput::mesh's points; empty without one
  std::optional<std::vector<ContactSample>> contacts;  ///< where blocks touch each other
  std::vector<std::uint8_t> gone;  ///< [B] 1: excavated on the way; empty where nothing goes in any
  BoltLineState bolts;             ///< empty without bolts
};

/// One material point over time; every vector has one entry for t = 0 and one for each step done.
struct MonitorHistory {
  std::string name;
  Index material = none;           ///< of the rock there, into Model::materials
  std::vector<Real> time;          ///< s
  std::vector<Vec3> displacement;  ///< m
  std::vector<Vec3> velocity;      ///< m/s
  std::vector<Vec3> acceleration;  ///< m/s²
  std::vector<Stress> stress;      ///< Pa, of the element that holds the point
};

/// The joint nearest to a point, over time: the contact of the two blocks that it parts there.
struct JointHistory {
  std::string name, joint;
  std::vector<Real> time;           ///< s
  std::vector<Real> normal_stress;  ///< Pa, compression negative; mean over the contact's area
  std::vector<Real> shear_stress;   ///< Pa, length of the mean
  std::vector<Real> opening;        ///< m, at the point nearest; negative: the joint has closed
  std::vector<Real> slip;           ///< m, how far the sides have moved along the joint there
  std::vector<Contact> state;       ///< open where no point touches, slide where one does
};

/// A block as a whole at the end. Averages are over its volume.
struct BlockMotion {
  Vec3 displacement{};  ///< m
  /// rad: axis times angle of the mean rotation; under small kinematics half the curl of the displacement.
  Vec3 rotation{};
  Real volume = 0;  ///< m³, under large kinematics of the deformed block
};

/// The point of the rock that has moved furthest: displacement is linear in each element, so it is a vertex of one. Under large kinematics
/// none where all is within rounding (way_of_rounding).
struct LargestDisplacement {
  Real length = 0;     ///< m
  Vec3 point{};        ///< m, before the motion
  Index block = none;  ///< that holds the point
};

/// How near the rock is to failure.
struct RockStrength {
  Real least_ratio =
      0;  ///< strength over stress (src/io/viewers/stress_measures.hpp) of the element nearest to failure
  Vec3 point{};            ///< m, its centroid
  Index block = none;      ///< that holds it; none: no rock has a strength
  Real failed_volume = 0;  ///< m³ of elements whose ratio is below 1
};

/// Motion of the ground since t = 0.
struct BaseMotion {
  Vec3 displacement{};  ///< m
  Vec3 velocity{};      ///< m/s
  Vec3 acceleration{};  ///< m/s²
};

/// What a condition's fixed points do to the rock.
struct Reaction {
  Vec3 force{};   ///< N
  Vec3 moment{};  ///< N·m about the origin
};

/// Contact points in each state, and what steps took; one entry for t = 0 and one for each step done.
struct ContactHistory {
  std::vector<Index> open, stick, slide;
  std::vector<Index> iterations;  ///< of Newton's method, with those of tries that were divided
  std::vector<Index> substeps;    ///< into which a step was divided
};

/// Where something was largest.
struct LargestAtJoint {
  Real value = 0;                 ///< m
  Index joint = none;             ///< into BlockArrays::origins; none: two faces that met
  Index block[2] = {none, none};  ///< none: nothing slipped, or opened
};

/// Of a block's size, the cube root of its volume: a block displaced by more has moved.
inline constexpr Real share_that_is_motion = 0.01;
/// Whether a block of `volume` m³ has, displaced by `displacement` m.
inline bool has_moved(const Vec3& displacement, Real volume) {
  const Real way = std::hypot(displacement[0], displacement[1], displacement[2]);
  return way > share_that_is_motion * std::cbrt(volume);
}

/// What a block has done since t = 0, whatever `reset_displacement` counts from.
struct BlockCourse {
  Vec3 displacement{};  ///< m, at the end
  Vec3 rotation{};      ///< rad, at the end
  /// s, of the first step after which it had moved by share_that_is_motion of its size; NaN: none.
  Real began = std::numeric_limits<Real>::quiet_NaN();
  Vec3 first_displacement{};  ///< m, then
  Vec3 first_rotation{};      ///< rad, then
  Real first_pressing = 0;    ///< N, then, of blocks that it leaves behind
  std::uint8_t held = 0;      ///< 1: a [[fixed]] holds a point of it
};

/// What has become of the blocks.
struct Rest {
  Index moved = 0;  ///< displaced by more than share_that_is_motion
  LargestAtJoint slip, opening;
  Real speed = 0;             ///< m/s, of the fastest block
  std::vector<Index> moving;  ///< blocks that are not at rest, ascending
  Real since = std::numeric_limits<
      Real>::quiet_NaN();  ///< s, of the first step after which it stayed at rest; NaN: it is not
  bool at_rest =
      false;  ///< all blocks slower than a thousandth of √(g h), h the mean size: what falls by h/2 takes √(h/g)
};

/// Two kinds of faces that touched without a joint of the cut between them, and the law that they gave.
struct MetSurfaces {
  enum class By { own, pair, weaker, given, guess };
  Index between[2] = {none, none};  ///< SurfaceArrays::face_material; none: of no material
  Index material = none;            ///< into Model::joint_materials
  /// The material that both have or that one has, a [[contact_pair]], the weaker of two, [contact] material, or the first of several materials.
  By by = By::own;
};

/// What a quasi-static step leaves of the forces on blocks: what accelerates them.
struct Unbalanced {
  /// Sum of their magnitudes, over the weight of the rock or what supports carry, whichever is more.
  Real share = 0;
  Index block = none;  ///< on which the largest is
  Real force = 0;      ///< N, that one
};

/// More than a hundredth of the load: reactions and stresses are wrong by about as much.
inline bool is_far_from_balance(const Unbalanced& unbalanced) {
  return unbalanced.share > 0.01;
}

/// What contact has made out of nothing.
struct MadeEnergy {
  Real energy = 0;                ///< J, in all steps together
  Real turned_over = 0;           ///< J, by all that moves, stores and dissipates
  Index steps = 0;                ///< in which it made some
  Real largest = 0;               ///< J, that one pair made at once: …
  Index block[2] = {none, none};  ///< … these …
  Vec3 place{};                   ///< m, … here

  Real share() const { return turned_over > 0 ? energy / turned_over : 0; }
};

/// Water in the joints between blocks.
struct WaterInJoints {
  Real area = 0;              ///< m², of wet joints as they were cut, each counted once
  Real largest_pressure = 0;  ///< Pa, at the end
  Real force = 0;             ///< N, on one side of all joints together, at the end …
  Real whole_force = 0;       ///< N, … and what it would be on all of their area
};

/// A stage's steps that were taken by explicit substeps.
struct BySubsteps {
  Index stage = 0;
  Index first = 0;  ///< step, from 1
  Index steps = 0;
  std::int64_t substeps =
      0;  ///< as long as the slowest block allows; others are looked at 2, 4, 8 … times in one
  std::int64_t visits = 0;  ///< of contact points
  Real shortest = 0;        ///< s, of the fastest blocks' substeps
  Real added_mass = 0;      ///< of all mass, at most, to the fastest blocks
  /// What "auto" took them for (scheme_choice.hpp); 0 and 0: the model asked for them.
  Real iterated = 0, instead = 0;
  Index failed = 0;  ///< 1: an implicit step did not come to balance
};

/// A bolt at the end.
struct BoltResult {
  std::string name;  ///< of its [[bolt]], or of its [[bolt_pattern]] with its number: "pattern1.3"
  Vec3 collar{};     ///< m, before the motion
  Vec3 direction{};  ///< unit, into the rock
  Real length = 0;   ///< m
  bool installed = false;
  BoltStatus status = BoltStatus::elastic;
  Real force = 0, shear = 0;      ///< N, the largest along it and across it
  Real plate = 0;                 ///< N, of the rock on its plate
  Real peak = 0;                  ///< N, the largest along it after any step
  Real mobilisation = 0;          ///< of what the steel bears
  std::optional<Real> broken_at;  ///< s
  std::vector<Real> at, along;    ///< m from the collar, and N there
};

/// Shotcrete at the end, where it bridges joints.
struct ShotcreteResult {
  Real length = 0;                ///< m of joint
  Real yielding = 0, broken = 0;  ///< m of it
  Real force = 0;                 ///< N, the sum of what it bears, normal to the wall
  Real mobilisation = 0;          ///< the largest
};

struct RunResult {
  Index steps = 0;           ///< steps done
  Real time = 0;             ///< s reached
  bool interrupted = false;  ///< a signal stopped the run after the last step counted above
  std::vector<MonitorHistory> monitors;  ///< of those of Model::monitors without a joint
  std::vector<BaseMotion> base;  ///< at the monitors' times; empty unless the base is accelerated
  std::vector<BlockMotion> blocks;   ///< [B]
  std::vector<Stress> block_stress;  ///< [B] Pa, mean over each block's volume, at the end
  RockStrength strength;             ///< at the end
  std::vector<Vec3> reactions;       ///< [N] N, force of each fixed point on the rock, at the end
  std::vector<Reaction> conditions;  ///< the same by condition, in the order of Model::fixed
  Energy energy;                     ///< J, at the end
  std::vector<Real> energy_time;     ///< s, t = 0 and each step done
  std::vector<Energy> energies;      ///< J, likewise
  MadeEnergy made;                   ///< out of nothing
  ContactCount contacts;             ///< at the end
  ContactHistory contact_history;    ///< at the times of the energies; empty without contact
  std::optional<Rest> rest;          ///< with contact
  std::vector<MetSurfaces> met;      ///< likewise: in all steps
  std::optional<WaterInJoints> water;
  std::vector<BoltResult> bolts;  ///< that act on the rock, at the end
  std::optional<ShotcreteResult> shotcrete;
  std::optional<Unbalanced> unbalanced;  ///< of the last step, where that is quasi-static
  std::vector<BlockCourse> courses;      ///< [B] with contact
  std::vector<std::uint8_t> gone;        ///< [B] 1: excavated on the way; empty where nothing goes
  std::vector<Settled> settled;          ///< of the stages that rock settles in before they go on
  std::optional<Settled> settling;       ///< of the one in which a signal found it settling
  Real walls = 0;                        ///< share of the forces on walls that is left at the end
  std::vector<JointHistory>
      joint_monitors;  ///< in the order of those of Model::monitors that have a joint
  Real support_gap =
      0;  ///< distance of points held from their places / largest displacement, last step

  OffPlace off_place;  ///< the fixed point farthest off its place, at the end

  struct Iterations {
    std::int64_t pcg = 0;
    std::int64_t open_close = 0;  ///< Newton iterations of steps with contact
    std::int64_t fallbacks = 0;   ///< solves that a direct factorisation took over
  } iterations;
  Preconditioner preconditioner = Preconditioner::automatic;  ///< of the last solve

  struct Seconds {
    Real assemble = 0, solve = 0, output = 0;
    Real contact = 0;  ///< finding contact points
  } seconds;

  std::vector<BySubsteps> by_substeps;       ///< [stages with such steps], ascending
  LargestDisplacement largest_displacement;  ///< at the end
  Index largest_substeps = 1;           ///< the finest subdivision of a step, whatever asked for it
  Index divided_steps = 0;              ///< steps that did not converge until they were divided …
  std::vector<Index> divided_in_stage;  ///< [stages] … of each stage; empty: none
  Index most_parts = 1;                 ///< into how many at most
};

}  // namespace rockfold
