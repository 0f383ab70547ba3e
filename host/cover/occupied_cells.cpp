#include "host/cover/occupied_cells.hpp"

#include <tuple>

#include "host/cover/slivers.hpp"

namespace rockfold {

OccupiedCells::OccupiedCells(const Lattice& lattice, const Pieces& pieces)
    : lattice_(lattice), pieces_(pieces) {
  const auto regular_count = static_cast<Index>(pieces.regular.size()),
             piece_count = static_cast<Index>(pieces.pieces.size());
  Index r = 0, p = 0;
  while (r < regular_count || p < piece_count) {
    CellContent& c = cells_.emplace_back();
    if (p == piece_count ||
        (r < regular_count && pieces.regular[r].lattice_cell < pieces.pieces[p].lattice_cell)) {
      c.lattice_cell = pieces.regular[r].lattice_cell;
      c.regular = r++;
      continue;
    }
    c.lattice_cell = pieces.pieces[p].lattice_cell;
    c.piece_begin = p;
    while (p < piece_count && pieces.pieces[p].lattice_cell == c.lattice_cell) ++p;
    c.piece_end = p;
  }
}

Holding OccupiedCells::find(Index lattice_cell, int part, Index rock) const {
  const auto cell =
      std::lower_bound(cells_.begin(), cells_.end(), lattice_cell,
                       [](const CellContent& c, Index wanted) { return c.lattice_cell < wanted; });
  if (cell == cells_.end() || cell->lattice_cell != lattice_cell) return {};
  return find_in(*cell, part, rock);
}

Holding OccupiedCells::find_owner(Index lattice_cell, int part, Index rock) const {
  const Sliver* sliver = find_sliver(pieces_.slivers, lattice_cell, part, rock);
  if (sliver == nullptr) return {};
  return find(sliver->owner.lattice_cell, sliver->owner.part, sliver->owner.rock);
}

Holding OccupiedCells::find_in(const CellContent& cell, int part, Index rock) const {
  if (cell.regular != none) {
    if (pieces_.regular[cell.regular].rock != rock) return {};
    return {cell.regular, 0, 0, part};
  }
  const auto begin = pieces_.pieces.begin() + cell.piece_begin,
             end = pieces_.pieces.begin() + cell.piece_end;
  const auto first = std::lower_bound(begin, end, std::pair{part, rock},
                                      [](const PieceRecord& p, const std::pair<int, Index>& key) {
                                        return std::pair{p.part, p.rock} < key;
                                      });
  auto last = first;
  while (last != end && last->part == part && last->rock == rock) ++last;
  return {none, static_cast<Index>(first - pieces_.pieces.begin()),
          static_cast<Index>(last - pieces_.pieces.begin()), part};
}

}  // namespace rockfold
