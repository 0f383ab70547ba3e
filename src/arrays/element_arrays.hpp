// What integration makes of covers, and what the solver needs besides them. See cover_arrays.hpp for E, Q, R, P.
#pragma once

#include <array>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Linear isotropic elasticity and density of a material.
struct ElasticMaterial {
  Real density = 0;        ///< kg/m³
  Real young_modulus = 0;  ///< Pa
  Real poisson_ratio = 0;
};

/// Integrals over each convex piece, about the centre of its lattice cell.
/// Example: a cube of side 2 centred there: volume 8, first {0,0,0}; in a lattice of edges 4, local[4] = ∫ η_0² dV = 1/6.
struct PieceMoments {
  std::vector<Real> volume;  ///< [Q] ∫dV, m³
  std::vector<Vec3> first;   ///< [Q] ∫x_i dV, m⁴
  int degree = 0;            ///< of `local`
  /// [Q][(degree+1)(degree+2)(degree+3)/6] ∫ η^m dV, m³; η in units of the cell's edges, monomials as monomial_index has them
  std::vector<Real> local;
};

/// The motion of the physical covers (order 0: the displacement of each cover's node).
struct StateArrays {
  Real time = 0;                   ///< s
  std::vector<Vec3> displacement;  ///< [P] m
  std::vector<Vec3> velocity;      ///< [P] m/s
  std::vector<Vec3> acceleration;  ///< [P] m/s²
};

/// J; `contact` stays 0 until contact exists. dissipated = work done by loads − change of the others.
struct Energy {
  Real kinetic = 0, strain = 0, potential = 0, contact = 0, dissipated = 0;
};

}  // namespace rockfold
