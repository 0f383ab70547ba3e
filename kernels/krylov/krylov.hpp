// The Krylov methods for a matrix that is given by its products alone, over vectors on the host: what programs without Kokkos see of them.
#pragma once

#include <functional>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// y = A x, [U] each.
using HostApply = std::function<void(const std::vector<Vec3>& x, std::vector<Vec3>& y)>;

struct KrylovReport {
  Index iterations = 0;
  Real residual = 0;  ///< true ‖b − A x‖ / ‖b‖; NaN where the method broke down
  bool converged = false;
};

enum class KrylovMethod {
  conjugate_gradients,  ///< A symmetric and positive
  bicgstab,             ///< any regular A
};

/// A x = b from the x given, to ‖b − A x‖ ≤ tolerance ‖b‖. `b_inverse`: z = B r with B ≈ A⁻¹ (symmetric and positive for conjugate
/// gradients); empty: B = 1.
KrylovReport solve_krylov(KrylovMethod method, const HostApply& a, const HostApply& b_inverse,
                          const std::vector<Vec3>& b, std::vector<Vec3>& x, Real tolerance,
                          Index max_iterations);

}  // namespace rockfold
