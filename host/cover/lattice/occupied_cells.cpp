#include "host/cover/lattice/occupied_cells.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "host/cover/lattice/slivers.hpp"

namespace rockfold {

OccupiedCells::OccupiedCells(const Lattice& lattice, const Pieces& pieces)
    : lattice_(lattice), pieces_(pieces) {
  const auto regular_count = static_cast<Index>(pieces.regular.size()),
             piece_count = static_cast<Index>(pieces.pieces.size()),
             sliver_count = static_cast<Index>(pieces.slivers.size());
  constexpr Index beyond = std::numeric_limits<Index>::max();
  Index r = 0, p = 0, s = 0;
  while (r < regular_count || p < piece_count || s < sliver_count) {
    const Index regular = r < regular_count ? pieces.regular[r].lattice_cell : beyond;
    CellContent& c = cells_.emplace_back();
    c.lattice_cell = std::min({regular, p < piece_count ? pieces.pieces[p].lattice_cell : beyond,
                               s < sliver_count ? pieces.slivers[s].piece.lattice_cell : beyond});
    if (c.lattice_cell == regular) {
      c.regular = r++;
      continue;
    }
    c.piece_begin = p;
    while (p < piece_count && pieces.pieces[p].lattice_cell == c.lattice_cell) ++p;
    c.piece_end = p;
    c.sliver_begin = s;
    while (s < sliver_count && pieces.slivers[s].piece.lattice_cell == c.lattice_cell) ++s;
    c.sliver_end = s;
  }
}

Holding OccupiedCells::find(Index lattice_cell, int part, Index rock) const {
  const auto cell =
      std::lower_bound(cells_.begin(), cells_.end(), lattice_cell,
                       [](const CellContent& c, Index wanted) { return c.lattice_cell < wanted; });
  if (cell == cells_.end() || cell->lattice_cell != lattice_cell) return {};
  return find_in(*cell, part, rock);
}

Holding OccupiedCells::find_in(const CellContent& cell, int part, Index rock) const {
  if (cell.regular != none) {
    if (pieces_.regular[cell.regular].rock != rock) return {};
    return {cell.regular, 0, 0, none, part};
  }
  const auto begin = pieces_.pieces.begin() + cell.piece_begin,
             end = pieces_.pieces.begin() + cell.piece_end;
  const auto first = std::lower_bound(begin, end, std::pair{part, rock},
                                      [](const PieceRecord& p, const std::pair<int, Index>& key) {
                                        return std::pair{p.part, p.rock} < key;
                                      });
  auto last = first;
  while (last != end && last->part == part && last->rock == rock) ++last;
  if (first == last) return {};
  return {none, static_cast<Index>(first - pieces_.pieces.begin()),
          static_cast<Index>(last - pieces_.pieces.begin()), none, part};
}

Holding OccupiedCells::find_any(Index lattice_cell, int part, Index rock) const {
  const Holding found = find(lattice_cell, part, rock);
  return found.any() ? found : find_sliver(lattice_cell, part, rock);
}

Holding OccupiedCells::find_any_in(const CellContent& cell, int part, Index rock) const {
  const Holding found = find_in(cell, part, rock);
  return found.any() ? found : find_sliver(cell.lattice_cell, part, rock);
}

Holding OccupiedCells::find_sliver(Index lattice_cell, int part, Index rock) const {
  const Sliver* sliver = rockfold::find_sliver(pieces_.slivers, lattice_cell, part, rock);
  if (sliver == nullptr) return {};
  return {none, 0, 0, static_cast<Index>(sliver - pieces_.slivers.data()), part};
}

}  // namespace rockfold
