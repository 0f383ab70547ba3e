// The motion of the rock: statics, and Newmark's method in time (thesis 4.4, Eq. 4-19 … 4-24).
//
// The thesis solves (K + 4M/Δt²) Δd = F + M (4v/Δt + a) with K d carried along in F. Here the whole residual of the predicted
// motion stands on the right in every step,
//   (M/(βΔt²) + γ/(βΔt) C + K) x = F − M a' − C v' − f(d'),  d' = d + Δt v + Δt²/2 a,  v' = v + Δt a,  a' = a,
// so that no error of one step's solution drifts into the next; x corrects d' (step.cpp). With β = 1/4, γ = 1/2 this is the
// thesis' scheme (average acceleration). The first acceleration follows from M a = F − C v − f(d): with a = 0 instead, free
// fall would lose gΔt/2 of speed. C = αM + βK (Rayleigh) and the dashpots of quiet boundaries.
//
// Where the base is accelerated (a record of an earthquake) the motion is relative to it: every point is loaded by −ρ a_base.
// Displacements, velocities, damping and kinetic energy are then those that an observer on the base sees.
//
// Under large kinematics the internal force is that of finite strain, and every step is solved by Newton's method
// (step_kernel.hpp); average acceleration then keeps momentum, angular momentum and energy (Simo & Tarnow 1992).
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
#include "kernels/time/tracked_points.hpp"
#include "src/arrays/load_arrays.hpp"

namespace rockfold {

/// C = mass · M + stiffness · K.
struct Rayleigh {
  Real mass = 0;       ///< 1/s
  Real stiffness = 0;  ///< s
};

struct MotionSetup {
  const CoverArrays& covers;
  const PieceMoments& moments;
  const std::vector<ElasticMaterial>& materials;
  const FixedPoints& fixed;
  Vec3 gravity{};  ///< m/s²
  LoadPoints loads{};
  QuietPoints quiet{};
  InitialStress initial_stress{};
  TimeTable base_acceleration{};  ///< m/s²; empty: the base is at rest
  Rayleigh damping{};
  bool large = false;             ///< finite strain and rotation; otherwise small
  Real beta = 0.25, gamma = 0.5;  ///< Newmark's; β > 0
  Real dynamic_ratio = 1;
  SolveOptions solver{};
  Preconditioner preconditioner = Preconditioner::automatic;
  MakeDirectSolver direct{};  ///< empty: conjugate gradients do without factors
};

class Motion {
 public:
  explicit Motion(const MotionSetup& setup);
  ~Motion();
  Motion(Motion&&) noexcept;
  Motion& operator=(Motion&&) noexcept;

  /// Replaces displacement and velocity (at rest in place to start with); before start().
  void set_motion(const StateArrays& state);

  /// The displacement in equilibrium with the loads; the time becomes 1, and tables are read there.
  SolveReport solve_static();

  /// The acceleration at t = 0. Fixed points are held against accelerating as steps of length dt will hold them.
  SolveReport start(Real dt);
  /// Hands the velocity on, then takes `substeps` steps of length dt / substeps. Stops at the first that does not converge, and,
  /// where `watched` is given, at the first that moves one of its points by more than `limit` m: largest_increment().
  SolveReport step(Real dt, int substeps = 1, const TrackedPoints* watched = nullptr,
                   Real limit = 0);
  Real largest_increment() const;

  /// rad/s: the largest natural frequency of the rock on its supports as it is now, within about a percent, from below. `dt`: s, as
  /// given to start(). Schemes with β < γ/2 are stable up to dt = 1 / (frequency √(γ/2 − β)) (Hughes 1987, §9.1.2), for γ ≥ 1/2.
  Real largest_frequency(Real dt);

  /// Remembers the present state, and goes back to it.
  void save();
  void restore();
  /// The same as bytes of this machine, for another Motion of the same setup, in another process too: steps from there are the same,
  /// digit for digit. Throws std::invalid_argument where they are not those of such a motion.
  std::vector<std::byte> bytes() const;
  void restore(std::span<const std::byte> bytes);

  Real time() const;
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

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace rockfold
