#include <algorithm>
#include <cmath>

#include "kernels/solve/ways_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

bool any_levels(const HeldSystem& system) {
  return !system.grid.levels.empty() || !system.cover_grid.levels.empty();
}

/// Whether steps in time are best left to blocks: multigrid has failed in one in which they came to the end.
bool keeps_to_blocks(const HeldSystem& system) {
  return system.blocks_did && system.combination.mass != 0;
}

/// Whether the next solve is to use multigrid. Short time steps need none.
bool wants_grid(const HeldSystem& system) {
  if (!any_levels(system) || system.grid_failed || !(system.largest_diagonal > 0) ||
      !worth_a_grid(system))
    return false;
  if (system.preconditioner == Preconditioner::multigrid) return true;
  if (keeps_to_blocks(system)) return false;
  if (system.slow) return true;
  return system.combination.mass == 0 && has_grid(system);
}

Preconditioning choose(HeldSystem& system, const Apply& a) {
  Preconditioning m;
  m.covers = system.op.functions > 1 ? &system.cover_blocks : nullptr;
  m.spring_factor = system.spring_factor;
  const bool grid = wants_grid(system);
  if (system.op.functions == 1 && !(grid && system.grid_current)) m.inverse = inverse_of(system);
  if (!grid) return m;
  if (system.op.functions > 1) {
    if (!system.grid_current)
      set_values(system.cover_grid, a, system.work, system.op, system.cover_blocks, system.springs,
                 system.combination, system.spring_factor);
    m.cover_grid = &system.cover_grid;
  } else {
    if (!system.grid_current) set_inverse(system.grid, m.inverse, system.largest_diagonal);
    m.inverse = system.inverse = {};  // the grid has it in single precision
    if (!system.grid_current)
      set_values(system.grid, system.op, system.springs, system.combination, system.spring_factor);
    m.grid = &system.grid;
  }
  system.grid_current = true;
  return m;
}

/// From multigrid to blocks, from blocks to multigrid. False: there is no other way.
bool change_way(HeldSystem& system, Preconditioning& m, const Apply& a) {
  const bool from_grid = m.any_grid();
  system.grid_failed = from_grid;
  if (!from_grid) {
    system.slow = true;
    if (!wants_grid(system)) return false;
  }
  m = choose(system, a);
  return true;
}

/// Of blocks of covers with several functions in a step in time. What other ways find may move these functions where they depend on each
/// other, step by step farther; blocks leave them where they are.
constexpr Index patience_in_time = 2000;

/// Iterations after which the other way is tried: first with blocks, first with multigrid, then with blocks (a cycle costs what ten
/// of them do), then with multigrid.
Index patience(const HeldSystem& system, bool grid, int tries, bool factors_next) {
  const Combination& c = system.combination;
  const bool step = c.mass != 0 && c.stiffness >= 1;  // not the start, which is found with the mass
  if (tries == 0 && !grid && system.op.functions > 1 && step) return patience_in_time;
  if (factors_next) return grid ? 150 : 200;
  if (tries == 0) return grid ? 300 : 200;
  return grid ? 1000 : 1500;
}

/// What a cycle costs in iterations with blocks.
constexpr Index cost_of_cycle = 12;
/// Iterations before which nobody asks what factors would cost.
constexpr Index least_spent = 200;
/// An entry of the matrix in an iteration, over a multiplication of a factorisation: the one waits for memory, the other does not.
constexpr double cost_of_entry = 10;

/// Multiplications that take some tenths of a second, and covers of which they may be those.
constexpr double few_operations = 1e9;
constexpr Index few_covers = 1000;

/// Iterations with factors: of an earlier matrix, of the present one.
constexpr Index patience_with_old = 20, patience_with_new = 200;
/// Pivots that count as none, in the order in which they are tried. What is left of functions that depend on each other is rounding, and
/// an answer to it does harm; of slivers, of thin plates, and of rock that is soft beside its springs it is all that resists. In time steps
/// inertia resists too, and what is known of such functions to a few digits only grows from step to step.
constexpr int pivot_choices = 4;
constexpr Real pivots_at_rest[pivot_choices] = {1e-12, 1e-14, 1e-10, 1e-8},
               pivots_in_time[pivot_choices] = {1e-10, 1e-12, 1e-8, 1e-14};

Real least_pivot_of(const HeldSystem& system) {
  return (system.combination.mass != 0 ? pivots_in_time : pivots_at_rest)[system.factors.pivot];
}

/// Of the reference: what rounding may leave at most.
constexpr Real most_left = 1e-4;
/// Larger systems, which will hardly have factors, do not keep where they started.
constexpr Index most_kept = 200000;

/// Factors go back to the start of a solve: what other ways have put into functions that depend on each other would stay.
void keep_start(HeldSystem& system, const Field& x) {
  Factors& factors = system.factors;
  if (!factors.possible() || !may_have_factors(system)) return;
  if (factors.start.extent(0) == 0)
    factors.start = device::make_field("solve::start", system.op.unknowns);
  Kokkos::deep_copy(factors.start, x);
}
void go_back(const HeldSystem& system, const Field& x) {
  if (system.factors.start.extent(0) > 0)
    Kokkos::deep_copy(x, system.factors.start);
  else
    Kokkos::deep_copy(x, 0.0);
}

/// Whether factors cost no more than so many iterations with blocks.
bool cost_no_more(const Factors& factors, Index iterations) {
  const double width = factors.pattern.width,
               entries = width * width * static_cast<double>(factors.pattern.column.size());
  return static_cast<double>(iterations) * cost_of_entry * entries >= factors.solver->operations();
}

/// Whether a static system's factors cost next to nothing, while its functions depend on each other, or it has taken as long as they
/// would by now: of two ways whose end is not known the other is then tried, and twice the time of the better one is lost at most. Steps
/// in time are left to blocks as long as these do.
bool factors_pay(HeldSystem& system) {
  Factors& factors = system.factors;
  const bool in_time = system.combination.mass != 0,
             small = !in_time && system.op.functions > 1 && system.op.covers <= few_covers;
  if (system.preconditioner != Preconditioner::automatic ||
      (in_time && !(system.slow && wants_grid(system))) || !factors.possible() ||
      !(small || system.spent >= least_spent) || !may_have_factors(system) ||
      !analyse(factors, system.op, system.springs))
    return false;
  if (small && factors.solver->operations() <= few_operations) return true;
  return system.spent >= least_spent && cost_no_more(factors, system.spent);
}

/// Whether the factors at hand may do for the present matrix.
bool alike(const HeldSystem& system) {
  const Factors& factors = system.factors;
  return factors.any && factors.combination.stiffness == system.combination.stiffness &&
         factors.combination.mass == system.combination.mass &&
         factors.spring_factor == system.spring_factor;
}

/// Conjugate gradients with the factors as they are. What rounding leaves of the product of A with functions that all but depend on
/// each other cannot be made less: where it alone is left, the solve has converged.
PcgReport solve_once_with_factors(HeldSystem& system, const Apply& a, const Field& load,
                                  const Field& x, const PcgOptions& pcg, Index spent,
                                  Preconditioning& m) {
  const Factors& factors = system.factors;
  m = {};
  m.factors = &factors;
  PcgOptions how = pcg;
  how.max_iterations =
      std::min(pcg.max_iterations - spent, factors.current ? patience_with_new : patience_with_old);
  PcgReport done = solve_pcg(system.work, a, m, load, x, how);
  done.iterations += spent;
  if (factors.current && done.residual < most_left &&
      done.residual * done.reference <= rounding_of_product(factors, system.work, x))
    done.converged = true;
  return done;
}

/// With the factors at hand where they may do, else with new ones. False: they did not help.
bool solve_with_factors(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                        const PcgOptions& pcg, Preconditioning& m, PcgReport& done) {
  Factors& factors = system.factors;
  bool ready = factors.current || alike(system);
  for (int tried = 0; tried < pivot_choices;) {
    if (!ready) {
      if (!factorise(factors, system.op, system.combination, system.springs, system.spring_factor,
                     least_pivot_of(system)))
        return false;
      go_back(system, x);
    }
    const bool fresh = factors.current;
    done = solve_once_with_factors(system, a, load, x, pcg, done.iterations, m);
    if (small_enough(done, pcg)) {
      factors.helped = true;
      return true;
    }
    if (interrupt_signal || done.iterations >= pcg.max_iterations) return true;
    ready = false;
    if (!fresh) continue;
    factors.pivot = (factors.pivot + 1) % pivot_choices;
    ++tried;
  }
  factors.failed = true;
  return false;
}

}  // namespace

bool has_grid(const HeldSystem& system) {
  const Index least = system.op.functions == 1 ? least_for_multigrid : least_for_cover_grid;
  return any_levels(system) &&
         (system.op.covers >= least || system.preconditioner == Preconditioner::multigrid);
}

bool worth_a_grid(const HeldSystem& system) {
  return system.combination.stiffness != 0 || system.op.functions > 1;
}

bool may_have_factors(const HeldSystem& system) {
  return system.op.unknowns <= most_kept;
}

bool small_enough(const PcgReport& done, const PcgOptions& pcg) {
  return done.converged || done.residual <= pcg.tolerance;
}

PcgReport solve_any_way(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                        const PcgOptions& pcg, Preconditioning& m) {
  PcgReport done;
  const Factors& factors = system.factors;
  keep_start(system, x);
  const bool begin_with_factors =
      factors.possible() &&
      (factors.helped || system.preconditioner == Preconditioner::direct || factors_pay(system));
  if (begin_with_factors && solve_with_factors(system, a, load, x, pcg, m, done)) return done;
  m = choose(system, a);
  Index spent = done.iterations;
  bool another = true, first_broke = false;
  for (int tries = 0;; ++tries) {
    const bool grid = m.any_grid(), may_change = another && !(tries == 1 && first_broke),
               factors_next = tries == 0 && factors.possible();
    PcgOptions how = pcg;
    how.max_iterations = pcg.max_iterations - spent;
    const bool for_good = !grid && keeps_to_blocks(system);
    if (factors_next || (may_change && !for_good && (grid || any_levels(system))))
      how.max_iterations =
          std::min(how.max_iterations,
                   patience(system, grid, tries,
                            factors_next && system.preconditioner == Preconditioner::automatic));
    done = solve_pcg(system.work, a, m, load, x, how);
    spent += done.iterations;
    system.spent += (grid ? cost_of_cycle : 1) * done.iterations;
    const bool broke = done.iterations < how.max_iterations;
    if (small_enough(done, pcg)) {
      system.blocks_did = system.blocks_did || (!grid && system.grid_failed);
      break;
    }
    if (spent >= pcg.max_iterations || interrupt_signal) break;
    if (factors_next) {
      const Preconditioning first = m;
      done.iterations = spent;
      if (solve_with_factors(system, a, load, x, pcg, m, done)) return done;
      spent = done.iterations;
      m = first;
    }
    if (!may_change || !change_way(system, m, a)) break;
    if (std::isnan(done.residual)) Kokkos::deep_copy(x, 0.0);
    if (tries == 0) first_broke = broke;
    if (tries == 1) another = false;
  }
  done.iterations = spent;
  return done;
}

PcgReport solve_as_before(HeldSystem& system, const Apply& a, const Field& load, const Field& x,
                          const PcgOptions& pcg, Real enough, Preconditioning& m) {
  Factors& factors = system.factors;
  const auto ready = [&] {
    return factors.current || alike(system) ||
           factorise(factors, system.op, system.combination, system.springs, system.spring_factor,
                     least_pivot_of(system));
  };
  if (factors.helped && !factors.failed && ready())
    return solve_once_with_factors(system, a, load, x, pcg, 0, m);
  m = choose(system, a);
  const PcgReport done = solve_pcg(system.work, a, m, load, x, pcg);
  if (small_enough(done, pcg) || interrupt_signal || !factors.possible() ||
      !may_have_factors(system) || !analyse(factors, system.op, system.springs) ||
      !cost_no_more(factors, done.iterations) || !ready())
    return done;
  Kokkos::deep_copy(x, 0.0);
  const PcgReport other = solve_once_with_factors(system, a, load, x, pcg, 0, m);
  factors.helped = other.residual <= enough;
  return other;
}

}  // namespace rockfold::solve
