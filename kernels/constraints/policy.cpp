#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/precondition/inverses_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

/// With fewer covers there are no levels worth a cycle, of one function, of several.
constexpr Index least_for_multigrid = 2000, least_for_cover_grid = 100;

/// Rock of one function a cover that hangs together, by itself or by contacts: beyond this its factors cost a hundred cycles, and to look at their
/// pattern a few.
constexpr Index most_to_look_at = 20000;

/// Seconds of one core (perf/records/2026-11-28-factors.md): a multiplication of a factorisation, an entry of the matrix that is assembled
/// for it, an entry of the factors in each sweep of a solve …
constexpr double of_operation = 0.15e-9, of_assembly = 50e-9, of_factor_entry = 0.6e-9;
/// … an entry of the matrix in an iteration of conjugate gradients, with one function and with several …
constexpr double of_entry = 0.5e-9, of_entry_of_several = 1.7e-9;
/// … and iterations that a cycle of multigrid costs.
constexpr double iterations_of_cycle = 12;

/// A multiplication of the factors of a coarsest level that contacts join, s (cubes of 216 to 2,197 covers, one core: 0.4 to 0.8e-9); how many
/// there are for n unknowns that hang together in three dimensions, over n² (George 1973); covers with which one shares elements on `tet6`,
/// itself among them.
constexpr double of_coarsest_operation = 0.5e-9, of_dissection = 10, neighbours = 15;

/// Iterations with factors, where they are of the whole matrix and where joints slide (two products each, with the symmetric part), and cycles
/// of multigrid to 1e-8 with 1, 4 and 10 functions a cover.
constexpr double with_factors = 3, with_symmetric_part = 32, cycles[3] = {13, 60, 300};

/// Iterations of blocks to 1e-8 over √κ, κ = Σ diag αK / Σ diag βM: half the root of the condition number times ln 2e8; and how many times as
/// many where functions depend on each other all but exactly, or joints hold rock by springs.
constexpr double of_condition = 9, slower = 5;

/// Products of an iteration of BiCGStab, and its iterations with blocks that are whole covers of rock, n + √κ, to the thousandth that an iteration of
/// Newton's method leaves: what is stiff is inside, and the joints carry a force no further than blocks touch each other (slopes and walls of 48
/// to 819 blocks, κ from 2 to 5,000: 20 to 47).
constexpr double products = 2, through_joints = 20;

/// Solves that a matrix serves which stays the same from step to step: at least.
constexpr double solves_of_steady_matrix = 10;

/// Iterations of block Jacobi in a step in time and elsewhere, cycles, and iterations with factors that are far more than a system which
/// they suit takes.
constexpr Index limit_in_time = 1000, limit_of_blocks = 500, limit_of_multigrid = 300,
                limit_of_factors = 200;

/// Iterations with the factors of an earlier Newton iteration of the step that cost about as much as new ones.
constexpr Index limit_of_earlier_factors = 20;

/// Pivots of a matrix of unit diagonal that count as none, in the order in which they are tried: what is left of functions that depend on each
/// other is rounding, and an answer to it does harm; of slivers, of thin plates, and of rock that is soft beside its springs it is all that
/// resists.
constexpr std::array<Real, 3> pivots{1e-12, 1e-10, 1e-8};

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

/// Entries of the matrix, once analysed.
double entries_of(const ConstrainedSystem& system) {
  const BlockMatrix& pattern = system.factors.pattern;
  return static_cast<double>(pattern.column.size()) * pattern.width * pattern.width;
}

double cost_of_iteration(const ConstrainedSystem& system) {
  return entries_of(system) * (system.op.functions == 1 ? of_entry : of_entry_of_several);
}

/// s, of a solve with factors, its share of their making included.
double cost_of_factors(const ConstrainedSystem& system) {
  const DirectSolver& solver = *system.factors.solver;
  const double make = of_operation * solver.operations() + of_assembly * entries_of(system);
  return make / (system.steady ? solves_of_steady_matrix : 1) +
         (system.symmetric ? with_factors : with_symmetric_part) * 2 * of_factor_entry *
             solver.entries();
}

/// Iterations with blocks. Statics take as many as the lattice is wide, and more: levels are better where there are any.
double iterations_of_blocks(const ConstrainedSystem& system) {
  if (system.combination.mass == 0) return std::numeric_limits<double>::infinity();
  if (system.of_blocks && system.has_contacts)
    return products * (through_joints + std::sqrt(system.stiffness_over_inertia));
  const bool hard = system.op.functions > 1 || system.has_contacts;
  return of_condition * std::sqrt(system.stiffness_over_inertia) * (hard ? slower : 1);
}

/// Likewise of multigrid's cycles.
double iterations_of_levels(const ConstrainedSystem& system) {
  const int functions = system.op.functions;
  return cycles[functions == 1 ? 0 : functions <= 4 ? 1 : 2] * iterations_of_cycle;
}

/// Whether there are levels that serve: where contacts join the parts of the coarsest, its factors must cost less than the cycles.
bool have_useful_levels(const ConstrainedSystem& system) {
  if (!has_levels(system) || !(system.largest_diagonal > 0)) return false;
  if (!system.contacts.any()) return true;
  const double width = 3 * system.op.functions,
               coarsest =
                   (system.op.functions == 1 ? system.grid.parents : system.cover_grid.parents)
                       .back()
                       .coarse;
  const double make =
      of_coarsest_operation * of_dissection * coarsest * coarsest * std::pow(width, 3);
  const double iteration = (system.op.functions == 1 ? of_entry : of_entry_of_several) *
                           neighbours * system.op.covers * width * width;
  return make < iterations_of_levels(system) * iteration;
}

bool may_begin_with_factors(ConstrainedSystem& system, bool levels) {
  const bool levels_do = system.op.functions == 1 && (levels || !system.has_contacts);
  return !(levels_do && system.op.covers > most_to_look_at) && factors_fit(system);
}

Apply matrix_of(const ConstrainedSystem& system) {
  return [&system](const Field& x, const Field& y) { apply_matrix(system, x, y); };
}
ApplyInverse with_points(ConstrainedSystem& system, ApplyInverse b) {
  return with_constraints(system.constraints, std::move(b), system.work);
}

/// What rounding leaves of the product of A with functions that all but depend on each other cannot be made less: where it alone is left,
/// the solve has converged.
PcgReport solve_with_present_factors(ConstrainedSystem& system, const Field& load, const Field& x,
                                     PcgOptions pcg) {
  pcg.max_iterations = std::min(pcg.max_iterations, limit_of_factors);
  const Apply a = matrix_of(system);
  const ApplyInverse b = with_points(system, of_factors(system.factors, system.work));
  PcgReport done = system.symmetric
                       ? solve_pcg(system.work, a, b, load, x, pcg)
                       : solve_bicgstab(system.work, system.bicgstab, a, b, load, x, pcg);
  if (done.residual < most_left &&
      done.residual * done.reference <= rounding_of_product(system.factors, system.work, x))
    done.converged = true;
  return done;
}

/// Whether there are the factors of the matrix as it is, with points as they are known, made with these pivots where they were not there.
bool has_factors(ConstrainedSystem& system, Real pivot) {
  Factors& factors = system.factors;
  if (factors.current && factors.pivot == pivot) return true;
  return factors_fit(system) &&
         factorise(factors, system.op, system.combination, terms_of(system), pivot);
}

/// Until some pivots do, each from the x given. `done`: what was before.
PcgReport solve_with_factors(ConstrainedSystem& system, const Field& load, const Field& x,
                             const PcgOptions& pcg, PcgReport done) {
  PcgOptions how = pcg;
  Kokkos::deep_copy(system.start, x);
  if (const Factors& f = system.factors;
      system.has_contacts && f.of_this_step && f.analysed && !f.current) {
    how.max_iterations = std::min(limit_of_earlier_factors, pcg.max_iterations - done.iterations);
    const Index before = done.iterations;
    done = solve_with_present_factors(system, load, x, how);
    done.iterations += before;
    if (small_enough(done, pcg)) return done;
  }
  PcgReport best;
  for (const Real pivot : pivots) {
    how.max_iterations = pcg.max_iterations - done.iterations;
    if (how.max_iterations <= 0 || interrupt_signal || !has_factors(system, pivot)) break;
    Kokkos::deep_copy(x, system.start);
    const Index before = done.iterations;
    done = solve_with_present_factors(system, load, x, how);
    done.iterations += before;
    if (small_enough(done, pcg)) return done;
    if (!(done.residual < best.residual)) continue;
    best = done;
    Kokkos::deep_copy(system.best, x);
  }
  if (!std::isfinite(best.residual)) return done;
  Kokkos::deep_copy(x, system.best);
  best.iterations = done.iterations;
  best.converged = best.nothing_resists && best.residual < most_left;
  return best;
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
  const Preconditioner asked = system.preconditioner;
  const bool levels = have_useful_levels(system);
  const bool in_time = system.combination.mass != 0 && system.combination.stiffness != 0;
  const Policy by_factors{Preconditioner::direct, limit_of_factors},
      by_levels{Preconditioner::multigrid, limit_of_multigrid},
      by_blocks{block_kind(system), in_time ? limit_in_time : limit_of_blocks};
  if (asked == Preconditioner::multigrid) return levels ? by_levels : by_blocks;
  if (asked == Preconditioner::block_jacobi || asked == Preconditioner::node_block_jacobi)
    return by_blocks;
  if (asked == Preconditioner::direct && factors_fit(system)) return by_factors;
  if (system.begins_with_factors && system.combination.stiffness != 0 && factors_fit(system))
    return by_factors;
  // In short steps blocks leave functions that depend on each other where they are; factors do not, and energy is lost.
  const bool stiff = is_stiffer_than(system, 1);
  const double blocks = stiff ? iterations_of_blocks(system) : 0;
  const bool cycles_are_cheaper = levels && stiff && iterations_of_levels(system) < blocks;
  const double iterations =
      cycles_are_cheaper ? iterations_of_levels(system) : std::min<double>(blocks, by_blocks.limit);
  if (stiff && may_begin_with_factors(system, cycles_are_cheaper) &&
      cost_of_factors(system) < iterations * cost_of_iteration(system))
    return by_factors;
  return cycles_are_cheaper ? by_levels : by_blocks;
}

ApplyInverse make_inverse(ConstrainedSystem& system, Preconditioner kind) {
  const KrylovWork& work = system.work;
  const bool several = system.op.functions > 1;
  if (kind != Preconditioner::multigrid)
    return with_points(system, several ? of_cover_blocks(cover_blocks_of(system), work)
                                       : of_blocks(inverse_of(system, true), work));
  const Apply a = [&system](const Field& x, const Field& y) { apply_known(system, x, y); };
  if (several) {
    if (!system.grid_current)
      set_values(system.cover_grid, a, work, system.op, cover_blocks_of(system), system.terms,
                 system.contacts, system.combination);
  } else if (!system.grid_current) {
    set_inverse(system.grid, inverse_of(system, true), system.largest_diagonal);
    system.inverse = {};  // the grid has it in single precision
    set_values(system.grid, system.op, system.terms, system.contacts, system.combination);
  }
  system.grid_current = true;
  return with_points(system, several ? of_cover_grid(system.cover_grid, a, work)
                                     : of_multigrid(system.grid, work));
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
    const Apply a = matrix_of(system);
    const ApplyInverse b = make_inverse(system, policy.first);
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
  if (system.combination.stiffness != 0) system.begins_with_factors = true;
  return solve_with_factors(system, load, x, pcg, done);
}

}  // namespace rockfold::solve
