// Solution of a constrained system: by the policy's preconditioner, residuals measured against the forces at the solution, and with
// multipliers (Uzawa's iteration, accelerated) at augmented points.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/operator/rock_motion_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

/// Reduction of the residual by an inner solve. A larger one leaves smooth errors, which mislead the acceleration; a smaller one computes
/// digits that the next multipliers change.
constexpr Real inner_reduction = 1e-3;

/// λ from λ and springs.force, the change it would take by itself.
void update_multipliers(ConstrainedSystem& system, Anderson& acceleration) {
  const Springs& springs = system.springs;
  const Real factor = system.spring_factor;
  scale_by_stiffness(springs, factor, -0.5, springs.multiplier);
  const auto flat = [](const Field& field) {
    std::vector<Real> values;
    for (const Vec3& v : device::copy_to_host(field))
      values.insert(values.end(), v.begin(), v.end());
    return values;
  };
  const std::vector<Real> next = acceleration.next(flat(springs.multiplier), flat(springs.force));
  std::vector<Vec3> values(next.size() / 3);
  for (std::size_t i = 0; i < next.size(); ++i) values[i / 3][i % 3] = next[i];
  device::copy_to_device(values, springs.multiplier);
  scale_by_stiffness(springs, factor, 0.5, springs.multiplier);
}

/// x += share · y. A function of its own, for nvcc allows no lambda in a private member.
void add(const char* label, const Field& x, Real share, const Field& y) {
  device::for_each(
      label, static_cast<Index>(x.extent(0)), KOKKOS_LAMBDA(const Index u) {
        for (int d = 0; d < 3; ++d) x(u, d) += share * y(u, d);
      });
}

/// Correction of x: A δ = b + Nᵀ(k prescribed − λ) − A x, where the springs' part is k (prescribed − N x), not the difference of two large
/// forces. A correction that raises the residual is dropped: it is rounding.
PcgReport solve_increment(ConstrainedSystem& system, const Field& b, const Field& prescribed,
                          const Field& x, const PcgOptions& pcg, SolveReport& report) {
  const Field increment = device::make_field("solve::increment", system.op.unknowns);
  const Field left = device::make_field("solve::left_to_go", system.springs.points.count);
  const Field load = system.load;
  const Field of_rock = system.work.q;
  const auto points = system.springs.points;
  apply_rock(system, x, of_rock);
  apply_terms(system.terms, x, of_rock, points.count);
  apply_terms(system.contacts, x, of_rock);
  device::for_each(
      "rockfold::solve::left_to_carry", system.op.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) load(p, d) = b(p, d) - of_rock(p, d);
      });
  device::for_each(
      "rockfold::solve::left_to_go", points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          left(n, d) = prescribed(n, d) - interpolate_one(points, n, d, x);
      });
  add_spring_load(system.springs, system.spring_factor, left, load);
  project(system.eliminated, load);
  const Real before = std::sqrt(dot(system.work, load, load));
  PcgReport done = solve_by_policy(system, load, increment, pcg, report);
  const Real after = done.residual * done.reference;
  if (!(after < before)) {
    done.residual = before / done.reference;
    return done;
  }
  add("rockfold::solve::add_increment", x, 1, increment);
  return done;
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

/// What rounding leaves of the springs' forces at x: stiff ones hold points that hardly move by functions that cancel there.
Real rounding_of_springs(const ConstrainedSystem& system, const Field& x) {
  constexpr Real unit = 0.5 * std::numeric_limits<Real>::epsilon();
  const Springs s = system.springs;
  const Real factor = unit * system.spring_factor;
  device::for_each(
      "rockfold::solve::spring_rounding", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) {
          Real sum = 0;
          for (Index i = s.points.begin(n); i < s.points.begin(n + 1); ++i)
            sum += device::math::fabs(s.points.weight(i) * x(s.points.unknown(i), d));
          s.force(n, d) = factor * s.stiffness(n, d) * sum;
        }
      });
  Kokkos::deep_copy(system.work.q, 0.0);
  scatter(s, 1, s.force, system.work.q);
  return std::sqrt(dot(system.work, system.work.q, system.work.q));
}

/// ‖Nᵀ f‖, f the forces of the springs at x.
Real spring_forces(const ConstrainedSystem& system, const Field& prescribed, const Field& x) {
  const Springs& springs = system.springs;
  spring_reactions(springs, system.spring_factor, x, prescribed, springs.force);
  Kokkos::deep_copy(system.work.q, 0.0);
  scatter(springs, 1, springs.force, system.work.q);
  return std::sqrt(dot(system.work, system.work.q, system.work.q));
}

/// Solves of one system, each measured against the forces that the one before has found.
constexpr int most_measures = 8;
/// Load of the springs over the forces found, above which corrections are solved for: rounding of that load would swamp the whole.
constexpr Real far_carried = 1e3;
/// Multiples of the rounding error that may be left: a smaller residual only moves x along the null space of A.
constexpr Real roundings = 16;
/// Share of the forces from which what rounding may leave unbalanced is looked at more closely.
constexpr Real most_rounding = 1e-4;

/// A search for multipliers has diverged where its gap is this many times the least that it had.
constexpr Real far_off = 10;

bool any_multipliers(const Springs& springs) {
  return springs.any() && largest_entry(springs.by_multiplier) > 0;
}

/// The springs' part of a solve, whose multipliers are as they are.
class PenaltySolve {
 public:
  PenaltySolve(ConstrainedSystem& system, const Field& b, const Field& prescribed, const Field& x,
               const Field& base, const ConstraintOptions& options)
      : system_(system),
        b_(b),
        prescribed_(prescribed),
        x_(x),
        base_(base),
        options_(options),
        pcg_(options.pcg) {
    by_forces_ = options.rounding && system.springs.any() && pcg_.tolerance > 0;
    if (by_forces_ && options.stop_at_rounding) pcg_.reference = reference_for(pcg_.reference);
  }

  /// To `reduction` of the residual; 0: to the tolerance.
  void solve(Real reduction) {
    solve_once(reduction);
    if (!by_forces_) return;
    for (int i = 0; report.converged && !measure() && reduction == 0 && i < most_measures; ++i)
      solve_once(0);
  }

  bool done() const { return report.residual <= pcg_.tolerance; }

  SolveReport report;

 private:
  void solve_once(Real reduction) {
    pcg_.reduction = reduction;
    PcgReport done = carried_ ? solve_increment(system_, b_, prescribed_, x_, pcg_, report)
                     : system_.springs.any() ? solve_with_springs()
                                             : solve_by_policy(system_, b_, x_, pcg_, report);
    if (system_.eliminated.any()) find_reactions();
    pcg_.reference = done.reference;  // one measure for all solves
    report.iterations += done.iterations;
    report.residual = done.residual;
    report.converged = small_enough(done, pcg_);
    if (reduction == 0 && done.converged && done.residual > pcg_.tolerance) {  // rounding is left
      pcg_.reference *= done.residual / pcg_.tolerance;
      report.residual = pcg_.tolerance;
    }
  }

  /// What is prescribed goes to the right-hand side.
  PcgReport solve_with_springs() {
    const Elimination& e = system_.eliminated;
    const Field load = system_.load, part = system_.prescribed_part, q = system_.work.q, x = x_;
    Kokkos::deep_copy(load, b_);
    add_spring_load(system_.springs, system_.spring_factor, prescribed_, load);
    if (by_forces_) load_ = std::sqrt(dot(system_.work, load, load));
    if (!e.any()) return solve_by_policy(system_, load, x, pcg_, report);
    split(e, prescribed_, x, part);
    apply_matrix(system_, part, q);
    add("rockfold::solve::prescribed_load", load, -1, q);
    project(e, load);
    const PcgReport done = solve_by_policy(system_, load, x, pcg_, report);
    add("rockfold::solve::add_prescribed", x, 1, part);
    return done;
  }

  /// The multipliers of eliminated points, from what they leave unbalanced.
  void find_reactions() {
    const Field load = system_.load, q = system_.work.q;
    Kokkos::deep_copy(load, b_);
    add_spring_load(system_.springs, system_.spring_factor, prescribed_, load);
    apply_matrix(system_, x_, q);
    add("rockfold::solve::left_unbalanced", load, -1, q);
    add_reactions(system_.eliminated, load, system_.springs.multiplier);
  }

  /// Measures what is left against the forces found; false: it would have to be less.
  bool measure() {
    const Real left = report.residual * pcg_.reference;
    const Real forces = std::max({options_.pcg.reference, std::sqrt(dot(system_.work, b_, b_)),
                                  spring_forces(system_, prescribed_, x_)});
    carried_ = carried_ || load_ > far_carried * forces;
    pcg_.rounding = options_.pcg.rounding;
    if (carried_ || report.preconditioner == Preconditioner::direct)
      pcg_.rounding += options_.rounding(x_) + rounding_of_springs(system_, x_);
    pcg_.reference = reference_for(forces);
    pcg_.measure_load = false;
    if (pcg_.reference > 0) report.residual = left / pcg_.reference;
    return done();
  }

  /// What residuals are measured against, such that the tolerance's share of it is not below rounding.
  Real reference_for(Real forces) {
    Real floor = roundings * pcg_.rounding;
    if (floor > most_rounding * forces)
      floor =
          std::min(floor, std::max(most_rounding * forces,
                                   roundings * rounding_of_motion(system_, x_, base_, options_)));
    return std::max(forces, floor / pcg_.tolerance);
  }

  ConstrainedSystem& system_;
  const Field &b_, &prescribed_, &x_, &base_;
  const ConstraintOptions& options_;
  PcgOptions pcg_;
  bool by_forces_ = false;  ///< residuals count against the forces found
  bool carried_ = false;    ///< supports carry rock far: increments are solved for
  Real load_ = 0;           ///< norm, with the springs' part
};

/// Finds the multipliers that bring augmented points to their places, from those there are.
class MultiplierSearch {
 public:
  MultiplierSearch(ConstrainedSystem& system, const Field& prescribed, const Field& x,
                   const Field& base, const ConstraintOptions& options, PenaltySolve& inner)
      : system_(system),
        prescribed_(prescribed),
        x_(x),
        base_(base),
        options_(options),
        inner_(inner),
        acceleration_(options.acceleration ? *options.acceleration : own_) {}

  void run() {
    SolveReport& report = inner_.report;
    acceleration_.begin_again();
    while (report.converged) {
      const Real gap = measure_gap();
      judge(gap);
      const bool close = report.gap <= options_.gap_tolerance;
      if (close && inner_.done()) return;
      if (!close && (report.outer >= options_.max_outer || stalled_ >= options_.max_stalled))
        return leave(gap);
      ++report.outer;
      if (exact_) acceleration_.forget();
      if (!close) update_multipliers(system_, acceleration_);
      inner_.solve(close || exact_ ? 0 : inner_reduction);
    }
  }

 private:
  /// m; the report has its share of the motion.
  Real measure_gap() {
    // What the forces would move the stiffest cover by: where they cancel nothing moves, and any gap would be large beside that.
    const Real diagonal = system_.largest_diagonal,
               least = diagonal > 0 ? options_.pcg.reference / diagonal : 0;
    const Real gap = multiplier_change(system_.springs, system_.spring_factor, x_, prescribed_,
                                       system_.springs.force);
    inner_.report.gap = gap > 0 ? gap / std::max({largest_motion(system_, x_, base_),
                                                  largest_entry(prescribed_), least})
                                : 0;
    return gap;
  }

  /// Watches the convergence of the gap and chooses how to continue.
  void judge(Real gap) {
    if (gap < least_) {
      least_ = gap;
      Kokkos::deep_copy(system_.best_multiplier, system_.springs.multiplier);
    }
    stalled_ = gap < 0.5 * best_ ? 0 : stalled_ + 1;
    if (stalled_ == 0) best_ = gap;
    // Every inner solve is inexact, and old pairs of the acceleration carry its errors: begin a new history.
    if (stalled_ == 2 && !restarted_) {
      acceleration_.forget();
      restarted_ = true;
      stalled_ = 0;
      best_ = gap;
    }
    // Near the end the errors of inner solves are as large as the changes: plain Uzawa steps with exact solves.
    if (stalled_ >= options_.max_stalled && options_.finish_unaccelerated && !exact_) {
      exact_ = true;
      stalled_ = 0;
      best_ = gap;
    }
  }

  /// Supports that contradict each other have no multipliers, and the search diverges: go back to the best ones.
  void leave(Real gap) {
    const bool astray = gap > far_off * least_;
    if (astray) {
      Kokkos::deep_copy(system_.springs.multiplier, system_.best_multiplier);
      Kokkos::deep_copy(x_, 0.0);
    }
    if (astray || !inner_.done()) inner_.solve(0);
    if (astray) measure_gap();
  }

  ConstrainedSystem& system_;
  const Field &prescribed_, &x_, &base_;
  const ConstraintOptions& options_;
  PenaltySolve& inner_;
  Anderson own_{most_pairs};
  Anderson& acceleration_;
  int stalled_ = 0;  ///< updates since the gap was last halved
  bool restarted_ = false;
  bool exact_ = false;  ///< each solve goes to the tolerance, each update by itself
  Real best_ = std::numeric_limits<Real>::infinity(), least_ = best_;  ///< m
};

}  // namespace

SolveReport find_same_motion(ConstrainedSystem& system, const Field& x, const Field& y,
                             const PcgOptions& pcg, Real enough) {
  const Field load = device::make_field("solve::load_of_motion", system.op.unknowns);
  apply_matrix(system, x, load);
  SolveReport report;
  const PcgReport done = solve_if_easy(system, load, y, pcg, report.preconditioner);
  report.iterations = done.iterations;
  report.residual = done.residual;
  const bool direct = report.preconditioner == Preconditioner::direct;
  report.converged = done.iterations > 0 && done.residual <= (direct ? enough : pcg.tolerance);
  return report;
}

SolveReport solve_constrained(ConstrainedSystem& system, const Field& b, const Field& prescribed,
                              const Field& x, const Field& base, const ConstraintOptions& options) {
  PenaltySolve solve(system, b, prescribed, x, base, options);
  const bool by_multipliers = any_multipliers(system.springs);
  solve.solve(by_multipliers ? inner_reduction : 0);
  if (by_multipliers && solve.report.converged)
    MultiplierSearch(system, prescribed, x, base, options, solve).run();
  return solve.report;
}

}  // namespace rockfold::solve
