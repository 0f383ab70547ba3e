// The largest natural frequency, by power iteration on M⁻¹ K: what conditionally stable schemes limit their steps by.
#include <cmath>

#include "kernels/constraints/policy_kernel.hpp"
#include "kernels/time/motion_kernel.hpp"

namespace rockfold {
namespace motion {
namespace {

/// The quotient grows from below; it has settled when it gains less than this share, or after so many iterations.
constexpr Real settled = 1e-4;
constexpr int most_iterations = 100;

/// Something of every mode.
void mixed_field(const Field& x) {
  device::for_each(
      "rockfold::motion::mixed_field", static_cast<Index>(x.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        unsigned word = static_cast<unsigned>(p) * 2654435761u + 1013904223u;
        for (int i = 0; i < 3; ++i) {
          word = word * 1664525u + 1013904223u;
          x(p, i) = static_cast<Real>(word >> 8) / (1 << 24) - 0.5;
        }
      });
}

void scale(const Field& x, Real factor) {
  device::for_each(
      "rockfold::motion::scale", static_cast<Index>(x.extent(0)), KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) x(p, i) *= factor;
      });
}

}  // namespace

Real largest_frequency(Motion::Data& m) {
  set_matrix(m, {0, 1}, 0, 0);
  if (!m.rock->linear()) m.rock->linearise(m.now.displacement);
  solve::Constraints& supports = m.system.constraints;
  const auto take_off_supports = [&](const Field& y) {
    Kokkos::deep_copy(supports.springs.multiplier, 0.0);
    solve::take_off_multipliers(supports, y);
  };
  const auto mass = [&](const Field& x, const Field& y) {
    m.rock->apply({0, 1}, x, y);
    take_off_supports(y);
  };
  const auto stiffness = [&](const Field& x, const Field& y) {
    m.rock->apply({1, 0}, x, y);
    solve::apply_springs(m.system.springs, m.system.springs.stiffness, 1, x, y);
    take_off_supports(y);
  };
  const solve::ApplyInverse blocks = solve::make_inverse(m.system, Preconditioner::block_jacobi);
  solve::PcgOptions how;
  how.tolerance = 1e-4;  // the quotient is exact for any x
  const Field x = device::make_field("motion::mode", m.unknowns);
  mixed_field(x);
  solve::hold_points(supports, x);
  Real square = 0;
  for (int k = 0; k < most_iterations; ++k) {
    stiffness(x, m.right);
    mass(x, m.work);
    const Real inertia = solve::dot(m.system.work, x, m.work);
    const Real found = solve::dot(m.system.work, x, m.right) / inertia;
    const bool done = std::abs(found - square) <= settled * found;
    square = found;
    if (done || !(found > 0)) break;
    scale(x, square);  // a first guess of M⁻¹ K x
    solve::solve_pcg(m.system.work, mass, blocks, m.right, x, how);
    scale(x, 1 / std::sqrt(solve::dot(m.system.work, x, x)));
  }
  return std::sqrt(square);
}

}  // namespace motion

Real Motion::largest_frequency() {
  return motion::largest_frequency(*data_);
}

}  // namespace rockfold
