// What conjugate gradients work with.
#pragma once

#include <functional>

#include "kernels/device/device_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"

namespace rockfold::solve {

using device::Array;
using device::Field;

/// y = A x, A symmetric and positive semi-definite.
using Apply = std::function<void(const Field& x, const Field& y)>;

/// The vectors that a solve needs; allocated once.
struct PcgWork {
  Field r, p;
  Field q;              ///< A p; needed no more while a residual is preconditioned
  Field z;              ///< empty until a solve without multigrid needs it
  Array<Real> partial;  ///< sums of chunks
  Array<Real> scalar;   ///< see pcg.cpp
  decltype(Kokkos::create_mirror_view(Array<Real>())) host_scalar;
};
PcgWork make_pcg_work(Index covers);

/// Σ x·y, the same for any number of threads.
Real dot(const PcgWork& work, const Field& x, const Field& y);

}  // namespace rockfold::solve
