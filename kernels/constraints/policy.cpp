#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/precondition/inverses_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

/// With fewer covers a cycle costs more than the iterations that it saves (perf/records/2026-11-21-solver.md), of one function, of several.
constexpr Index least_for_multigrid = 2000, least_for_cover_grid = 100;

/// Stiffness over inertia, Σ diag αK / Σ diag βM, from which a step is solved as statics: block Jacobi takes some 9 √ratio iterations to
/// 1e-8 (half the root of the condition number times ln 2e8), multigrid 13 cycles of 12 iterations' cost each.
constexpr Real long_step = 300;

/// Iterations of block Jacobi in a step in time and elsewhere, and cycles, that are far more than a system which they suit takes.
constexpr Index limit_in_time = 1000, limit_of_blocks = 500, limit_of_multigrid = 300,
                limit_of_factors = 200;

/// Iterations with the factors of an earlier Newton iteration of the step that cost about as much as new ones.
constexpr Index limit_of_earlier_factors = 20;

/// Multiplications of a factorisation that take some tenths of a second: covers of several functions, which are nearly dependent, begin with
/// it where stiffness outweighs inertia.
constexpr double few_operations = 1e9;

/// Pivots of a matrix of unit diagonal that count as none, in the order in which they are tried. What is left of functions that depend on each
/// other is rounding, and an answer to it does harm; of slivers, of thin plates, and of rock that is soft beside its springs it is all that
/// resists. In time steps inertia resists too, and what is known of such functions to a few digits only grows from step to step.
constexpr std::array<Real, 4> pivots_at_rest{1e-12, 1e-14, 1e-10, 1e-8},
    pivots_in_time{1e-10, 1e-12, 1e-8, 1e-14};

/// Of the reference: what rounding may leave at most.
constexpr Real most_left = 1e-4;

Preconditioner block_kind(const ConstrainedSystem& system) {
  return system.preconditioner == Preconditioner::block_jacobi ? Preconditioner::block_jacobi
                                                               : Preconditioner::node_block_jacobi;
}

bool is_stiffer_than(const ConstrainedSystem& system, Real ratio) {
  return system.combination.stiffness != 0 &&
         (system.combination.mass == 0 || system.stiffness_over_inertia > ratio);
}

TermLists terms_of(const ConstrainedSystem& system) {
  return {&system.terms, &system.contacts};
}

/// As far as is known before its pattern is looked at.
bool may_have_factors(const ConstrainedSystem& system) {
  return system.factors.make && !(system.factors.analysed && system.factors.too_large);
}
bool factors_fit(ConstrainedSystem& system) {
  return may_have_factors(system) && analyse(system.factors, system.op, terms_of(system));
}

bool factors_cost_little(ConstrainedSystem& system) {
  return (system.op.functions > 1 || system.has_contacts) &&
         system.op.covers <= least_for_multigrid && factors_fit(system) &&
         system.factors.solver->operations() <= few_operations;
}

/// P A, and P B: what is eliminated stays as it is.
Apply free_matrix(const ConstrainedSystem& system, const Elimination& e) {
  return [&system, e](const Field& x, const Field& y) {
    apply_matrix(system, x, y);
    project(e, y);
  };
}
ApplyInverse free_inverse(ApplyInverse b, const Elimination& e) {
  return [b = std::move(b), e](const Field& r, const Field& z, const Array<Real>& energy) {
    b(r, z, energy);  // r·z = r·P z
    project(e, z);
  };
}

/// What rounding leaves of the product of A with functions that all but depend on each other cannot be made less: where it alone is left,
/// the solve has converged.
PcgReport solve_with_present_factors(ConstrainedSystem& system, const Elimination& e,
                                     const Field& load, const Field& x, PcgOptions pcg) {
  pcg.max_iterations = std::min(pcg.max_iterations, limit_of_factors);
  const Apply a = free_matrix(system, e);
  const ApplyInverse b = free_inverse(of_factors(system.factors, system.work), e);
  PcgReport done = system.symmetric
                       ? solve_pcg(system.work, a, b, load, x, pcg)
                       : solve_bicgstab(system.work, system.bicgstab, a, b, load, x, pcg);
  if (done.residual < most_left &&
      done.residual * done.reference <= rounding_of_product(system.factors, system.work, x))
    done.converged = true;
  return done;
}

/// Whether there are the factors of the matrix as it is, between what `e` allows, made with these pivots where they were not there.
bool has_factors(ConstrainedSystem& system, const Elimination& e, Real pivot) {
  Factors& factors = system.factors;
  if (factors.current && factors.pivot == pivot && factors.constrained == e.any()) return true;
  FactorConstraints constraints;
  if (e.any()) constraints = {system.springs.eliminated, [&e](BlockMatrix& a) { constrain(e, a); }};
  return factors_fit(system) &&
         factorise(factors, system.op, system.combination, terms_of(system), pivot, constraints);
}

const std::array<Real, 4>& pivots_of(const ConstrainedSystem& system) {
  return system.combination.mass == 0 ? pivots_at_rest : pivots_in_time;
}

/// Until some pivots do, each from the x given. `done`: what was before.
PcgReport solve_with_factors(ConstrainedSystem& system, const Field& load, const Field& x,
                             const PcgOptions& pcg, PcgReport done) {
  PcgOptions how = pcg;
  Kokkos::deep_copy(system.start, x);
  if (const Factors& f = system.factors; system.has_contacts && f.of_this_step && f.analysed &&
                                         !f.current && f.constrained == system.eliminated.any()) {
    how.max_iterations = std::min(limit_of_earlier_factors, pcg.max_iterations - done.iterations);
    const Index before = done.iterations;
    done = solve_with_present_factors(system, system.eliminated, load, x, how);
    done.iterations += before;
    if (small_enough(done, pcg)) return done;
  }
  for (const Real pivot : pivots_of(system)) {
    how.max_iterations = pcg.max_iterations - done.iterations;
    if (how.max_iterations <= 0 || interrupt_signal ||
        !has_factors(system, system.eliminated, pivot))
      break;
    Kokkos::deep_copy(x, system.start);
    const Index before = done.iterations;
    done = solve_with_present_factors(system, system.eliminated, load, x, how);
    done.iterations += before;
    if (small_enough(done, pcg)) break;
  }
  return done;
}

}  // namespace

bool may_want_multigrid(Preconditioner asked, Index covers, int functions) {
  if (asked == Preconditioner::multigrid) return true;
  return (asked == Preconditioner::automatic || asked == Preconditioner::direct) &&
         covers >= (functions == 1 ? least_for_multigrid : least_for_cover_grid);
}

bool has_levels(const ConstrainedSystem& system) {
  return !system.grid.levels.empty() || !system.cover_grid.levels.empty();
}

Policy policy_of(ConstrainedSystem& system) {
  const Preconditioner asked = system.preconditioner, blocks = block_kind(system);
  if (asked == Preconditioner::direct && factors_fit(system))
    return {Preconditioner::direct, limit_of_factors};
  if (asked == Preconditioner::automatic && is_stiffer_than(system, 1) &&
      factors_cost_little(system))
    return {Preconditioner::direct, limit_of_factors};
  const bool stiff = is_stiffer_than(system, long_step);
  if (has_levels(system) && system.largest_diagonal > 0 &&
      (stiff || asked == Preconditioner::multigrid))
    return {Preconditioner::multigrid, limit_of_multigrid};
  const bool in_time = system.combination.mass != 0 && system.combination.stiffness != 0;
  return {blocks, in_time ? limit_in_time : limit_of_blocks};
}

ApplyInverse make_inverse(ConstrainedSystem& system, Preconditioner kind) {
  const KrylovWork& work = system.work;
  const bool several = system.op.functions > 1;
  if (kind != Preconditioner::multigrid)
    return several ? of_cover_blocks(cover_blocks_of(system), work)
                   : of_blocks(inverse_of(system), work);
  const Apply a = free_matrix(system, {});
  if (several) {
    if (!system.grid_current)
      set_values(system.cover_grid, a, work, system.op, cover_blocks_of(system), system.terms,
                 system.combination);
  } else if (!system.grid_current) {
    set_inverse(system.grid, inverse_of(system), system.largest_diagonal);
    system.inverse = {};  // the grid has it in single precision
    set_values(system.grid, system.op, system.terms, system.combination);
  }
  system.grid_current = true;
  return several ? of_cover_grid(system.cover_grid, a, work) : of_multigrid(system.grid, work);
}

bool small_enough(const PcgReport& done, const PcgOptions& pcg) {
  return done.converged || done.residual <= pcg.tolerance;
}

PcgReport solve_by_policy(ConstrainedSystem& system, const Field& load, const Field& x,
                          const PcgOptions& pcg, SolveReport& report) {
  const Policy policy = policy_of(system);
  PcgReport done;
  report.preconditioner = report.fallbacks > 0 ? Preconditioner::direct : policy.first;
  if (report.preconditioner == Preconditioner::direct)
    return solve_with_factors(system, load, x, pcg, done);
  const auto solve = [&](Index most) {
    PcgOptions how = pcg;
    how.max_iterations = most;
    const Index before = done.iterations;
    const Elimination& e = system.eliminated;
    const Apply a = free_matrix(system, e);
    const ApplyInverse b = free_inverse(make_inverse(system, policy.first), e);
    done = system.symmetric ? solve_pcg(system.work, a, b, load, x, how)
                            : solve_bicgstab(system.work, system.bicgstab, a, b, load, x, how);
    done.iterations += before;
  };
  if (!may_have_factors(system)) {
    solve(pcg.max_iterations);
    return done;
  }
  Kokkos::deep_copy(system.start, x);
  solve(std::min(policy.limit, pcg.max_iterations));
  if (small_enough(done, pcg) || interrupt_signal || done.iterations >= pcg.max_iterations)
    return done;
  if (!factors_fit(system)) {  // goes on as it was
    if (!std::isnan(done.residual)) solve(pcg.max_iterations - done.iterations);
    return done;
  }
  Kokkos::deep_copy(x, system.start);
  report.preconditioner = Preconditioner::direct;
  ++report.fallbacks;
  return solve_with_factors(system, load, x, pcg, done);
}

PcgReport solve_if_easy(ConstrainedSystem& system, const Field& load, const Field& x,
                        const PcgOptions& pcg, Preconditioner& used) {
  PcgReport done;
  used = policy_of(system).first;
  Kokkos::deep_copy(x, 0.0);
  if (used != Preconditioner::direct) {
    done =
        solve_pcg(system.work, free_matrix(system, {}), make_inverse(system, used), load, x, pcg);
    if (small_enough(done, pcg) || !factors_fit(system)) return done;
    Kokkos::deep_copy(x, 0.0);
  }
  if (!has_factors(system, {}, pivots_of(system).front())) return done;
  used = Preconditioner::direct;
  return solve_with_present_factors(system, {}, load, x, pcg);
}

}  // namespace rockfold::solve
