// What Motion keeps on the device.
#pragma once

#include "kernels/solve/held_kernel.hpp"
#include "kernels/update/motion.hpp"
#include "kernels/update/stress_kernel.hpp"

namespace rockfold {

struct TrackedPoints::Data {
  solve::DevicePoints points;
  device::Array<Index> element;
  device::Field local;  ///< m, from the centre of the element's lattice cell
  device::Field value;         ///< work space
  device::Array<Real> stress;  ///< [N][6] work space
};

namespace update {

/// Everything that a step changes.
struct MovingState {
  Field displacement, velocity, acceleration;  ///< of the covers
  Field multiplier, reaction;                  ///< of the fixed points
  Real time = 0;
  Real support_work = 0;  ///< J done by fixed points on the rock
  Index steps = 0;        ///< done since the motion was given
};
MovingState make_moving_state(Index covers, Index fixed);
void copy_state(const MovingState& from, MovingState& to);

}  // namespace update

struct Motion::Data {
  solve::HeldSystem held;
  solve::ElementTable elements;
  update::MovingState now, saved;
  device::Field load;       ///< F: gravity and point loads, N
  device::Field increment;  ///< Δd
  device::Field right;      ///< right-hand side
  device::Field work;
  device::Field goal;  ///< of the fixed points, for the unknown being solved for
  device::Array<Real> partial, sums;
  Vec3 gravity{};
  Real beta, gamma, dynamic_ratio;
  SolveOptions solver;
  Real step_length = 0;  ///< that the system is prepared for; 0 = for none
  Real largest_increment = 0;
  Real initial_energy = 0;  ///< J, kinetic + strain + potential of the motion given
};

namespace update {

/// F: gravity as M·g and point loads.
void make_load(Motion::Data& m, const MotionSetup& setup);
SolveReport solve_initial_acceleration(Motion::Data& m, Real dt);
SolveReport solve_equilibrium(Motion::Data& m);
/// One step of Newmark's method.
SolveReport advance(Motion::Data& m, Real dt);
/// Scales the velocity by the dynamic ratio; at 0 drops the acceleration as well.
void hand_on(Motion::Data& m);

}  // namespace update
}  // namespace rockfold
