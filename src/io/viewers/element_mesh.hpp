// Manifold elements as tetrahedra that viewers draw, and the unknowns that move their corners.
#pragma once

#include <array>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// N tetrahedra over K points. A tetrahedron of a regular cell is one, a hexahedron six; a piece of a cut element is
/// fanned from its first vertex. Of two overlaid splits (tet5_mixed) the first is drawn. Corners at one place share a
/// point where they move alike, across pieces, elements and cells of one block and material, and never where physical covers part.
/// Displacement of point k = Σ_i weight[i] · d[unknown[i]], begin[k] ≤ i < begin[k+1].
struct ElementMesh {
  std::vector<std::array<Index, 4>> tetrahedron;  ///< [N] positive volume
  std::vector<Index> element;   ///< [N] as CoverArrays numbers elements, ascending
  std::vector<Index> block;     ///< [N]
  std::vector<Index> material;  ///< [N]
  std::vector<Vec3> point;      ///< [K] m
  std::vector<Index> begin{0};  ///< [K+1]
  std::vector<Index> unknown;   ///< < U
  std::vector<Real> weight;     ///< not 0; of order 0 they sum to 1 at a point

  std::size_t point_count() const { return begin.size() - 1; }
};

ElementMesh make_element_mesh(const CoverArrays& covers);

/// A field of the unknowns [U] at points, in single precision.
std::vector<std::array<float, 3>> interpolate(const ElementMesh& mesh,
                                              const std::vector<Vec3>& of_unknown);

}  // namespace rockfold
