// The operator's rows, sorted by kind. A row is one physical cover with its three unknowns.
//
//   stencil row  a cover whose eight lattice cells are all regular and of one material: its couplings are constants of the
//                lattice. Consecutive ones whose neighbours are consecutive too form a run: 64 bytes for hundreds of rows.
//   block row    any other cover: its couplings are stored, one 3×3 block of stiffness and one number of mass for each
//                neighbour, in slices of rows of nearly equal length ("SELL") so that a slice's rows run side by side.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold::solve {

/// Half of the 14 neighbours of a node in tet6: those with opposite offsets follow by symmetry.
inline constexpr int half_neighbours = 7;
using Offset = std::array<int, 3>;
/// Lexicographically positive offsets (i, j, k) along tetrahedron edges.
std::array<Offset, half_neighbours> stencil_offsets();

/// Whether corners a and b of a lattice cell share a tetrahedron.
bool corners_couple(int a, int b);

struct StencilRuns {
  /// No longer: a run's rows stay in the first-level cache while the neighbours are added one after the other.
  static constexpr Index max_length = 256;

  std::vector<Index> first;      ///< [N] first cover of each run
  std::vector<Index> length;     ///< [N]
  std::vector<Index> material;   ///< [N]
  std::vector<Index> neighbour;  ///< [N][7][2] first cover's neighbour at + and − each offset

  Index count() const { return static_cast<Index>(first.size()); }
};

/// What is integrated into a row: corner `c` of regular cell r is 8·r + c; corner a of cut element e is −1 − (4·e + a).
using Source = std::int64_t;

struct BlockRows {
  int lanes = 1;           ///< rows of a slice
  std::vector<Index> row;  ///< [S·lanes] cover of each lane, none where a slice is not full
  std::vector<Index>
      slice_begin;  ///< [S+1] first column of each slice, in units of `lanes` entries
  std::vector<Index>
      column;  ///< [slice_begin[S]][lanes] neighbouring cover; the row's own where a row is shorter
  std::vector<Index> source_begin;  ///< [S·lanes+1]
  std::vector<Source> source;       ///< regular cells first, ascending; then elements, ascending

  Index slice_count() const { return static_cast<Index>(slice_begin.size()) - 1; }
};

struct Rows {
  StencilRuns stencil;
  BlockRows block;
  Index stencil_rows = 0, block_rows = 0;
  std::int64_t block_entries = 0;  ///< neighbours stored, without padding
};

/// Linear in the number of covers, cells and elements.
/// `stencils`: regular surroundings as stencil rows; otherwise every row is a block row.
Rows sort_rows(const CoverArrays& covers, int lanes, bool stencils = true);

}  // namespace rockfold::solve
