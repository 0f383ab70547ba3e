// Which part of the cutting each regular lattice cell and each piece is: host-side companion of CoverArrays.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "host/box_tree.hpp"
#include "host/cover/lattice/lattice_planes.hpp"
#include "host/cover/lattice/pieces.hpp"
#include "host/cut/cells/complex.hpp"
#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

struct PieceIndex {
  PieceIndex(PlaneTable all_planes, LatticePlanes lattice_planes)
      : planes(std::move(all_planes)), lattice(std::move(lattice_planes)) {}

  PlaneTable planes;  ///< of the cutting, and of the lattice
  std::shared_ptr<const Complex> complex;
  LatticePlanes lattice;
  std::vector<Index> regular_rock;  ///< [R] cell of the complex that holds the regular lattice cell
  std::vector<Index> piece_rock;    ///< [Q] cell of the complex that the piece is part of
  std::vector<Index> piece_element;      ///< [Q] cut element
  std::vector<std::int64_t> face_begin;  ///< [Q + 1] into face_inside
  std::vector<HalfSpaceId> face_inside;  ///< of each face of each piece, the side that holds it
  std::vector<Index> sliver_begin;       ///< [E] pieces of each element from here on are slivers
  std::vector<std::pair<PieceKey, Index>> slivers;  ///< where each sliver is, and its piece; sorted
  std::vector<std::pair<PieceKey, PieceKey>>
      left_out;  ///< slivers that are no pieces (Sliver::left_out), and their owners; sorted
  std::vector<std::vector<HalfSpaceId>>
      piece_cuts;      ///< [Q] PieceRecord::cuts; empty if no joint is prolonged
  BoxTree piece_tree;  ///< [Q] m, about the pieces and point_slack() beyond; kind `block` only

  /// m, how far outside of rock a point may lie: 1e-9 of the model's size, far above rounding, far below any block.
  Real point_slack() const { return 1e-9 * planes.model_size(); }

  /// The regular lattice cell with this linear index, or none. O(log R)
  static Index find_regular(const CoverArrays& covers, Index lattice_cell);
  /// The pieces of a cell of the complex in a part of a lattice cell: several where joints are prolonged. O(log Q)
  std::vector<Index> find_pieces(const CoverArrays& covers, Index lattice_cell, int part,
                                 Index rock) const;
  /// Calls visit(piece, part) for the slivers that lie in a lattice cell. O(log n + found)
  template <class Visit>
  void visit_slivers(Index lattice_cell, Visit visit) const {
    const std::pair first{PieceKey{lattice_cell, 0, 0}, Index{0}};
    for (auto s = std::lower_bound(slivers.begin(), slivers.end(), first);
         s != slivers.end() && s->first.lattice_cell == lattice_cell; ++s)
      visit(s->second, s->first.part);
  }
  /// What owns a sliver that is no piece, or null. O(log n)
  const PieceKey* owner_of_left_out(const PieceKey& sliver) const;
  /// Fills `piece_tree`. O(Q log Q)
  void build_piece_tree(const CoverArrays& covers);
};

/// A range of indices, [begin, end).
struct IndexRange {
  Index begin = 0, end = 0;
};
/// The cut elements of a lattice cell; of kind `block`, of a block. O(log E)
IndexRange elements_of_cell(const CoverArrays& covers, Index lattice_cell);

}  // namespace rockfold
