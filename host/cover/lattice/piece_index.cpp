#include "host/cover/lattice/piece_index.hpp"

#include <algorithm>

#include "src/base/vector.hpp"

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
  const IndexRange elements = elements_of_cell(covers, lattice_cell);
  for (Index e = elements.begin; e < elements.end; ++e) {
    if (covers.element_part[e] != part) continue;
    const auto [first, last] = std::equal_range(piece_rock.begin() + covers.piece_begin[e],
                                                piece_rock.begin() + sliver_begin[e], rock);
    for (auto q = first; q != last; ++q)
      pieces.push_back(static_cast<Index>(q - piece_rock.begin()));
  }
  const PieceKey key{lattice_cell, part, rock};
  const auto sliver = std::lower_bound(slivers.begin(), slivers.end(), std::pair{key, Index{0}});
  if (pieces.empty() && sliver != slivers.end() && sliver->first == key)
    pieces.push_back(sliver->second);
  return pieces;
}

const PieceKey* PieceIndex::owner_of_left_out(const PieceKey& sliver) const {
  const auto found =
      std::lower_bound(left_out.begin(), left_out.end(), sliver,
                       [](const auto& entry, const PieceKey& key) { return entry.first < key; });
  return found != left_out.end() && found->first == sliver ? &found->second : nullptr;
}

void PieceIndex::build_piece_tree(const CoverArrays& covers) {
  std::vector<Bounds> boxes;
  boxes.reserve(covers.piece_block.size());
  const Real slack = point_slack();
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const Vec3 centre = covers.lattice.cell_centre(covers.element_cell[e]);
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
      Box box;
      for (Index v = covers.vertex_begin[q]; v < covers.vertex_begin[q + 1]; ++v)
        box.add(centre + Vec3{covers.vertex_xyz[3 * v], covers.vertex_xyz[3 * v + 1],
                              covers.vertex_xyz[3 * v + 2]});
      const Vec3 beyond{slack, slack, slack};
      boxes.push_back({box.low - beyond, box.high + beyond});
    }
  }
  piece_tree = BoxTree(std::move(boxes));
}

IndexRange elements_of_cell(const CoverArrays& covers, Index lattice_cell) {
  const auto begin = covers.element_cell.begin();
  const auto [first, last] = std::equal_range(begin, covers.element_cell.end(), lattice_cell);
  return {static_cast<Index>(first - begin), static_cast<Index>(last - begin)};
}

}  // namespace rockfold
