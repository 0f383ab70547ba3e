#include "host/cover/piece_index.hpp"

#include <algorithm>

namespace rockfold {

Index PieceIndex::find_regular(const CoverArrays& covers, Index lattice_cell) {
  const auto it =
      std::lower_bound(covers.regular_cell.begin(), covers.regular_cell.end(), lattice_cell);
  return it != covers.regular_cell.end() && *it == lattice_cell
             ? static_cast<Index>(it - covers.regular_cell.begin())
             : none;
}

std::vector<Index> PieceIndex::find_pieces(const CoverArrays& covers, Index lattice_cell, int part,
                                           Index rock) const {
  std::vector<Index> pieces;
  const auto first =
      std::lower_bound(covers.element_cell.begin(), covers.element_cell.end(), lattice_cell);
  for (auto e = static_cast<Index>(first - covers.element_cell.begin());
       e < covers.cut_count() && covers.element_cell[e] == lattice_cell; ++e) {
    if (covers.element_part[e] != part) continue;
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      if (piece_rock[q] == rock) pieces.push_back(q);
  }
  const PieceKey key{lattice_cell, part, rock};
  const auto sliver = std::lower_bound(slivers.begin(), slivers.end(), std::pair{key, Index{0}});
  if (pieces.empty() && sliver != slivers.end() && sliver->first == key)
    pieces.push_back(sliver->second);
  return pieces;
}

}  // namespace rockfold
