// The sides of what lines through the edges of a convex piece sweep. CGAL's exact numbers: include in .cpp only.
#pragma once

#include "host/shapes/convex_pieces_exact.hpp"
#include "host/shapes/shape_geometry_exact.hpp"

namespace rockfold {

/// A polygon in space and the direction of a line through each of its corners: parallel, or all through one point.
struct SweptPolygon {
  std::vector<ExactVec3> corner;
  std::vector<ExactVec3> line;
};

/// A plane for each edge of the piece, exactly through both of its corners and along their lines. Two pieces that share a
/// diagonal get the same plane.
ConvexPart swept_sides(const SweptPolygon& polygon, const ConvexPiece& piece);

}  // namespace rockfold
