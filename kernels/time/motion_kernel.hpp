// What Motion keeps on the device.
#pragma once

#include <array>
#include <memory>

#include "kernels/constraints/held_kernel.hpp"
#include "kernels/time/deformation_kernel.hpp"
#include "kernels/time/following_kernel.hpp"
#include "kernels/time/loads_kernel.hpp"
#include "kernels/time/motion.hpp"

namespace rockfold {
namespace motion {

/// J since the motion was given; see Energy.
struct Work {
  Real supports = 0, loads = 0, damping = 0, quiet = 0, ratio = 0;
};

/// Everything that a step changes.
struct MovingState {
  Field displacement, velocity, acceleration;  ///< of the covers
  Field multiplier, reaction;                  ///< of the fixed points
  Real time = 0;
  Work work;
  solve::Anderson learned{solve::most_pairs};  ///< of the multipliers, learned in steps of …
  Real learned_in = 0;                         ///< … s; 0: of no length
  Index steps = 0;                             ///< done since the motion was given
  Real initial_energy = 0;  ///< J, kinetic + strain + potential of the motion given
};
MovingState make_moving_state(Index unknowns, Index fixed);
void copy_state(const MovingState& from, MovingState& to);

}  // namespace motion

struct Motion::Data {
  solve::HeldSystem held;
  std::unique_ptr<motion::Deformation> rock;
  motion::VaryingLoads varying_loads;
  motion::FollowingPressures following;  ///< large kinematics
  motion::Dashpots dashpots;
  motion::MovingSupports supports;
  motion::MovingState now, saved;

  device::Field load;            ///< gravity and constant loads, N
  device::Field varying;         ///< loads that change, at the time of `now` …
  device::Field varying_before;  ///< … and at the start of the step; empty where no load changes
  device::Field velocity_before, acceleration_before, goal_before,
      following_before;      ///< at the start of the step; large kinematics
  device::Field increment;   ///< Δd of the step
  device::Field correction;  ///< of the prediction: what is solved for
  device::Field right;       ///< right-hand side
  device::Field work;
  device::Field goal;         ///< of the fixed points, for the unknown being solved for
  device::Field support_way;  ///< of the fixed points in the step
  device::Array<Real> partial, sums;

  Real handed = 1;  ///< share of the velocity that the step now taken was handed
  Vec3 gravity{};
  Rayleigh damping;
  Real beta = 0.25, gamma = 0.5, dynamic_ratio = 1;
  SolveOptions solver;
  Index unknowns = 0, covers = 0, elements = 0;
  Real dashpot_factor = 0;  ///< of the dashpots in the matrix
  Real step_length = 0;     ///< that the system is prepared for; 0 = for none
  Real largest_increment = 0;
  Real initial_force = 0;  ///< N, norm of the forces of the initial stress in place

  bool damped() const { return damping.mass > 0 || damping.stiffness > 0 || dashpots.any(); }
};

namespace motion {

/// [unknowns] the functions that move everything by v.
std::vector<Vec3> uniform_field(Index unknowns, Index covers, const Vec3& v);

/// Chooses α, β of αK + βM, the factor of the dashpots, and that of the springs.
void set_matrix(Motion::Data& m, const solve::Combination& c, Real dashpots, Real springs,
                bool stiffen);
/// The loads that change and the targets of the supports, at t.
void set_time(Motion::Data& m, Real t);
/// k of supports.cpp.
std::array<Real, 3> steering(Real beta, Real gamma);
/// Finds how far augmented points go in the step that begins: support_way.
void steer(const Motion::Data& m, Real dt);
/// goal of the first acceleration: none at augmented points; others pull with what their springs are stretched by.
void aim_acceleration(const Motion::Data& m);
/// goal of the first velocity: at augmented points that of their tables, none without one; at others what they have.
void aim_velocity(const Motion::Data& m);
solve::HeldOptions solve_options(Motion::Data& m, Real reference);
/// Where there is no next step in which the multipliers could go on.
void close_gaps(solve::HeldOptions& how);

SolveReport solve_initial_acceleration(Motion::Data& m, Real dt);
SolveReport solve_equilibrium(Motion::Data& m);
Real largest_frequency(Motion::Data& m, Real dt);
/// One step of Newmark's method.
SolveReport take_step(Motion::Data& m, Real dt);
/// Takes out of velocity and acceleration what moves no rock, in the measure of the matrix, which is that of the step that begins.
bool idle_motion_is_due(const Motion::Data& m);
void leave_out_idle_motion(Motion::Data& m);
/// Scales the velocity by the dynamic ratio, `handed`; at 0 drops the acceleration as well.
void hand_on(Motion::Data& m);

/// Reactions at the correction found (of twice the mean where `middle`), and the work of the supports: mean force times way.
void update_reactions(Motion::Data& m, bool middle);
/// Counts the work of changing loads and of damping over the increment.
void count_work(Motion::Data& m, Real dt);
/// Of pressures that follow their faces, over the step.
void count_following_work(Motion::Data& m);
/// Work of changing loads and of pressures that follow, put on at once where nothing has moved yet: `increment` is the way.
void count_loads_at_once(Motion::Data& m);
Real kinetic_energy(const Motion::Data& m);

}  // namespace motion
}  // namespace rockfold
