// Lines through the blocks: which block they cross, from where to where.
#pragma once

#include <optional>
#include <vector>

#include "host/box_tree.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Where the line from + t·direction meets a face's polygon (holes are no part of it); nothing where it misses it or runs
/// along its plane.
std::optional<Real> line_meets_face(const BlockArrays& blocks, Index face, const Vec3& from,
                                    const Vec3& direction);

/// m: where the line meets the plane of a face; it must not run along it.
Real way_to_plane(const BlockArrays& blocks, Index face, const Vec3& from, const Vec3& direction);

/// A part of a line in one block.
struct RockSegment {
  Index block = none;
  Real from = 0, to = 0;   ///< m along the line, from < to
  Index exit_face = none;  ///< where the line leaves the block; none: it ends inside
  Real behind = 0;         ///< m of the block that lie behind the line's start
};

/// m: the largest side of the box around all blocks.
Real model_size(const BlockArrays& blocks);

class RockLines {
 public:
  /// `down` is the direction of gravity, of any length.
  RockLines(const BlockArrays& blocks, const Vec3& down);

  /// The parts in rock of the line from `start` over `length`, along a unit direction, ascending. Which blocks it crosses is
  /// found on a line that is moved aside by a ten-millionth of the model's size, so that it runs along no face and
  /// through no edge; where it enters and leaves them, on the line itself.
  std::vector<RockSegment> along(const Vec3& start, const Vec3& direction, Real length) const;

 private:
  struct Line {
    Vec3 start{}, beside{}, direction{};
    Real length = 0;
  };
  Vec3 sideways(const Vec3& start, const Vec3& direction) const;
  bool cross(Index block, const Line& line, std::vector<RockSegment>& segments) const;

  const BlockArrays& blocks_;
  Vec3 down_{};    ///< unit
  Real size_ = 0;  ///< m
  Vec3 centre_{};  ///< m, of the rock
  BoxTree tree_;
};

}  // namespace rockfold
