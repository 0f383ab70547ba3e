#include "kernels/krylov/krylov.hpp"

#include "kernels/krylov/bicgstab_kernel.hpp"

namespace rockfold {

using device::Field;

KrylovReport solve_krylov(KrylovMethod method, const HostApply& a, const HostApply& b_inverse,
                          const std::vector<Vec3>& b, std::vector<Vec3>& x, Real tolerance,
                          Index max_iterations) {
  const Index unknowns = static_cast<Index>(b.size());
  const auto on_host = [](const HostApply& map, const Field& from, const Field& to) {
    std::vector<Vec3> result(to.extent(0));
    map(device::copy_to_host(from), result);
    device::copy_to_device(result, to);
  };
  const solve::KrylovWork work = solve::make_krylov_work(unknowns);
  const solve::Apply apply = [&](const Field& u, const Field& v) { on_host(a, u, v); };
  const solve::ApplyInverse inverse = [&](const Field& r, const Field& z,
                                          const device::Array<Real>& energy) {
    if (b_inverse)
      on_host(b_inverse, r, z);
    else
      Kokkos::deep_copy(z, r);
    solve::dot_on_device(work, r, z, energy);
  };
  const Field load = device::make_field("solve::krylov_b", unknowns),
              answer = device::make_field("solve::krylov_x", unknowns);
  device::copy_to_device(b, load);
  device::copy_to_device(x, answer);
  solve::PcgOptions options;
  options.tolerance = tolerance;
  options.max_iterations = max_iterations;
  const solve::PcgReport done =
      method == KrylovMethod::bicgstab
          ? solve::solve_bicgstab(work, solve::make_bicgstab_work(unknowns), apply, inverse, load,
                                  answer, options)
          : solve::solve_pcg(work, apply, inverse, load, answer, options);
  x = device::copy_to_host(answer);
  return {done.iterations, done.residual, done.converged};
}

}  // namespace rockfold
