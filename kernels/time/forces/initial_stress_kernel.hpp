// The initial stress on the device.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/time/forces/initial_stress.hpp"
#include "kernels/time/motion.hpp"

namespace rockfold::motion {

using device::Array;

/// The initial stress where stresses are asked for. Empty: none.
struct StressBefore {
  Array<Real> cell_z, centroid_z;  ///< [elements] m
  Array<Real> law;  ///< [13] Pa at the reference, Pa a metre of depth, and the reference, m
  KOKKOS_INLINE_FUNCTION bool any() const { return law.extent(0) > 0; }
};
StressBefore make_stress_before(const MotionSetup& setup);

KOKKOS_INLINE_FUNCTION void add_stress_before(const StressBefore& before, Real z, Real* stress) {
  for (int k = 0; k < 6; ++k) stress[k] += before.law(k) + (before.law(12) - z) * before.law(6 + k);
}

}  // namespace rockfold::motion
