// Polygons as unions of convex ones. CGAL's exact numbers: include in .cpp only.
#pragma once

#include <array>
#include <vector>

#include "host/exact/plane_exact.hpp"

namespace rockfold {

using ExactPolygon = std::vector<std::array<Exact, 2>>;

/// An edge of a convex piece.
struct PieceEdge {
  Index from = none, to = none;  ///< corners of the polygon
  Index side =
      none;  ///< the polygon's edge from corner `side` to the next; none = a diagonal, between two pieces
};

using ConvexPiece = std::vector<PieceEdge>;

/// Cuts a simple polygon of either sense along diagonals. A convex one stays whole, its edges in the given order; else the
/// pieces run counter-clockwise. No two edges of a piece lie on one line, to 1e-10 at least, so that each side of the
/// polygon keeps its name. Empty if edges cross or touch each other, or nothing is enclosed.
///
/// Diagonals of the constrained Delaunay triangulation, less those that are not needed (Hertel and Mehlhorn 1983): at most
/// four times as many pieces as possible, apart from the cuts that keep edges on one line apart. O(n²).
std::vector<ConvexPiece> convex_pieces(const ExactPolygon& polygon);

}  // namespace rockfold
