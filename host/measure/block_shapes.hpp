// Shape of blocks: α and β of Kalenchuk, Diederichs & McKinnon (2006), and the aspect ratio.
#pragma once

#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// Fields of the α–β diagram. Its boundaries, as commonly drawn: β ≥ 7 elongated; 4 ≤ β < 7 between elongated and cubic
/// (α < 3) or platy (α ≥ 3); β < 4 cubic (α < 2), platy (α ≥ 5), else between them.
enum class ShapeClass : std::uint8_t {
  cubic,
  cubic_elongated,
  elongated,
  elongated_platy,
  platy,
  platy_cubic
};
constexpr int shape_class_count = 6;

ShapeClass shape_class(Real alpha, Real beta);

struct BlockShape {
  Real surface_area = 0;  ///< m², of the block's faces; joints that end inside it are none
  /// A_s·l/(7.7 V), l the mean length of all chords between two vertices (Kalenchuk et al. 2006, Eq. 1): 1 for a cube,
  /// the greater the thinner. At most 1e7, as aspect_ratio.
  Real alpha = 1;
  /// 10·[Σ(a·b)²/Σ|a|²|b|²]² over all ordered pairs of the chords that are no shorter than the median (their Eq. 2, each
  /// chord paired with itself too): 10/9 where chords have no common direction (a cube), 10 where all are parallel.
  Real beta = 1;
  /// Longest over shortest edge of the box that has the block's moments of inertia: exact for boxes, the same in every
  /// orientation. At most 1e7, what doubles resolve.
  Real aspect_ratio = 1;
};

/// Above so many vertices a block's chords are those of evenly spaced ones in the order of BlockArrays::vertex: the cost
/// stays linear.
constexpr Index most_chord_vertices = 200;

/// [B] of each block. O(corners + vertices), the chords of at most most_chord_vertices vertices a block; in parallel.
std::vector<BlockShape> block_shapes(const BlockArrays& blocks);

}  // namespace rockfold
