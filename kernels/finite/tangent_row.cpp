#include "kernels/finite/tangent_row_kernel.hpp"
#include "src/base/simd_versions.hpp"

namespace rockfold::finite {

ROCKFOLD_SIMD_VERSIONS
void add_products_on_core(int points, const Real* term, const Real* gradient, int width,
                          Real* row) {
  add_products(points, term, gradient, width, row);
}

}  // namespace rockfold::finite
