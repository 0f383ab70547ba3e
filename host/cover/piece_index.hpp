// Which part of the cutting each regular lattice cell and each piece is: host-side companion of CoverArrays.
#pragma once

#include <array>
#include <vector>

#include "host/cover/lattice_planes.hpp"
#include "host/exact/plane_table.hpp"
#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

struct PieceIndex {
  PieceIndex(PlaneTable table, LatticePlanes lattice_planes)
      : planes(std::move(table)), lattice(std::move(lattice_planes)) {}

  PlaneTable planes;  ///< of the cutting, and of the lattice
  LatticePlanes lattice;
  std::vector<Index> regular_rock;  ///< [R] cell of the complex that holds the regular lattice cell
  std::vector<Index> piece_rock;    ///< [Q] cell of the complex that the piece is part of
  std::vector<Index> piece_element;  ///< [Q] cut element

  /// The regular lattice cell with this linear index, or none. O(log R)
  static Index find_regular(const CoverArrays& covers, Index lattice_cell);
  /// The piece of a cell of the complex in a part of a lattice cell, or none. O(log E)
  Index find_piece(const CoverArrays& covers, Index lattice_cell, int part, Index rock) const;
};

}  // namespace rockfold
