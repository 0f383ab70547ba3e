// What explicit steps keep (explicit_kernel.hpp).
#pragma once

#include "kernels/device/device_kernel.hpp"

namespace rockfold::motion {

using device::Array;
using device::Field;

/// What holds a component of a block's motion: rows that do not depend on each other, combined such that C m⁻¹ Cᵀ = 1.
struct HeldRows {
  int functions = 1;
  Index sets = 0;        ///< (block, component)
  Array<Index> cover;    ///< [sets]
  Array<int> component;  ///< [sets]
  Array<Index> begin;    ///< [sets+1]
  Array<Index> point;    ///< [rows] of the springs' points
  Array<Real> combine;   ///< [rows][functions] of the set's points, in their order, lower triangle
  Array<Real> row;       ///< [rows][functions] C
  Array<Real> way;       ///< [rows][functions] m⁻¹ Cᵀ
  Array<Real> impulse;   ///< [rows] N s, of each point on the rock since the step began
  bool any() const { return sets > 0; }
};

struct ExplicitScheme {
  bool ready = false;  ///< for the stage: mass and held rows are there
  int functions = 1;
  Array<Real> mass;       ///< [P][n][n] kg, m of M = m ⊗ 1
  Array<Real> inverse;    ///< [P][n][n]; zero in functions that have no mass beside the others
  Array<Real> stiffness;  ///< [P][3n][3n] N/m, of the rock in place, index 3k + d
  Array<Real> turn;       ///< [P][9] how blocks have turned since
  Array<Real> slowed;     ///< [P][3n][3n] (M + θh²K)⁻¹ in place: strain takes inertia with it
  /// [P][3n][3n] P², P = (M + θh²K)⁻¹ θh²K: the share of a velocity that strain loses in a substep.
  Array<Real> damped;
  Array<Real> step;  ///< [P] s, the longest substep of each block
  HeldRows held;
  Field start;          ///< displacements at the start of the step
  Field pull;           ///< [points of supports] N s, of springs
  Array<Real> account;  ///< [2] J: friction, and work of the contact's forces
};

}  // namespace rockfold::motion
