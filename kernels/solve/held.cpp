#include <utility>

#include "kernels/solve/held_kernel.hpp"
#include "kernels/solve/rock_motion_kernel.hpp"
#include "kernels/solve/ways_kernel.hpp"

namespace rockfold::solve {
namespace {

/// The diagonal blocks, without what is held.
void find_diagonal(HeldSystem& system) {
  if (system.inverse.extent(0) == 0)
    system.inverse = Blocks("rockfold::solve::inverse_diagonal", system.op.unknowns);
  if (system.other.diagonal)
    system.other.diagonal(system.inverse);
  else
    diagonal_blocks(system.op, system.combination, system.inverse);
}

}  // namespace

HeldSystem make_held_system(const CoverArrays& covers, Operator op, const FixedPoints& fixed,
                            Preconditioner preconditioner, const MakeDirectSolver& direct) {
  HeldSystem system;
  system.preconditioner = preconditioner;
  MergedPoints merged = merge_points(fixed);
  const bool any = preconditioner == Preconditioner::multigrid,
             automatic = preconditioner == Preconditioner::automatic ||
                         preconditioner == Preconditioner::direct;
  system.work = make_pcg_work(op.unknowns);
  if (op.functions > 1) {
    if ((any || automatic) && covers.middle.empty())  // coarse functions are those about nodes
      system.cover_grid = make_cover_grid(covers, merged.fixed.points);
  } else if (any || (automatic && op.covers >= least_for_multigrid)) {
    system.grid = make_multigrid(covers, op, merged.fixed.points, system.work.q);
  }
  system.springs = build_springs(merged.fixed, op.unknowns);
  system.shares = std::move(merged.shares);
  system.best_multiplier =
      device::make_field("solve::best_multiplier", system.springs.points.count);
  system.load_before =
      device::make_field("solve::load_before", static_cast<Index>(system.springs.row.extent(0)));
  if (any || automatic) system.factors.make = direct;
  system.factors.functions = op.functions;
  if (op.functions > 1) system.cover_blocks = make_cover_blocks(op.covers, op.functions);
  system.op = std::move(op);
  return system;
}

void set_combination(HeldSystem& system, const Combination& c, Real spring_factor, bool stiffen) {
  if ((system.combination.stiffness == 0) != (c.stiffness == 0)) system.slow = false;
  system.combination = c;
  system.spring_factor = spring_factor;
  find_diagonal(system);
  if (stiffen)
    stiffen_springs(system.springs, spring_factor, system.op.covers, system.inverse,
                    c.mass == 0 && has_grid(system));
  add_spring_diagonal(system.springs, spring_factor, system.inverse);
  const Blocks diagonal = system.inverse;
  system.largest_diagonal = device::largest(
      "rockfold::solve::largest_diagonal", system.op.unknowns, KOKKOS_LAMBDA(const Index p) {
        return device::math::fmax(diagonal(p, 0),
                                  device::math::fmax(diagonal(p, 1), diagonal(p, 2)));
      });
  invert_blocks(system.inverse);
  if (system.op.functions > 1) {
    set_values(system.cover_blocks, system.op, system.springs, c, spring_factor);
    system.inverse = {};  // the blocks hold it
  }
  system.grid_current = system.grid_failed = false;
  system.spent = 0;
  system.factors.current = system.factors.failed = false;
  system.acceleration.forget();
}

const Blocks& inverse_of(HeldSystem& system) {
  if (system.inverse.extent(0) == 0) {
    find_diagonal(system);
    add_spring_diagonal(system.springs, system.spring_factor, system.inverse);
    invert_blocks(system.inverse);
  }
  return system.inverse;
}

Real largest_motion(HeldSystem& system, const Field& x, const Field& base) {
  if (system.masses.extent(0) == 0) system.masses = cover_masses(system.op);
  return largest_mean(system.op, system.masses, x, base, system.work.p, system.work.q);
}

}  // namespace rockfold::solve
