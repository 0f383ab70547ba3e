// What integration makes of covers, and what the solver needs besides them. See cover_arrays.hpp for E, Q, R, P.
#pragma once

#include <array>
#include <cstdint>
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
  /// The same integrals about a point amid the cut element that the piece belongs to, for degrees above 2: of a sliver in a
  /// corner of its cell, where functions and their slopes nearly vanish, they lose no digits.
  std::vector<Real> amid;    ///< [Q][…]
  std::vector<Vec3> origin;  ///< [E cut] η of that point
};

/// What speeds conjugate gradients up. `automatic` chooses by size: see docs/user_guide.md, [solver].
enum class Preconditioner : std::uint8_t {
  automatic,
  block_jacobi,       ///< the 3×3 blocks of each cover function
  node_block_jacobi,  ///< one block for each lattice node
  multigrid,          ///< over lattices of doubled spacing that are cut as the rock is
  direct              ///< the factors of the matrix
};

/// The motion of the physical covers, in the order of unknowns (order 0: of each cover's node).
struct StateArrays {
  Real time = 0;                   ///< s
  std::vector<Vec3> displacement;  ///< [U] m
  std::vector<Vec3> velocity;      ///< [U] m/s
  std::vector<Vec3> acceleration;  ///< [U] m/s²
};

/// J. What loads have done since the start is either still there or dissipated:
///   kinetic + strain + potential + contact + dissipated = what the motion began with + loads + supports.
struct Energy {
  Real kinetic = 0;
  Real strain = 0;      ///< from the initial stress on: that is the zero
  Real potential = 0;   ///< of gravity and of constant loads, 0 in place
  Real contact = 0;     ///< stored in joints
  Real dissipated = 0;  ///< all that follow, to `numerical`

  Real damping = 0;    ///< by Rayleigh damping
  Real quiet = 0;      ///< carried away through quiet boundaries
  Real ratio = 0;      ///< taken by the dynamic ratio
  Real friction = 0;   ///< of joints: by slip and broken bonds
  Real impact = 0;     ///< of joints: by what closes, or lets go, within a step
  Real numerical = 0;  ///< by the scheme itself: rounding alone for average acceleration

  Real bolts = 0;  ///< done on bolts and other support: what they store and have taken

  Real excavated =
      0;  ///< what rock had when it was excavated on the way, and what was stored in its joints

  Real loads = 0;     ///< work of loads that change in time and of the accelerated base
  Real supports = 0;  ///< work of fixed points on the rock
};

}  // namespace rockfold
