// Solution of a constrained system: by the policy's preconditioner, residuals measured against the forces at the solution.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/operator/rock_motion_kernel.hpp"

namespace rockfold::solve {
namespace {

/// x += share · y. A function of its own, for nvcc allows no lambda in a private member.
void add(const char* label, const Field& x, Real share, const Field& y) {
  device::for_each(
      label, static_cast<Index>(x.extent(0)), KOKKOS_LAMBDA(const Index u) {
        for (int d = 0; d < 3; ++d) x(u, d) += share * y(u, d);
      });
}

/// left = prescribed − N x.
void find_left_to_go(const DevicePoints& points, const Field& prescribed, const Field& x,
                     const Field& left) {
  device::for_each(
      "rockfold::solve::left_to_go", points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          left(n, d) = prescribed(n, d) - interpolate_one(points, n, d, x);
      });
}

/// What rounding leaves of the forces if all unknowns are as large as rock moves. Those of covers with several functions may be
/// larger: then more than their share is in what moves no rock, of which nothing need be left unbalanced.
Real rounding_of_motion(ConstrainedSystem& system, const Field& x, const Field& base,
                        const ConstraintOptions& options) {
  const Real of_x = std::sqrt(dot(system.work, x, x)),
             of_base = std::sqrt(dot(system.work, base, base));
  const Field& larger = of_x > of_base ? x : base;
  const Real size = std::max(of_x, of_base);
  if (!(size > 0)) return 0;
  return options.rounding(larger) / size * largest_motion(system, x, base) *
         std::sqrt(static_cast<Real>(system.op.unknowns));
}

/// Solves of one system, each measured against the forces that the one before has found.
constexpr int most_solves = 32;
/// Of what is left, how much a solve leaves at least: by what ties points digits are lost.
constexpr Real within_reach = 1e-5;
/// Forces of springs whose points have yet to go, over those once they have gone, above which rounding of that way counts.
constexpr Real far_carried = 1e3;
/// Multiples of the rounding error that may be left: a smaller residual only moves x along the null space of A.
constexpr Real roundings = 16;
/// Share of the forces from which what rounding may leave unbalanced is looked at more closely.
constexpr Real most_rounding = 1e-4;

/// Brings points to their places and takes off the forces that they take; what is left is balanced by A + NᵀKN, again until it is little enough.
class ConstrainedSolve {
 public:
  ConstrainedSolve(ConstrainedSystem& system, const Field& b, const Field& prescribed,
                   const Field& x, const Field& base, const ConstraintOptions& options)
      : system_(system),
        b_(b),
        prescribed_(prescribed),
        x_(x),
        base_(base),
        options_(options),
        pcg_(options.pcg) {
    pcg_.measure_load = false;
  }

  SolveReport run() {
    if (!options_.go_on) Kokkos::deep_copy(system_.springs.multiplier, 0.0);
    Real gap = std::numeric_limits<Real>::infinity(), left_at_start = gap;
    bool closed = !system_.constraints.any_tied;
    for (int solves = 0; solves < most_solves; ++solves) {
      if (!closed) close_gaps(system_.constraints, prescribed_, x_);
      left_ = find_load();
      const Real left_before = std::exchange(left_at_start, left_);
      measure();
      if (is_balanced()) {
        // Springs are yet to be stretched by what their points have just been found to take.
        const Real gap_before = std::exchange(gap, gap_over_motion());
        if (closed || gap <= closed_gap || gap > 0.5 * gap_before) break;
        left_at_start = std::numeric_limits<Real>::infinity();
        continue;
      }
      if (left_ > 0.5 * left_before) {
        allow_rounding();
        break;
      }
      PcgOptions how = pcg_;
      if (system_.constraints.any_tied)
        how.tolerance = std::max(pcg_.tolerance, within_reach * report_.residual);
      how.max_iterations = pcg_.max_iterations - report_.iterations;
      const PcgReport done = solve_increment(how);
      const Real gap_before = std::exchange(gap, gap_over_motion());
      measure();
      const bool ended = small_enough(done, how);
      closed = closed || gap <= closed_gap || gap > 0.5 * gap_before;
      if (closed && (is_balanced() || (ended && done.residual > how.tolerance))) {
        report_.converged = true;
        break;
      }
    }
    place_exactly(system_.constraints, prescribed_, x_);
    report_.gap = gap_over_motion();
    return report_;
  }

 private:
  /// What acts beside the rock's own forces at x and the points': returns its norm.
  Real find_load() {
    const Field load = system_.load, q = system_.work.q;
    const Springs& springs = system_.springs;
    const DevicePoints& points = springs.points;
    const Field left = system_.left_to_go;
    apply_rock(system_, x_, q);
    apply_terms(system_.terms, x_, q, points.count);
    apply_terms(system_.contacts, x_, q);
    Kokkos::deep_copy(load, b_);
    add("rockfold::solve::left_to_carry", load, -1, q);
    find_left_to_go(points, prescribed_, x_, left);
    add_spring_load(springs, left, load);
    take_off_multipliers(system_.constraints, load);
    return std::sqrt(dot(system_.work, load, load));
  }

  PcgReport solve_increment(const PcgOptions& how) {
    const Field increment = system_.increment;
    Kokkos::deep_copy(increment, 0.0);
    const PcgReport done = solve_by_policy(system_, system_.load, increment, how, report_);
    report_.iterations += done.iterations;
    add("rockfold::solve::add_increment", x_, 1, increment);
    add_multipliers_of(system_.constraints, increment);
    left_ = done.residual * done.reference;
    return done;
  }

  bool is_balanced() { return report_.converged = report_.residual <= pcg_.tolerance; }

  /// Measures what is left against the forces there are.
  void measure() {
    forces_ =
        std::max({options_.pcg.reference, std::sqrt(dot(system_.work, b_, b_)), support_forces()});
    most_forces_ = std::max(most_forces_, forces_);
    pcg_.reference = forces_;
    if (options_.stop_at_rounding) raise_reference();
    report_.residual = pcg_.reference > 0 ? left_ / pcg_.reference : left_;
  }

  /// What is left beside what rounding may leave, where it gets no less.
  void allow_rounding() {
    if (options_.rounding && pcg_.tolerance > 0) {
      if (most_forces_ > far_carried * forces_ || report_.preconditioner == Preconditioner::direct)
        pcg_.rounding = options_.pcg.rounding + options_.rounding(x_);
      raise_reference();
      report_.residual = left_ / pcg_.reference;
    }
    is_balanced();
  }

  /// ‖Nᵀ f‖, f the forces of the points.
  Real support_forces() {
    const Springs& springs = system_.springs;
    const Field q = system_.work.q;
    spring_reactions(springs, x_, prescribed_, springs.force);
    Kokkos::deep_copy(q, 0.0);
    scatter(springs, 1, springs.force, q);
    return std::sqrt(dot(system_.work, q, q));
  }

  /// Such that the tolerance's share of it is not below rounding.
  void raise_reference() {
    Real floor = roundings * pcg_.rounding;
    if (floor > most_rounding * forces_)
      floor =
          std::min(floor, std::max(most_rounding * forces_,
                                   roundings * rounding_of_motion(system_, x_, base_, options_)));
    pcg_.reference = std::max(forces_, floor / pcg_.tolerance);
  }

  /// What points that depend on each other leave where they contradict each other, over the motion, or over what the forces would move the
  /// stiffest cover by: where they cancel nothing moves, and any gap would be large beside that. And what springs have to go by multipliers
  /// found since, over the motion, which may be theirs alone.
  Real gap_over_motion() {
    const Constraints& c = system_.constraints;
    if (!c.any_tied) return 0;
    const auto gap_of = [&](bool held) {
      return largest_gap(system_.springs, held, c.spring_factor, x_, prescribed_);
    };
    const Real held = gap_of(true), pulled = gap_of(false);
    if (!(held > 0) && !(pulled > 0)) return 0;
    const Real diagonal = system_.largest_diagonal,
               least = diagonal > 0 ? options_.pcg.reference / diagonal : 0,
               motion = std::max(largest_motion(system_, x_, base_), largest_entry(prescribed_));
    return std::max(held > 0 ? held / std::max(motion, least) : 0,
                    pulled > 0 ? pulled / motion : 0);
  }

  ConstrainedSystem& system_;
  const Field &b_, &prescribed_, &x_, &base_;
  const ConstraintOptions& options_;
  PcgOptions pcg_;
  SolveReport report_;
  Real left_ = 0;                      ///< N, unbalanced
  Real forces_ = 0, most_forces_ = 0;  ///< N, and the most that they have been
};

SolveReport solve_free(ConstrainedSystem& system, const Field& b, const Field& x,
                       const PcgOptions& pcg) {
  SolveReport report;
  const PcgReport done = solve_by_policy(system, b, x, pcg, report);
  report.iterations = done.iterations;
  report.residual = done.residual;
  report.converged = small_enough(done, pcg);
  return report;
}

}  // namespace

SolveReport solve_constrained(ConstrainedSystem& system, const Field& b, const Field& prescribed,
                              const Field& x, const Field& base, const ConstraintOptions& options) {
  if (!system.springs.any()) return solve_free(system, b, x, options.pcg);
  return ConstrainedSolve(system, b, prescribed, x, base, options).run();
}

}  // namespace rockfold::solve
