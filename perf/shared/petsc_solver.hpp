// PETSc's solvers on the very matrix of a rock, as a yardstick: only where CMake finds PETSc (Debian: petsc-dev).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold {

struct PetscResult {
  double seconds = 0;    ///< set-up of the preconditioner and solution; the matrix is there before
  double processor = 0;  ///< the same in time of the processor, s
  int iterations = 0;
  double residual = 0;  ///< ‖b − A x‖ / ‖b‖ as PETSc has it
};

/// Stiffness and springs of order-0 covers, assembled element by element, apart from our operator.
class PetscMatrix {
 public:
  PetscMatrix(const CoverArrays& covers, const PieceMoments& moments,
              const ElasticMaterial& material, const FixedPoints& fixed);
  ~PetscMatrix();
  PetscMatrix(const PetscMatrix&) = delete;
  PetscMatrix& operator=(const PetscMatrix&) = delete;

  std::vector<Vec3> apply(const std::vector<Vec3>& x) const;
  /// Conjugate gradients to ‖b − A x‖ ≤ tolerance · ‖b‖ from x = 0; `preconditioner` is PETSc's name: gamg (with the rigid motions
  /// as near null space), bjacobi (with ILU(0)), pbjacobi (3×3 blocks).
  PetscResult solve(const std::string& preconditioner, double tolerance, const std::vector<Vec3>& b,
                    std::vector<Vec3>& x) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace rockfold
