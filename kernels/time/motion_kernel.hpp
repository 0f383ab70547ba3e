// What Motion keeps on the device.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/contact/term_kernel.hpp"
#include "kernels/time/block_forces_kernel.hpp"
#include "kernels/time/bolts/bolts_kernel.hpp"
#include "kernels/time/explicit/scheme_kernel.hpp"
#include "kernels/time/forces/deformation_kernel.hpp"
#include "kernels/time/forces/following_kernel.hpp"
#include "kernels/time/forces/loads_kernel.hpp"
#include "kernels/time/motion.hpp"
#include "kernels/time/rebounds_kernel.hpp"

namespace rockfold {
namespace motion {

/// J since the motion was given; see Energy.
struct Work {
  Real supports = 0, loads = 0, damping = 0, quiet = 0, ratio = 0, friction = 0, impact = 0,
       excavated = 0, bolts = 0;
};

/// The numbers of a state.
struct StateNumbers {
  Real time = 0;  ///< s
  Real initial_energy =
      0;  ///< J, kinetic + strain + potential of the motion given, and what the initial stress stores in joints
  Real contact_energy = 0;  ///< J, stored in joints
  Real dynamic_ratio = 1;   ///< share of the velocity that steps hand on
  Real walls = 0;           ///< share of the forces on walls that acts
  Real substep_energy = 0;  ///< J, see kernels/time/explicit/substeps.cpp
  Work work;
  std::int64_t steps = 0;  ///< done since the stage began
  std::int64_t begins_with_factors =
      0;  ///< 1: a solve of the stage fell back on them, and its matrices are alike
};

/// Everything that a step changes. What is added here is copied, saved and restored by StateNumbers and fields(), and belongs into
/// RandomMotion of tests/time/state_test.cpp.
struct MovingState : StateNumbers {
  Field displacement, velocity, acceleration;  ///< of the covers
  Field reaction;                              ///< of the fixed points
  Field wall;  ///< N, what excavated rock pressed its walls with; empty where blocks do not touch

  std::array<Field, 5> fields() const {
    return {displacement, velocity, acceleration, reaction, wall};
  }
};
MovingState make_moving_state(Index unknowns, Index fixed, bool walls);
void copy_state(const MovingState& from, MovingState& to);

}  // namespace motion

struct Motion::Data {
  solve::ConstrainedSystem system;
  std::unique_ptr<motion::Deformation> rock;
  motion::VaryingLoads varying_loads;
  motion::FollowingPressures following;  ///< large kinematics
  motion::Dashpots dashpots;
  motion::MovingSupports supports;
  bolts::DeviceBolts bolts;  ///< large kinematics
  bolts::BoltState saved_bolts;
  Index first_link = 0;  ///< of bolts, among the terms of the system
  motion::MovingState now, saved;
  std::unique_ptr<contact::ContactTerm> contact;  ///< null: blocks do not touch each other
  motion::BlockForces of_blocks;                  ///< then
  motion::Rebounds rebounds;                      ///< then, where impacts give something back
  contact::Accepted saved_contacts;
  motion::PressedPoints saved_water;
  int most_iterations = 60;  ///< of Newton's method
  motion::ExplicitScheme explicit_scheme;

  device::Field load;            ///< gravity and constant loads, N
  device::Field varying;         ///< loads that change, at the time of `now` …
  device::Field varying_before;  ///< … and at the start of the step; empty where no load changes
  device::Field velocity_before, acceleration_before, stretch_before,
      following_before;        ///< at the start of the step; large kinematics
  device::Field bolts_before;  ///< N, of bolts on the rock, likewise
  device::Field increment;     ///< Δd of the step
  device::Field correction;    ///< of the prediction: what is solved for
  device::Field right;         ///< right-hand side
  device::Field held;          ///< the same, for a correction that holds some contacts
  device::Field work;
  device::Field left;         ///< of forces, once supports have taken theirs
  device::Field prescribed;   ///< of the fixed points, for the unknown being solved for
  device::Field support_way;  ///< of the fixed points in the step
  device::Array<Real> partial, sums;
  device::Array<std::uint8_t> gone;        ///< [unknowns] 1: of rock that has been excavated
  std::vector<std::uint8_t> gone_element;  ///< [elements] likewise; empty: none

  Real handed = 1;  ///< share of the velocity that the step now taken was handed
  Vec3 gravity{};
  Rayleigh damping;
  Real beta = 0.25, gamma = 0.5;
  SolveOptions solver;
  Index unknowns = 0, covers = 0, elements = 0;
  Real dashpot_factor = 0;  ///< of the dashpots in the matrix
  Real step_length = 0;     ///< that the system is prepared for; 0 = for none
  Real largest_increment = 0;
  Real energy_made = 0;    ///< see Motion::energy_made
  Real crossing = 0;       ///< see Motion::crossing
  EnergyGain gain;         ///< see Motion::largest_gain
  Real mean_over = 0;      ///< see Motion::mean_over
  Real initial_force = 0;  ///< N, norm of the forces of the initial stress in place
  double contact_seconds = 0;

  /// Average acceleration, which needs none to start with.
  bool average() const { return beta == 0.25 && gamma == 0.5; }
  bool damped() const { return damping.mass > 0 || damping.stiffness > 0 || dashpots.any(); }
};

namespace motion {

/// [unknowns] the functions that move everything by v.
std::vector<Vec3> uniform_field(Index unknowns, Index covers, const Vec3& v);

/// Chooses the matrix: `c` of stiffness and mass, and the factors of dashpots and springs.
void set_matrix(Motion::Data& m, const solve::Combination& c, Real dashpots, Real springs);
/// The loads that change and the targets of the supports, at t.
void set_time(Motion::Data& m, Real t);
/// k of supports.cpp.
std::array<Real, 3> stabilisation_gains(Real beta, Real gamma);
/// Finds how far points held go in the step that begins, of the middle rule or not: support_way.
void stabilise_supports(const Motion::Data& m, Real dt, bool middle);
/// N, of springs: what their stretch pulls with now, in `reaction`.
void find_pull_of_springs(const Motion::Data& m);
/// What is prescribed for the first acceleration: nothing at points held; others pull with what their springs are stretched by.
void prescribe_acceleration(const Motion::Data& m);
/// What is prescribed for the first velocity: at points held that of their tables, nothing without one; at others what they have.
void prescribe_velocity(const Motion::Data& m);
/// m/s²: of gravity, less the mean that the base has over the time dt up to now.
Vec3 free_fall(const Motion::Data& m, Real dt);
solve::ConstraintOptions solve_options(Motion::Data& m, Real reference);

/// Zeroes what belongs to rock that has been excavated.
void leave_out_gone(const Motion::Data& m, const Field& x);
/// See Motion::begin_stage.
void begin_stage(Motion::Data& m, Real dynamic_ratio);
SolveReport solve_initial_acceleration(Motion::Data& m, Real dt);
SolveReport solve_equilibrium(Motion::Data& m);
Real largest_frequency(Motion::Data& m);
/// One step of Newmark's method.
SolveReport take_step(Motion::Data& m, Real dt, const StepCourse& course);
/// One step in as many explicit substeps as it takes (explicit/explicit_kernel.hpp).
SolveReport take_explicit_step(Motion::Data& m, Real dt, const StepCourse& course);
/// See Motion::substep_visits.
Real count_substep_visits(Motion::Data& m, Real dt, Real mass_scaling);
/// Scales the velocity by the dynamic ratio, `handed`; at 0 drops the acceleration as well.
void hand_on(Motion::Data& m);

/// Reactions at the correction found (of twice the mean where `middle`), and the work of the supports: mean force times way.
void update_reactions(Motion::Data& m, bool middle);
/// Counts the work of changing loads and of damping over the increment.
void count_work(Motion::Data& m, Real dt);
/// Of what is left of the forces on walls, at the step's start and its end: excavated rock takes it along.
void count_wall_work(Motion::Data& m, Real before, Real after);
/// Of bolts, whose forces are those found last, over the step.
void count_bolt_work(Motion::Data& m);
/// Of pressures that follow their faces, over the step.
void count_following_work(Motion::Data& m);
/// Work of changing loads and of pressures that follow, put on at once where nothing has moved yet: `increment` is the way.
void count_loads_at_once(Motion::Data& m);
/// J, at the velocity of now.
Real kinetic_energy(const Motion::Data& m);
Real kinetic_energy(const Motion::Data& m, const Field& velocity);

}  // namespace motion
}  // namespace rockfold
