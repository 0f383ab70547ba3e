// Coarser and coarser covers of the same rock, from its topology alone: lattices of doubled spacing whose covers are cut as the
// rock is. Two elements are one coarse element if they lie in the same coarse cell and share a cover; the coarse covers of one
// coarse node that meet in a cover of the finer level are one. What a joint separates so stays separate on every level, and
// where there is none this is the lattice of doubled spacing. Cells that overhang an odd lattice are cells like any other.
//
// A cover of the finer level at node X takes Σ_A N_A(X) d_A, N_A trilinear on the coarse lattice: each A stands for the one coarse
// cover there that the finer cover's elements belong to, so that the interpolation is the same seen from any of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold::solve {

/// A place on the lattice of a level, in half edges of its cells from node (0, 0, 0).
using HalfPlace = std::array<Index, 3>;

struct CoarseCovers {
  std::vector<HalfPlace> place;  ///< [C] of each cover, all even; ascending in z, then y, then x

  // interpolation to the P covers of the next finer level
  std::vector<Index> parent_begin;  ///< [P+1]
  std::vector<Index> parent;        ///< coarse covers, 1 … 8 a finer cover
  std::vector<float> weight;        ///< N_A there; sums to 1

  // which covers share an element
  std::vector<Index> column_begin;  ///< [C+1]
  std::vector<Index> column;        ///< ascending, each cover's own among them

  Index count() const { return static_cast<Index>(place.size()); }
};

/// The places of the covers on their lattice; empty for kind `block`, which has none.
std::vector<HalfPlace> half_places(const CoverArrays& covers);

/// One level at least, and further ones until no connected part has more than `small` covers or a level would save less than a
/// tenth. Empty where the lattice is of kind `block`. Linear in covers and elements.
std::vector<CoarseCovers> coarsen_covers(const CoverArrays& covers, Index small);

/// Covers in the largest part connected by `column`.
Index largest_part(const CoarseCovers& covers);

/// [C] the smallest cover connected with each.
std::vector<Index> connected_parts(const CoarseCovers& covers);

}  // namespace rockfold::solve
