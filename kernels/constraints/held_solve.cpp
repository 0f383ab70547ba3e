// How held systems are solved: by whatever ways it takes, measured against the forces found, and with multipliers for augmented points.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "kernels/constraints/held_kernel.hpp"
#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/operator/rock_motion_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

/// Share of its residual that an inner solve leaves. Larger, and smooth errors that hardly show in the residual come back in
/// later gaps and mislead the acceleration; smaller, and digits are bought that the next multipliers change.
constexpr Real inner_reduction = 1e-3;

/// λ from λ and springs.force, the change it would take by itself.
void update_multipliers(HeldSystem& system, Anderson& acceleration) {
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

/// Adds the springs' part to a load for as long as it lives; then the load is what it was, digit for digit. The few rows that springs
/// act on are kept meanwhile, not the whole load.
class LoadWithSprings {
 public:
  LoadWithSprings(const HeldSystem& system, const Field& goal, const Field& load)
      : row_(system.springs.row), before_(system.load_before), load_(load) {
    copy(load_, before_, true);
    add_spring_load(system.springs, system.spring_factor, goal, load_);
  }
  ~LoadWithSprings() { copy(load_, before_, false); }
  LoadWithSprings(const LoadWithSprings&) = delete;
  LoadWithSprings& operator=(const LoadWithSprings&) = delete;

  void copy(const Field& load, const Field& kept, bool keep) const {
    const auto row = row_;
    device::for_each(
        "rockfold::solve::keep_load", static_cast<Index>(row.extent(0)),
        KOKKOS_LAMBDA(const Index t) {
          for (int d = 0; d < 3; ++d)
            if (keep)
              kept(t, d) = load(row(t), d);
            else
              load(row(t), d) = kept(t, d);
        });
  }

 private:
  Array<Index> row_;
  Field before_, load_;
};

/// y = (αK + βM) x, or what stands in its place.
void apply_rock(const HeldSystem& system, const Field& x, const Field& y) {
  if (system.other.apply)
    system.other.apply(x, y);
  else
    apply(system.op, system.combination, x, y);
}

/// Adds to x what it lacks: A δ = b + Nᵀ(k goal − λ) − A x, where the springs' part is k (goal − N x), not the difference of two large
/// forces. An increment that makes it worse is left: rounding alone in what A hardly resists.
PcgReport solve_increment(HeldSystem& system, const Apply& rock, const Apply& a, const Field& b,
                          const Field& goal, const Field& x, const PcgOptions& pcg,
                          SolveReport& report) {
  const Field increment = device::make_field("solve::increment", system.op.unknowns);
  const Field left = device::make_field("solve::left_to_go", system.springs.points.count);
  const Field load = device::make_field("solve::left_to_carry", system.op.unknowns);
  const Field of_rock = system.work.q;
  const auto points = system.springs.points;
  rock(x, of_rock);
  device::for_each(
      "rockfold::solve::left_to_carry", system.op.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) load(p, d) = b(p, d) - of_rock(p, d);
      });
  device::for_each(
      "rockfold::solve::left_to_go", points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) left(n, d) = goal(n, d) - interpolate_one(points, n, d, x);
      });
  add_spring_load(system.springs, system.spring_factor, left, load);
  const Real before = std::sqrt(dot(system.work, load, load));
  PcgReport done = solve_by_policy(system, a, load, increment, pcg, report);
  const Real after = done.residual * done.reference;
  if (!(after < before)) {
    done.residual = before / done.reference;
    return done;
  }
  device::for_each(
      "rockfold::solve::add_increment", system.op.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) x(p, d) += increment(p, d);
      });
  return done;
}

/// What rounding leaves of the forces if all unknowns are as large as rock moves. Those of covers with several functions may be
/// larger: then more than their share is in what moves no rock, of which nothing need be left unbalanced.
Real rounding_of_motion(HeldSystem& system, const Field& x, const Field& base,
                        const HeldOptions& options) {
  const Real of_x = std::sqrt(dot(system.work, x, x)),
             of_base = std::sqrt(dot(system.work, base, base));
  const Field& larger = of_x > of_base ? x : base;
  const Real size = std::max(of_x, of_base);
  if (!(size > 0)) return 0;
  return options.rounding(larger) / size * largest_motion(system, x, base) *
         std::sqrt(static_cast<Real>(system.op.unknowns));
}

/// What rounding leaves of the springs' forces at x: stiff ones hold points that hardly move by functions that cancel there.
Real rounding_of_springs(const HeldSystem& system, const Field& x) {
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
Real spring_forces(const HeldSystem& system, const Field& goal, const Field& x) {
  const Springs& springs = system.springs;
  spring_reactions(springs, system.spring_factor, x, goal, springs.force);
  Kokkos::deep_copy(system.work.q, 0.0);
  scatter(springs, 1, springs.force, system.work.q);
  return std::sqrt(dot(system.work, system.work.q, system.work.q));
}

/// Solves of one system, each measured against the forces that the one before has found.
constexpr int most_measures = 8;
/// Springs' load / forces found from which an increment is solved for: the whole would drown it in the rounding of that load.
constexpr Real far_carried = 1e3;
/// Of its errors, what a solve leaves: closer to them it only moves x along what A hardly resists.
constexpr Real roundings = 16;
/// Share of the forces from which what rounding may leave unbalanced is looked at more closely.
constexpr Real most_rounding = 1e-4;

/// Times the least gap found on the way: a search for multipliers that ends there has gone astray.
constexpr Real far_off = 10;

bool any_multipliers(const Springs& springs) {
  return springs.any() && largest_entry(springs.by_multiplier) > 0;
}

/// The springs' part of a solve, whose multipliers are as they are.
class HeldSolve {
 public:
  HeldSolve(HeldSystem& system, const Field& b, const Field& goal, const Field& x,
            const Field& base, const HeldOptions& options)
      : system_(system),
        b_(b),
        goal_(goal),
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
    const Apply rock = [&](const Field& u, const Field& v) { apply_rock(system_, u, v); };
    const Apply a = [&](const Field& u, const Field& v) {
      rock(u, v);
      apply_springs(system_.springs, system_.spring_factor, u, v);
    };
    PcgReport done;
    if (carried_) {
      done = solve_increment(system_, rock, a, b_, goal_, x_, pcg_, report);
    } else {
      const LoadWithSprings with_springs(system_, goal_, b_);
      if (by_forces_) load_ = std::sqrt(dot(system_.work, b_, b_));
      done = solve_by_policy(system_, a, b_, x_, pcg_, report);
    }
    pcg_.reference = done.reference;  // one measure for all solves
    report.iterations += done.iterations;
    report.residual = done.residual;
    report.converged = small_enough(done, pcg_);
    if (reduction == 0 && done.converged && done.residual > pcg_.tolerance) {  // rounding is left
      pcg_.reference *= done.residual / pcg_.tolerance;
      report.residual = pcg_.tolerance;
    }
  }

  /// Measures what is left against the forces found; false: it would have to be less.
  bool measure() {
    const Real left = report.residual * pcg_.reference;
    const Real forces = std::max({options_.pcg.reference, std::sqrt(dot(system_.work, b_, b_)),
                                  spring_forces(system_, goal_, x_)});
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

  HeldSystem& system_;
  const Field &b_, &goal_, &x_, &base_;
  const HeldOptions& options_;
  PcgOptions pcg_;
  bool by_forces_ = false;  ///< residuals count against the forces found
  bool carried_ = false;    ///< supports carry rock far: increments are solved for
  Real load_ = 0;           ///< norm, with the springs' part
};

/// Finds the multipliers that bring augmented points to their places, from those there are.
class MultiplierSearch {
 public:
  MultiplierSearch(HeldSystem& system, const Field& goal, const Field& x, const Field& base,
                   const HeldOptions& options, HeldSolve& inner)
      : system_(system),
        goal_(goal),
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
      if (!close && (report.outer >= options_.max_outer || stalled_ >= options_.patience))
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
    const Real gap =
        multiplier_change(system_.springs, system_.spring_factor, x_, goal_, system_.springs.force);
    inner_.report.gap =
        gap > 0 ? gap / std::max({largest_motion(system_, x_, base_), largest_entry(goal_), least})
                : 0;
    return gap;
  }

  /// Whether the search gets on, and how it is to go on.
  void judge(Real gap) {
    if (gap < least_) {
      least_ = gap;
      Kokkos::deep_copy(system_.best_multiplier, system_.springs.multiplier);
    }
    stalled_ = gap < 0.5 * best_ ? 0 : stalled_ + 1;
    if (stalled_ == 0) best_ = gap;
    // What was learned before may have grown stale: every inner solve is inexact, and old pairs carry its noise on.
    if (stalled_ == 2 && !restarted_) {
      acceleration_.forget();
      restarted_ = true;
      stalled_ = 0;
      best_ = gap;
    }
    // Where little is left to learn the acceleration may take the noise of the solves for a slope: go on step by step without it.
    if (stalled_ >= options_.patience && options_.plain_at_last && !exact_) {
      exact_ = true;
      stalled_ = 0;
      best_ = gap;
    }
  }

  /// Supports that contradict each other have no multipliers: the search for them only ends far off, and goes back.
  void leave(Real gap) {
    const bool astray = gap > far_off * least_;
    if (astray) {
      Kokkos::deep_copy(system_.springs.multiplier, system_.best_multiplier);
      Kokkos::deep_copy(x_, 0.0);
    }
    if (astray || !inner_.done()) inner_.solve(0);
    if (astray) measure_gap();
  }

  HeldSystem& system_;
  const Field &goal_, &x_, &base_;
  const HeldOptions& options_;
  HeldSolve& inner_;
  Anderson own_{most_pairs};
  Anderson& acceleration_;
  int stalled_ = 0;  ///< updates since the gap was last halved
  bool restarted_ = false;
  bool exact_ = false;  ///< each solve goes to the tolerance, each update by itself
  Real best_ = std::numeric_limits<Real>::infinity(), least_ = best_;  ///< m
};

}  // namespace

SolveReport find_same_motion(HeldSystem& system, const Field& x, const Field& y,
                             const PcgOptions& pcg, Real enough) {
  const Apply a = [&](const Field& u, const Field& v) {
    apply_rock(system, u, v);
    apply_springs(system.springs, system.spring_factor, u, v);
  };
  const Field load = device::make_field("solve::load_of_motion", system.op.unknowns);
  a(x, load);
  SolveReport report;
  const PcgReport done = solve_if_easy(system, a, load, y, pcg, report.preconditioner);
  report.iterations = done.iterations;
  report.residual = done.residual;
  const bool direct = report.preconditioner == Preconditioner::direct;
  report.converged = done.iterations > 0 && done.residual <= (direct ? enough : pcg.tolerance);
  return report;
}

SolveReport solve_held(HeldSystem& system, const Field& b, const Field& goal, const Field& x,
                       const Field& base, const HeldOptions& options) {
  HeldSolve solve(system, b, goal, x, base, options);
  const bool by_multipliers = any_multipliers(system.springs);
  solve.solve(by_multipliers ? inner_reduction : 0);
  if (by_multipliers && solve.report.converged)
    MultiplierSearch(system, goal, x, base, options, solve).run();
  return solve.report;
}

}  // namespace rockfold::solve
