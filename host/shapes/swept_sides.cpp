#include <algorithm>
#include <utility>

#include "host/shapes/exact_vector_exact.hpp"
#include "host/shapes/swept_sides_exact.hpp"

namespace rockfold {

ConvexPart swept_sides(const SweptPolygon& polygon, const ConvexPiece& piece) {
  const auto n = static_cast<Index>(polygon.corner.size());
  ConvexPart part;
  for (const PieceEdge& e : piece) {
    // Sides in the given sense, and diagonals in one that does not depend on the piece.
    const Index a = e.side != none ? e.side : std::min(e.from, e.to);
    const Index b = e.side != none ? (e.side + 1) % n : std::max(e.from, e.to);
    const ExactVec3& origin = polygon.corner[a];
    FacePlane face{plane_along(origin, polygon.corner[b] - origin, polygon.line[a]), false, e.side};
    const auto off_plane = std::find_if(piece.begin(), piece.end(), [&](const PieceEdge& other) {
      return side_of(face.plane, polygon.corner[other.from]) != 0;
    });
    face.inside_above =
        off_plane != piece.end() && side_of(face.plane, polygon.corner[off_plane->from]) > 0;
    part.faces.push_back(std::move(face));
  }
  return part;
}

}  // namespace rockfold
