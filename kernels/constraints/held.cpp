#include <utility>

#include "kernels/constraints/held_kernel.hpp"
#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/operator/rock_motion_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Σ of the diagonal over functions 0.
Real trace(const HeldSystem& system, const Blocks& diagonal) {
  const KrylovWork& work = system.work;
  const auto sum_of = work.energy;
  device::sum_then<1>(
      "rockfold::solve::trace", system.op.covers, work.partial,
      KOKKOS_LAMBDA(const Index p, device::Sums<1>& sum) {
        for (int d = 0; d < 3; ++d) sum.value[0] += diagonal(p, d);
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { sum_of(0) = sum.value[0]; });
  return device::to_host(sum_of)[0];
}

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
  const bool wanted = may_want_multigrid(preconditioner, op.covers, op.functions);
  system.work = make_krylov_work(op.unknowns);
  if (op.functions > 1) {
    if (wanted && covers.middle.empty())  // coarse functions are those about nodes
      system.cover_grid = make_cover_grid(covers, merged.fixed.points);
  } else if (wanted) {
    system.grid = make_multigrid(covers, op, merged.fixed.points, system.work.q);
  }
  system.springs = build_springs(merged.fixed, op.unknowns);
  system.shares = std::move(merged.shares);
  system.best_multiplier =
      device::make_field("solve::best_multiplier", system.springs.points.count);
  system.load_before =
      device::make_field("solve::load_before", static_cast<Index>(system.springs.row.extent(0)));
  if (preconditioner != Preconditioner::block_jacobi &&
      preconditioner != Preconditioner::node_block_jacobi)
    system.factors.make = direct;
  if (system.factors.make) system.start = device::make_field("solve::start", op.unknowns);
  system.factors.functions = op.functions;
  if (op.functions > 1) system.cover_blocks = make_cover_blocks(op.covers, op.functions);
  system.op = std::move(op);
  const Blocks mass("rockfold::solve::mass_diagonal", system.op.unknowns);
  diagonal_blocks(system.op, {0, 1}, mass);
  system.mass_trace = trace(system, mass);
  return system;
}

void set_combination(HeldSystem& system, const Combination& c, Real spring_factor, bool stiffen) {
  system.combination = c;
  system.spring_factor = spring_factor;
  find_diagonal(system);
  const Real inertia = c.mass * system.mass_trace;
  system.stiffness_over_inertia = inertia > 0 ? trace(system, system.inverse) / inertia - 1 : 0;
  if (stiffen)
    stiffen_springs(system.springs, spring_factor, system.op.covers, system.inverse,
                    c.mass == 0 && has_levels(system));
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
  system.grid_current = system.factors.current = false;
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
