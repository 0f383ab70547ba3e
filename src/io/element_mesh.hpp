// Manifold elements as tetrahedra that viewers draw, and the covers that move their corners.
#pragma once

#include <array>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// N tetrahedra over K points. A tetrahedron of a regular cell is one; a piece of a cut element is
/// fanned from its first vertex. Corners at one place share a point where they move alike, across
/// pieces, elements and cells, and never where physical covers part.
/// Displacement of point k = Σ_a weight[k][a] · d[cover[k][a]].
struct ElementMesh {
  std::vector<std::array<Index, 4>> tetrahedron;  ///< [N] positive volume
  std::vector<Index> element;               ///< [N] as CoverArrays numbers elements, ascending
  std::vector<Index> block;                 ///< [N]
  std::vector<Index> material;              ///< [N]
  std::vector<Vec3> point;                  ///< [K] m
  std::vector<std::array<Index, 4>> cover;  ///< [K]
  std::vector<std::array<Real, 4>> weight;  ///< [K] sums to 1
};

ElementMesh make_element_mesh(const CoverArrays& covers);

/// Weights of the four corners of lattice tetrahedron `tet` (row of tet6_corner) at a place in its
/// cell, given relative to the cell's centre, m.
class TetrahedronWeights {
 public:
  explicit TetrahedronWeights(const Lattice& lattice);
  std::array<Real, 4> operator()(int tet, const Vec3& from_centre) const;

 private:
  Mat3 to_cell_;  ///< metres to lattice edges
};

/// A field of the covers at points, in single precision.
std::vector<std::array<float, 3>> interpolate(const ElementMesh& mesh,
                                              const std::vector<Vec3>& of_cover);

}  // namespace rockfold
