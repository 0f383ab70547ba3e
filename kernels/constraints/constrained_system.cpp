#include <utility>

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/operator/rock_motion_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Σ of the diagonal over functions 0.
Real trace(const ConstrainedSystem& system, const Blocks& diagonal) {
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
void find_diagonal(ConstrainedSystem& system) {
  if (system.inverse.extent(0) == 0)
    system.inverse = Blocks("rockfold::solve::inverse_diagonal", system.op.unknowns);
  diagonal_blocks(system.op, system.combination, system.inverse);
}

}  // namespace

ConstrainedSystem make_constrained_system(const CoverArrays& covers, Operator op,
                                          const FixedPoints& fixed, Preconditioner preconditioner,
                                          const MakeDirectSolver& direct,
                                          const MaterialPoints& others) {
  ConstrainedSystem system;
  system.preconditioner = preconditioner;
  system.of_blocks = covers.nodes_per_part() == 1;
  MergedPoints merged = merge_points(fixed);
  MaterialPoints points = merged.fixed.points;
  append_points(points, others);
  const bool wanted = may_want_multigrid(preconditioner, op.covers, op.functions);
  system.work = make_krylov_work(op.unknowns);
  if (op.functions > 1) {
    if (wanted && covers.middle.empty())  // coarse functions are those about nodes
      system.cover_grid = make_cover_grid(covers, points);
  } else if (wanted) {
    system.grid = make_multigrid(covers, op, points, system.work.q);
  }
  system.springs = build_springs(merged.fixed, op.unknowns);
  system.constraints = make_constraints(system.springs, op.unknowns);
  system.terms = make_point_terms(points, op.unknowns);
  system.shares = std::move(merged.shares);
  if (system.springs.any()) {
    system.load = device::make_field("solve::load", op.unknowns);
    system.increment = device::make_field("solve::increment", op.unknowns);
    system.before = device::make_field("solve::before", op.unknowns);
    system.left_to_go = device::make_field("solve::left_to_go", system.springs.points.count);
  }
  if (preconditioner != Preconditioner::block_jacobi &&
      preconditioner != Preconditioner::node_block_jacobi)
    system.factors.make = direct;
  if (system.factors.make) {
    system.start = device::make_field("solve::start", op.unknowns);
    system.best = device::make_field("solve::best", op.unknowns);
  }
  system.factors.functions = op.functions;
  if (op.functions > 1) system.cover_blocks = make_cover_blocks(op.covers, op.functions);
  system.op = std::move(op);
  const Blocks mass("rockfold::solve::mass_diagonal", system.op.unknowns);
  diagonal_blocks(system.op, {0, 1}, mass);
  system.mass_trace = trace(system, mass);
  return system;
}

void apply_rock(const ConstrainedSystem& system, const Field& x, const Field& y) {
  apply(system.op, system.combination, x, y);
}

void apply_matrix(const ConstrainedSystem& system, const Field& x, const Field& y) {
  apply_rock(system, x, y);
  apply_springs(system.springs, system.springs.tie, 1, x, y);
  apply_terms(system.terms, x, y, system.springs.points.count);
  apply_terms(system.contacts, x, y);
}

void apply_known(const ConstrainedSystem& system, const Field& x, const Field& y) {
  apply_rock(system, x, y);
  apply_terms(system.terms, x, y);
  apply_terms(system.contacts, x, y);
}

void contacts_changed(ConstrainedSystem& system) {
  system.factors.analysed = system.grid.contacts.found = system.cover_grid.contacts.found = false;
}

void set_combination(ConstrainedSystem& system, const Combination& c, Real spring_factor) {
  system.combination = c;
  system.spring_factor = spring_factor;
  find_diagonal(system);
  add_terms_diagonal(system.contacts, system.inverse);
  const Real inertia = c.mass * system.mass_trace;
  system.stiffness_over_inertia = inertia > 0 ? trace(system, system.inverse) / inertia - 1 : 0;
  add_terms_diagonal(system.terms, system.inverse, system.springs.points.count);
  set_ties(system.constraints, system.inverse, spring_factor);
  set_tangents(system.springs, system.constraints.known, system.terms);
  const Blocks diagonal = system.inverse;
  system.largest_diagonal = device::largest(
      "rockfold::solve::largest_diagonal", system.op.unknowns, KOKKOS_LAMBDA(const Index p) {
        return device::math::fmax(diagonal(p, 0),
                                  device::math::fmax(diagonal(p, 1), diagonal(p, 2)));
      });
  if (system.op.functions > 1)
    system.inverse = {};  // the blocks of covers hold it
  else
    invert_blocks(system.inverse);
  system.inverse_knows_springs = false;
  system.blocks_current = system.grid_current = system.factors.current = false;
}

const CoverBlocks& cover_blocks_of(ConstrainedSystem& system) {
  if (!system.blocks_current)
    set_values(system.cover_blocks, system.op, system.terms, system.combination, system.contacts);
  system.blocks_current = true;
  return system.cover_blocks;
}

const Blocks& inverse_of(ConstrainedSystem& system, bool with_springs) {
  with_springs = with_springs && system.springs.any();
  if (system.inverse.extent(0) == 0 || system.inverse_knows_springs != with_springs) {
    find_diagonal(system);
    add_terms_diagonal(system.terms, system.inverse,
                       with_springs ? 0 : system.springs.points.count);
    add_terms_diagonal(system.contacts, system.inverse);
    invert_blocks(system.inverse);
  }
  system.inverse_knows_springs = with_springs;
  return system.inverse;
}

Real largest_motion(ConstrainedSystem& system, const Field& x, const Field& base) {
  if (system.masses.extent(0) == 0) system.masses = cover_masses(system.op);
  return largest_mean(system.op, system.masses, x, base, system.work.p, system.work.q);
}

}  // namespace rockfold::solve
