// Convex polyhedra clipped in double, and the parts of a lattice as such: an oracle that shares nothing with host/.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold::test {

/// Faces with corners counter-clockwise seen from outside.
struct Polyhedron {
  std::vector<std::vector<Vec3>> face;

  bool empty() const { return face.size() < 4; }
  Real volume() const;
  std::vector<Vec3> corners() const;  ///< with repeats
};

/// The points with normal · x ≤ offset.
struct HalfSpace {
  Vec3 normal{};
  Real offset = 0;
};

Polyhedron part_of(const Lattice& lattice, Index cell, int part);

/// What lies inside; points within `slack` of the plane (m, of a unit normal) lie on it.
Polyhedron clip(const Polyhedron& polyhedron, const HalfSpace& inside, Real slack = 1e-11);
Polyhedron clip(Polyhedron polyhedron, const std::vector<HalfSpace>& inside);

}  // namespace rockfold::test
