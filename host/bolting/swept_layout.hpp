// How the sides of a tunnel, cylinder or prism lie when they are unrolled.
#pragma once

#include <array>
#include <vector>

#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A straight piece of the axis.
struct SweptSegment {
  Vec3 start{};             ///< m
  Vec3 along{};             ///< unit
  Vec3 right{}, up{};       ///< unit, across
  Real v0 = 0, length = 0;  ///< m: where it begins on the sheet, and how long it is
  /// Normals, along the axis, of the planes across its start and its end: at a bend halfway between both directions.
  Vec3 start_plane{}, end_plane{};
};

struct SweptLayout {
  std::vector<std::array<Real, 2>> section;  ///< m, (right, up); its edges are the faces 0 … n−1
  std::vector<std::array<Real, 2>> edge_u;   ///< m, where each edge begins and ends on the sheet
  bool counter_clockwise = true;             ///< the edges' own order, seen along the axis
  Real perimeter = 0;                        ///< m
  std::vector<SweptSegment> segments;
};

/// u is 0 at the middle of the highest part of the section and grows clockwise, seen along the axis, to half the
/// perimeter; the edge at the bottom may wrap: then its u runs past that. Empty segments for another shape.
SweptLayout swept_layout(const Shape& shape);

}  // namespace rockfold
