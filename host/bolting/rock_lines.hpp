// Lines through the blocks: which block they cross, from where to where.
#pragma once

#include <optional>
#include <vector>

#include "host/bolting/box_tree.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Where the line from + t·direction meets a face's polygon (holes are no part of it); nothing where it misses it or runs
/// along its plane.
std::optional<Real> line_meets_face(const BlockArrays& blocks, Index face, const Vec3& from,
                                    const Vec3& direction);

/// A part of a line in one block.
struct RockSegment {
  Index block = none;
  Real from = 0, to = 0;   ///< m along the line, from < to
  Index exit_face = none;  ///< where the line leaves the block; none: it ends inside
};

/// m: the largest side of the box around all blocks.
Real model_size(const BlockArrays& blocks);

class RockLines {
 public:
  explicit RockLines(const BlockArrays& blocks);

  /// The parts in rock of the line from `start` over `length`, along a unit direction, ascending. The line is moved aside
  /// by a ten-millionth of the model's size, in a fixed odd direction, so that it runs along no face and through no edge.
  std::vector<RockSegment> along(const Vec3& start, const Vec3& direction, Real length) const;

 private:
  bool cross(Index block, const Vec3& start, const Vec3& direction, Real length,
             std::vector<RockSegment>& segments) const;

  const BlockArrays& blocks_;
  Real size_ = 0;  ///< m
  BoxTree tree_;
};

}  // namespace rockfold
