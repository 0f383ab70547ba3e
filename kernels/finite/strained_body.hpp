// A rock under finite strain on its own, without time: forces, energy and stress of given displacements.
//
// Table of contents:
//   quadrature.hpp          points and weights that integrate polynomials over elements of any shape
//   strain_kernel.hpp       strain and stress at a point
//   deformation_kernel.hpp  all elements on the device: forces, stiffness, energy
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/arrays/load_arrays.hpp"

namespace rockfold {

class StrainedBody {
 public:
  /// Throws Error(analysis) where a piece is inside out.
  StrainedBody(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials,
               const InitialStress& initial = {});
  ~StrainedBody();
  StrainedBody(StrainedBody&&) noexcept;
  StrainedBody& operator=(StrainedBody&&) noexcept;

  /// The displacement now, [U] m.
  void deform(const std::vector<Vec3>& displacement);
  /// The step's start is where the body is now.
  void keep();

  /// [U] N, at the end of the step or by the energy–momentum rule; `viscosity`: β of Rayleigh damping over the step's length.
  std::vector<Vec3> forces(bool middle = false, Real viscosity = 0) const;
  Real strain_energy() const;                               ///< J
  std::vector<std::array<Real, 6>> element_stress() const;  ///< Pa, Cauchy, mean of each element
  Real volume() const;                                      ///< m³, before the deformation

  struct Data;

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace rockfold
