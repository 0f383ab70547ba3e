// The motion of the rock: statics, and Newmark's method in time (thesis 4.4, Eq. 4-19 … 4-24).
//
// The thesis solves (K + 4M/Δt²) Δd = F + M (4v/Δt + a) with K d carried along in F. Here the whole residual of the predicted
// motion stands on the right in every step,
//   (M/(βΔt²) + γ/(βΔt) C + K) x = F − M a' − C v' − f(d'),  d', v', a' those of predict.cpp,
// so that no error of one step's solution drifts into the next; x corrects d' (step.cpp). With β = 1/4, γ = 1/2 this is the
// thesis' scheme (average acceleration). Of other schemes the first acceleration follows from the balance with the matrix of the steps
// (start.cpp). C = αM + βK (Rayleigh) and the dashpots of quiet boundaries.
//
// Where the base is accelerated (a record of an earthquake) the motion is relative to it: every point is loaded by −ρ a_base.
// Displacements, velocities, damping and kinetic energy are then those that an observer on the base sees.
//
// Average acceleration takes the forces of both ends, M (v' − v)/Δt = ½ (F + F' − …), which is the same motion and needs no first
// acceleration (step_kernel.hpp).
//
// Under large kinematics the internal force is that of finite strain, and every step is solved by Newton's method; average acceleration then
// keeps momentum, angular momentum and energy (Simo & Tarnow 1992).
//
// Velocity handed to the next step: `dynamic_ratio` times what the step ended with. At 0 the acceleration is dropped too
// (quasi-static): (K + 4M/Δt²) Δd = F − K d makes the error of a mode of frequency ω shrink by 4/(4 + ω²Δt²) a step, always
// towards the static answer. With the acceleration kept the factor would be (4 − ω²Δt²)/(4 + ω²Δt²): long steps would swing
// about the answer for ever.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "kernels/constraints/cover_system.hpp"
#include "kernels/contact/contact.hpp"
#include "kernels/time/tracked_points.hpp"
#include "src/arrays/bolt_arrays.hpp"
#include "src/arrays/load_arrays.hpp"

namespace rockfold {

/// C = mass · M + stiffness · K.
struct Rayleigh {
  Real mass = 0;       ///< 1/s
  Real stiffness = 0;  ///< s
};

/// How a step goes on, beside its length.
struct StepCourse {
  /// Loads, supports and the base stay where they are: the step only brings forces into balance.
  bool time_stands = false;
  /// By explicit substeps, as many as it takes to be stable (kernels/time/explicit).
  bool by_substeps = false;
  /// > 0: substeps relax to rest, until no block's forces are further out of balance than this share of those that act on it.
  Real tolerance_of_balance = 0;
  /// Of all mass, what may be added to the blocks with the shortest substeps, with its weight.
  Real mass_scaling = 0;
  /// Share of what excavated rock pressed its walls with that is left at the step's end.
  Real walls = 0;

  bool relaxes() const { return tolerance_of_balance > 0; }
};

struct MotionSetup {
  const CoverArrays& covers;
  const PieceMoments& moments;
  const std::vector<ElasticMaterial>& materials;
  const FixedPoints& fixed;
  Vec3 gravity{};  ///< m/s²
  LoadPoints loads{};
  QuietPoints quiet{};
  const LoadPoints* water =
      nullptr;  ///< in joints as it is at first; null: there never is any. Large kinematics alone
  Index water_sides = 0;  ///< of joints, that LoadPoints::side numbers
  InitialStress initial_stress{};
  TimeTable base_acceleration{};  ///< m/s²; empty: the base is at rest
  Rayleigh damping{};
  bool large = false;             ///< finite strain and rotation; otherwise small
  Real beta = 0.25, gamma = 0.5;  ///< Newmark's; β > 0
  Real dynamic_ratio = 1;
  SolveOptions solver{};
  Preconditioner preconditioner = Preconditioner::automatic;
  MakeDirectSolver direct{};  ///< empty: conjugate gradients do without factors
  /// Where blocks touch each other: large kinematics, no statics, and in dynamics average acceleration. Null: they do not.
  const SurfaceArrays* surfaces = nullptr;
  MaterialPoints surface_points{};    ///< [V] the vertices of the surfaces
  const BoltArrays* bolts = nullptr;  ///< large kinematics; null: none
  ContactOptions contact{};
  int contact_iterations = 40;  ///< of Newton's method in a step
};

class Motion {
 public:
  explicit Motion(const MotionSetup& setup);
  ~Motion();
  Motion(Motion&&) noexcept;
  Motion& operator=(Motion&&) noexcept;

  /// Replaces displacement and velocity (at rest in place to start with); before start().
  void set_motion(const StateArrays& state);

  /// The displacement in equilibrium with the loads, one second on, where tables are read.
  SolveReport solve_static();

  /// Another analysis goes on from here, with that `dynamic_ratio`. What moves only in the measure of a step that hands no velocity on comes to
  /// rest: before such steps, and after them. A moving one goes on by start().
  void begin_stage(Real dynamic_ratio);

  /// Rock is gone from here on, with its contacts and supports: its covers stay in place and unstrained, and nothing acts on them.
  /// What it pressed its walls with goes on to act there: steps say what is left of it. `gone` holds all rock that is. Only where blocks touch
  /// each other. Call start() before the next step.
  void excavate(const GoneRock& gone);
  /// What is left of the forces on walls becomes the whole that steps take their share of.
  void begin_release();
  /// Share of them that is left, 0 … 1.
  Real walls() const;
  void set_walls(Real left);
  /// The same for a state restored from bytes, in which it has been done.
  void leave_out(const GoneRock& gone);

  /// The water that is in joints at the end of the next step, which begins with that of the step before.
  void set_water(const CoverArrays& covers, const LoadPoints& water);
  /// Likewise, from now on: of a state restored from bytes.
  void set_water_now(const CoverArrays& covers, const LoadPoints& water);
  /// [sides of joints] Share of the water's pressure that acts.
  void set_water_shares(const std::vector<Real>& share);

  /// Bolts with this stage act from here on.
  void install_bolts(Index stage);

  /// The velocity that goes with the points held, and, for schemes that need one, the acceleration at t = 0: fixed points are held against
  /// accelerating as steps of length dt will hold them.
  SolveReport start(Real dt);
  /// A step of length dt, or a part of one; the first hands the velocity on (without a velocity to hand on all parts are steps of their own).
  SolveReport step(Real dt, bool first = true, const TrackedPoints* watched = nullptr,
                   const StepCourse& course = {});
  /// m: how far the last step has moved one of the points watched.
  Real largest_increment() const;
  /// Of kinetic energy and that stored in joints: what the last step has made out of nothing, by the rule that blocks which overlap far
  /// and turn change the planes and areas on which they touch, or rebounds by when they were. In proportion to its length.
  Real energy_made() const;
  /// How deep the last step has taken two blocks into each other, over half the width of the thinner: beyond 1 they may pass each other.
  Real crossing() const;
  /// Where in the last step contact has made most of what it made out of nothing; energy 0: it lost on the whole.
  const EnergyGain& largest_gain() const;

  /// Visits of contact points that a second of explicit steps of length dt would take, as the rock is now. Forgets what was saved.
  Real substep_visits(Real dt, Real mass_scaling);

  /// rad/s: the largest natural frequency of the rock on its supports as it is now, within about a percent, from below.
  /// Schemes with β < γ/2 are stable up to dt = 1 / (frequency √(γ/2 − β)) (Hughes 1987, §9.1.2), for γ ≥ 1/2.
  Real largest_frequency();

  /// Remembers the present state, and goes back to it.
  void save();
  void restore();
  /// The same as bytes of this machine, for another Motion of the same setup, in another process too: steps from there are the same,
  /// digit for digit. Throws std::invalid_argument where they are not those of such a motion.
  std::vector<std::byte> bytes() const;
  void restore(std::span<const std::byte> bytes);

  Real time() const;
  /// s before time(), over which the acceleration is the mean: that of average acceleration. 0: it is that of the moment.
  Real mean_over() const;
  StateArrays state() const;
  PointMotion at(const TrackedPoints& points) const;
  /// [6R + E] in the element numbering of CoverArrays.
  std::vector<std::array<Real, 6>> element_stress() const;
  /// [N] Pa at points `local` m from the centres of the elements' lattice cells.
  std::vector<std::array<Real, 6>> stress_at(const std::vector<Index>& element,
                                             const std::vector<Vec3>& local) const;
  /// [fixed points] N, on the rock.
  std::vector<Vec3> reactions() const;
  Energy energy() const;
  /// As they are after the last step; none where blocks do not touch each other.
  std::vector<ContactPoint> contact_points() const;
  ContactCount contact_count() const;
  /// As they are now.
  BoltForces bolt_forces() const;
  /// As ContactOptions::law_of_pair: 1: such faces, which no joint joined, have touched so far.
  std::vector<std::uint8_t> surfaces_that_met() const;
  /// s, spent in finding contact points so far.
  double contact_seconds() const;
  /// Where the forces of the last iteration are least in balance.
  Index most_unbalanced_cover() const;

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace rockfold
