// Which lattice cells hold rock, and what each holds.
#pragma once

#include <algorithm>
#include <vector>

#include "host/cover/lattice/pieces.hpp"

namespace rockfold {

/// What a lattice cell holds: all of it (a regular one), or pieces and slivers.
struct CellContent {
  Index lattice_cell = none;
  Index regular = none;                    ///< into Pieces::regular
  Index piece_begin = 0, piece_end = 0;    ///< into Pieces::pieces
  Index sliver_begin = 0, sliver_end = 0;  ///< into Pieces::slivers
};

/// Where a cell of the complex stands in a part of a lattice cell: in a regular cell, or as a piece (several where joints
/// are prolonged through it), or as a sliver.
struct Holding {
  Index regular = none;
  Index piece_begin = 0, piece_end = 0;
  Index sliver = none;
  int part = 0;

  bool any() const { return regular != none || piece_begin < piece_end || sliver != none; }
};

class OccupiedCells {
 public:
  OccupiedCells(const Lattice& lattice, const Pieces& pieces);

  const std::vector<CellContent>& all() const { return cells_; }  ///< by lattice cell

  /// What a cell of the complex has of a part, slivers aside. O(log n)
  Holding find(Index lattice_cell, int part, Index rock) const;
  Holding find_in(const CellContent& cell, int part, Index rock) const;
  /// The same, or the sliver that it has there. O(log n)
  Holding find_any(Index lattice_cell, int part, Index rock) const;
  Holding find_any_in(const CellContent& cell, int part, Index rock) const;

  /// Calls visit(cell, next) for all occupied cells that are neighbours along an axis. O(n)
  template <class Visit>
  void visit_neighbours(int axis, Visit visit) const {
    const Index stride = axis == 0   ? 1
                         : axis == 1 ? lattice_.cells[0]
                                     : lattice_.cells[0] * lattice_.cells[1];
    std::size_t next = 0;
    for (const CellContent& c : cells_) {
      if (lattice_.cell_ijk(c.lattice_cell)[axis] + 1 == lattice_.cells[axis]) continue;
      const Index wanted = c.lattice_cell + stride;
      while (next < cells_.size() && cells_[next].lattice_cell < wanted) ++next;
      if (next == cells_.size()) return;
      if (cells_[next].lattice_cell == wanted) visit(c, cells_[next]);
    }
  }

  /// Calls visit(rock, holding) for each cell of the complex that has an area on a facet of a part.
  template <class Visit>
  void visit_open(const CellContent& cell, int part, int facet, Visit visit) const {
    if (cell.regular != none)
      return visit(pieces_.regular[cell.regular].rock, Holding{cell.regular, 0, 0, none, part});
    for (Index i = cell.piece_begin, end = i; i < cell.piece_end; i = end) {
      const PieceRecord& p = pieces_.pieces[i];
      bool open = false;
      for (; end < cell.piece_end && pieces_.pieces[end].part == p.part &&
             pieces_.pieces[end].rock == p.rock;
           ++end)
        open = open || (pieces_.pieces[end].open_facets >> facet & 1) != 0;
      if (p.part == part && open) visit(p.rock, Holding{none, i, end, none, part});
    }
    for (Index s = cell.sliver_begin; s < cell.sliver_end; ++s)
      if (const PieceRecord& p = pieces_.slivers[s].piece;
          p.part == part && (p.open_facets >> facet & 1) != 0)
        visit(p.rock, Holding{none, 0, 0, s, part});
  }

 private:
  Holding find_sliver(Index lattice_cell, int part, Index rock) const;

  const Lattice& lattice_;
  const Pieces& pieces_;
  std::vector<CellContent> cells_;
};

}  // namespace rockfold
