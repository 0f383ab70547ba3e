#include "kernels/operator/rock_motion_kernel.hpp"
#include "kernels/operator/springs_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Of the largest mass: rock of smaller covers is nothing but specks beside that of others.
constexpr Real least_share = 1e-3;

}  // namespace

Array<Real> cover_masses(const Operator& op) {
  const Field one = device::make_field("solve::one", op.unknowns),
              momentum = device::make_field("solve::momentum", op.unknowns);
  const Index covers = op.covers;
  device::for_each(
      "rockfold::solve::move_rock", op.unknowns,
      KOKKOS_LAMBDA(const Index u) { one(u, 0) = u < covers ? 1 : 0; });
  apply(op, {0, 1}, one, momentum);
  auto masses = device::allocate<Real>("solve::cover_masses", covers);
  device::for_each(
      "rockfold::solve::cover_masses", covers,
      KOKKOS_LAMBDA(const Index p) { masses(p) = momentum(p, 0); });
  return masses;
}

Real largest_mean(const Operator& op, const Array<Real>& masses, const Field& x, const Field& base,
                  const Field& sum, const Field& momentum) {
  Field motion = x;
  if (base.extent(0) > 0) {
    device::for_each(
        "rockfold::solve::add_base", op.unknowns, KOKKOS_LAMBDA(const Index u) {
          for (int d = 0; d < 3; ++d) sum(u, d) = base(u, d) + x(u, d);
        });
    motion = sum;
  }
  const Real most_mass = device::largest(
      "rockfold::solve::largest_mass", op.covers,
      KOKKOS_LAMBDA(const Index p) { return masses(p); });
  if (!(most_mass > 0)) return largest_entry(motion);  // rock without density
  apply(op, {0, 1}, motion, momentum);
  const Real least = least_share * most_mass;
  return device::largest(
      "rockfold::solve::largest_mean", op.covers, KOKKOS_LAMBDA(const Index p) {
        if (!(masses(p) > least)) return 0.0;
        Real most = 0;
        for (int d = 0; d < 3; ++d)
          most = device::math::fmax(most, device::math::fabs(momentum(p, d)));
        return most / masses(p);
      });
}

}  // namespace rockfold::solve
