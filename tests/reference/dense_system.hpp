// Stiffness and mass of covers as plain dense matrices, assembled the textbook way: K = ∫ C ∇φ ∇φ with the tensor of elasticity, M = ∫ ρ φ φ, both
// by Gauss points in tetrahedra that fill the elements. An oracle for the operator; slow and short.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold::reference {

/// A square matrix over 3·U degrees of freedom, 3·unknown + d.
struct Dense {
  std::size_t n = 0;
  std::vector<Real> entry;  ///< [n][n]

  explicit Dense(std::size_t size = 0) : n(size), entry(size * size, 0.0) {}
  Real& operator()(std::size_t i, std::size_t j) { return entry[i * n + j]; }
  Real operator()(std::size_t i, std::size_t j) const { return entry[i * n + j]; }
};

Dense assemble_stiffness(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials);
Dense assemble_mass(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials);
/// Σ k N Nᵀ.
Dense assemble_springs(const CoverArrays& covers, const FixedPoints& fixed);

/// Of a symmetric matrix, ascending (Jacobi's rotations).
std::vector<Real> eigenvalues(Dense a);

Dense combine(Real a, const Dense& x, Real b, const Dense& y);
std::vector<Vec3> multiply(const Dense& a, const std::vector<Vec3>& x);
/// Solves a symmetric positive definite system (Cholesky).
std::vector<Vec3> solve(Dense a, const std::vector<Vec3>& b);

/// Numbers without pattern, −1 … 1, the same everywhere.
std::vector<Vec3> scattered(std::size_t count, unsigned seed);

Real largest(const std::vector<Vec3>& x);
Real largest_difference(const std::vector<Vec3>& x, const std::vector<Vec3>& y);

}  // namespace rockfold::reference
