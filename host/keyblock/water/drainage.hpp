// Where the outline of a joint face meets free faces, which let water out of the joint.
#pragma once

#include <vector>

#include "host/keyblock/face_shape.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// A corner of the outline of a joint face, and how much of it and of the edge to the next corner drains.
struct DrainedCorner {
  Vec3 at{};            ///< m
  Real share = 0;       ///< 0 to 1
  Real edge_share = 0;  ///< 0 to 1
  Real pond = 0;        ///< Pa, of water that stands before the corner where it drains
};
using DrainedLoop = std::vector<DrainedCorner>;

/// The free faces of a block.
class Outlets {
 public:
  /// Of the largest coordinate, m: what lies closer is one. Corners of two faces that are one corner of the rock are rounded alike, edges
  /// between them to a few units of the last digit. The same 1e-9 makes vertices one when blocks are joined.
  static constexpr Real relative_slack = 1e-9;

  /// `share`: how much of the face is free, 0 to 1. `pond`: what water before it presses with.
  void add(const std::vector<Vec3>& loop, Real share, const LinearPressure& pond);

  /// An edge drains by the share of its length that lies on edges of free faces, a corner by that of the free faces that it touches.
  /// Cost: edges of the loop times edges of free faces.
  DrainedLoop drained(const std::vector<Vec3>& loop) const;

 private:
  struct Edge {
    Vec3 a, b;
    Real share;
    LinearPressure pond;
  };
  Real drained_share(const Vec3& a, const Vec3& b) const;
  DrainedCorner drained_corner(const Vec3& x) const;

  std::vector<Edge> edges_;
  Real slack_ = 0;  ///< m: what lies closer is one
};

}  // namespace rockfold
