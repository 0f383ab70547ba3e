#include "kernels/device/bandwidth.hpp"

#include <algorithm>

#include "kernels/device/device_kernel.hpp"
#include "src/base/error.hpp"
#include "src/base/timer.hpp"

namespace rockfold {

double measure_triad() {
  // Arrays larger than the last cache, together 768 MiB on cores and 3 GiB on a GPU: there are processors with 300 MiB and GPUs with 60.
  constexpr Index n = device::on_gpu ? 128 << 20 : 32 << 20;
  using device::Array;
  const Array<Real> a("rockfold::device::triad_a", n), b("rockfold::device::triad_b", n),
      c("rockfold::device::triad_c", n);
  Kokkos::deep_copy(b, 1.0);
  Kokkos::deep_copy(c, 2.0);
  double best = 0;
  for (int pass = 0; pass < 12; ++pass) {
    const Timer timer;
    device::for_each(
        "rockfold::device::triad", n, KOKKOS_LAMBDA(const Index i) { a(i) = b(i) + 3.0 * c(i); });
    Kokkos::fence();
    best = std::max(best, 24.0 * n / timer.seconds());
  }
  const Real worst = device::largest(
      "rockfold::device::check_triad", n,
      KOKKOS_LAMBDA(const Index i) { return device::math::fabs(a(i) - 7.0); });
  if (worst > 0) throw Error(ErrorKind::analysis, "the triad gave a wrong answer");
  return best;
}

}  // namespace rockfold
