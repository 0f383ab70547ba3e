// What Krylov methods work with, and the two maps that they are made of.
#pragma once

#include <functional>

#include "kernels/device/device_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"

namespace rockfold::solve {

using device::Array;
using device::Field;

/// y = A x.
using Apply = std::function<void(const Field& x, const Field& y)>;

/// z = B r with B ≈ A⁻¹, symmetric and positive, and energy(0) = r·z on the device.
using ApplyInverse = std::function<void(const Field& r, const Field& z, const Array<Real>& energy)>;

/// The vectors that a solve needs; allocated once.
struct KrylovWork {
  Field r, p;
  Field q;              ///< A p; needed no more while a residual is preconditioned
  Field z;              ///< B r
  Field before;         ///< x before the last search
  Array<Real> partial;  ///< sums of chunks
  Array<Real> energy;   ///< r·z
  Array<Real> scalar;   ///< see pcg.cpp
  decltype(Kokkos::create_mirror_view(Array<Real>())) host_scalar;
};
KrylovWork make_krylov_work(Index unknowns);

/// Σ x·y, the same for any number of threads.
Real dot(const KrylovWork& work, const Field& x, const Field& y);

/// to(0) = Σ x·y, on the device.
void dot_on_device(const KrylovWork& work, const Field& x, const Field& y, const Array<Real>& to);

}  // namespace rockfold::solve
