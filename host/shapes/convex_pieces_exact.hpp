// Polygons as unions of convex ones. CGAL's exact numbers: include in .cpp only.
#pragma once

#include <array>
#include <vector>

#include "host/exact/plane_exact.hpp"

namespace rockfold {

using ExactPolygon = std::vector<std::array<Exact, 2>>;

/// An edge of a convex piece: it lies on the line through two corners of the polygon.
struct PieceEdge {
  Index from = none, to = none;  ///< corners of the polygon
  Index side =
      none;  ///< the polygon's edge from corner `side` to the next, on this line; none = a cut between pieces
};

/// A convex polygon with one edge for each of its lines.
using ConvexPiece = std::vector<PieceEdge>;

/// Cuts a simple polygon of either sense along diagonals. A convex one stays whole, its edges in the given order; else the
/// pieces run counter-clockwise. No piece has two of the polygon's edges on one line, so that each keeps its name.
/// Empty if edges cross or touch each other, or nothing is enclosed. The fewest pieces that diagonals allow (Greene 1983,
/// O(n⁴)) up to 40 corners, at most four times as many (Hertel and Mehlhorn 1983) beyond.
std::vector<ConvexPiece> convex_pieces(const ExactPolygon& polygon);

}  // namespace rockfold
