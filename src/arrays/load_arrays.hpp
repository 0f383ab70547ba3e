// What acts on the rock from outside, as flat arrays: the contract between host/cover (which finds where) and kernels/
// (which apply it). Fixed points are in cover_arrays.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/time_table.hpp"

namespace rockfold {

/// Forces at L points of the material: point loads, and tractions as points that carry a share of their face's area (exact for
/// tractions times the functions of the elements).
struct LoadPoints {
  MaterialPoints points;     ///< [L]
  std::vector<Vec3> force;   ///< [L] N, fixed in space; at points with a table: unused
  std::vector<Index> table;  ///< [L] into `tables`, or none
  std::vector<Real>
      scale;  ///< [L] force at time t = scale · table(t): 1 for point loads (N), m² for tractions (Pa)
  std::vector<Vec3>
      area;  ///< [L] m², outward area vector of what a following pressure acts on; 0 elsewhere
  std::vector<Real>
      pressure;  ///< [L] Pa along the inward normal, which follows the face; with a table: its x component · pressure
  std::vector<Index>
      side;  ///< [L] of a joint, on which water presses as far as the other side lies before it; empty: none
  std::vector<TimeTable> tables;
};

/// Dashpots on faces that waves leave through (Lysmer & Kuhlemeyer 1969): traction −ρ c_p (v·n) n − ρ c_s (v − (v·n) n).
struct QuietPoints {
  MaterialPoints points;             ///< [D]
  std::vector<Vec3> normal;          ///< [D] unit, outward
  std::vector<Real> normal_damping;  ///< [D] N·s/m = ρ c_p · area
  std::vector<Real> shear_damping;   ///< [D] N·s/m = ρ c_s · area
};

/// In-situ stress before anything moves: at + (reference_z − z) · gradient, xx yy zz xy yz zx, tension positive.
struct InitialStress {
  std::array<Real, 6> at{};        ///< Pa at reference_z
  std::array<Real, 6> gradient{};  ///< Pa a metre of depth
  Real reference_z = 0;            ///< m
  bool any = false;
};

/// Rock that is excavated on the way, by all that goes with it: 1 where it is gone.
struct GoneRock {
  std::vector<std::uint8_t> block;    ///< [B]
  std::vector<std::uint8_t> cover;    ///< [covers]
  std::vector<std::uint8_t> element;  ///< [elements] in the numbering of CoverArrays
};

/// A rigid motion given to blocks at t = 0, about their common mass centre.
struct RigidVelocity {
  std::vector<Index> blocks;  ///< from 0, ascending
  Vec3 velocity{};            ///< m/s, of the mass centre
  Vec3 angular_velocity{};    ///< rad/s about it
};

}  // namespace rockfold
