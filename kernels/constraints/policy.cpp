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

Preconditioner block_kind(const HeldSystem& system) {
  return system.preconditioner == Preconditioner::block_jacobi ? Preconditioner::block_jacobi
                                                               : Preconditioner::node_block_jacobi;
}

bool is_stiffer_than(const HeldSystem& system, Real ratio) {
  return system.combination.stiffness != 0 &&
         (system.combination.mass == 0 || system.stiffness_over_inertia > ratio);
}

/// As far as is known before its pattern is looked at.
bool may_have_factors(const HeldSystem& system) {
  return system.factors.make && !system.factors.too_large;
}
bool factors_within_reach(HeldSystem& system) {
  return may_have_factors(system) && analyse(system.factors, system.op, system.springs);
}

bool factors_cost_little(HeldSystem& system) {
  return system.op.functions > 1 && system.op.covers <= least_for_multigrid &&
         factors_within_reach(system) && system.factors.solver->operations() <= few_operations;
}

/// What rounding leaves of the product of A with functions that all but depend on each other cannot be made less: where it alone is left,
/// the solve has converged.
PcgReport solve_with_present_factors(HeldSystem& system, const Apply& a, const Field& load,
                                     const Field& x, PcgOptions pcg) {
  pcg.max_iterations = std::min(pcg.max_iterations, limit_of_factors);
  PcgReport done = solve_pcg(system.work, a, of_factors(system.factors, system.work), load, x, pcg);
  if (done.residual < most_left &&
      done.residual * done.reference <= rounding_of_product(system.factors, system.work, x))
    done.converged = true;
  return done;
}

/// Whether there are the factors of the matrix as it is, made with these pivots where they were not there.
bool has_factors(HeldSystem& system, Real pivot) {
  Factors& factors = system.factors;
  return (factors.current && factors.pivot == pivot) ||
         factorise(factors, system.op, system.combination, system.springs, system.spring_factor,
                   pivot);
}

const std::array<Real, 4>& pivots_of(const HeldSystem& system) {
  return system.combination.mass == 0 ? pivots_at_rest : pivots_in_time;
}

/// Until some pivots do, each from the x given. `done`: what was before.
PcgReport solve_with_factors(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                             const PcgOptions& pcg, PcgReport done) {
  PcgOptions how = pcg;
  Kokkos::deep_copy(system.start, x);
  for (const Real pivot : pivots_of(system)) {
    how.max_iterations = pcg.max_iterations - done.iterations;
    if (how.max_iterations <= 0 || interrupt_signal || !has_factors(system, pivot)) break;
    Kokkos::deep_copy(x, system.start);
    const Index before = done.iterations;
    done = solve_with_present_factors(system, a, load, x, how);
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

bool has_levels(const HeldSystem& system) {
  return !system.grid.levels.empty() || !system.cover_grid.levels.empty();
}

Policy policy_of(HeldSystem& system) {
  const Preconditioner asked = system.preconditioner, blocks = block_kind(system);
  if (asked == Preconditioner::direct && factors_within_reach(system))
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

ApplyInverse make_inverse(HeldSystem& system, Preconditioner kind, const Apply& a) {
  const KrylovWork& work = system.work;
  const bool several = system.op.functions > 1;
  if (kind != Preconditioner::multigrid)
    return several ? of_cover_blocks(system.cover_blocks, work)
                   : of_blocks(inverse_of(system), work);
  if (several) {
    if (!system.grid_current)
      set_values(system.cover_grid, a, work, system.op, system.cover_blocks, system.springs,
                 system.combination, system.spring_factor);
  } else if (!system.grid_current) {
    set_inverse(system.grid, inverse_of(system), system.largest_diagonal);
    system.inverse = {};  // the grid has it in single precision
    set_values(system.grid, system.op, system.springs, system.combination, system.spring_factor);
  }
  system.grid_current = true;
  return several ? of_cover_grid(system.cover_grid, a, system.spring_factor, work)
                 : of_multigrid(system.grid, work);
}

bool small_enough(const PcgReport& done, const PcgOptions& pcg) {
  return done.converged || done.residual <= pcg.tolerance;
}

PcgReport solve_by_policy(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                          const PcgOptions& pcg, SolveReport& report) {
  const Policy policy = policy_of(system);
  PcgReport done;
  report.preconditioner = report.fallbacks > 0 ? Preconditioner::direct : policy.first;
  if (report.preconditioner == Preconditioner::direct)
    return solve_with_factors(system, a, load, x, pcg, done);
  const auto solve = [&](Index most) {
    PcgOptions how = pcg;
    how.max_iterations = most;
    const Index before = done.iterations;
    done = solve_pcg(system.work, a, make_inverse(system, policy.first, a), load, x, how);
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
  if (!factors_within_reach(system)) {  // goes on as it was
    if (!std::isnan(done.residual)) solve(pcg.max_iterations - done.iterations);
    return done;
  }
  Kokkos::deep_copy(x, system.start);
  report.preconditioner = Preconditioner::direct;
  ++report.fallbacks;
  return solve_with_factors(system, a, load, x, pcg, done);
}

PcgReport solve_if_easy(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                        const PcgOptions& pcg, Preconditioner& used) {
  PcgReport done;
  used = policy_of(system).first;
  Kokkos::deep_copy(x, 0.0);
  if (used != Preconditioner::direct) {
    done = solve_pcg(system.work, a, make_inverse(system, used, a), load, x, pcg);
    if (small_enough(done, pcg) || !factors_within_reach(system)) return done;
    Kokkos::deep_copy(x, 0.0);
  }
  if (!has_factors(system, pivots_of(system).front())) return done;
  used = Preconditioner::direct;
  return solve_with_present_factors(system, a, load, x, pcg);
}

}  // namespace rockfold::solve
