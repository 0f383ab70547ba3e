// Which blocks each face leans on: BlockArrays::interfaces, found by face instead of by block.
#pragma once

#include <span>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Example: two cubes one on the other have 12 faces and one interface; two faces have one neighbour
/// each: neighbour_begin_ has 13 entries from 0 to 2, neighbour_ has 2.
class FaceInterfaces {
 public:
  explicit FaceInterfaces(const BlockArrays& blocks);

  struct Neighbour {
    Index block = none;  ///< the neighbour
    Index face = none;   ///< its face
    Real area = 0;       ///< m²
  };

  /// All neighbours of a face, in the order of `interfaces`.
  std::span<const Neighbour> of_face(Index face) const;

  /// m² that a face shares with blocks that are still there: batch[block] == 0.
  Real area(Index face, const std::vector<Index>& batch) const;

  /// The blocks still there that lean on one of these: each once, ascending.
  std::vector<Index> neighbours(const std::vector<Index>& of,
                                const std::vector<Index>& batch) const;

 private:
  std::vector<Index> face_begin_;       ///< [B+1] faces of each block
  std::vector<Index> neighbour_begin_;  ///< [F+1]
  std::vector<Neighbour> neighbour_;    ///< [2I] ordered by face, then as in `interfaces`
};

}  // namespace rockfold
