// How wide cells and shared areas are: what is narrower than the tolerance connects and divides nothing (decision 5, rule 4).
#pragma once

#include "host/cut/cells/convex_cell.hpp"
#include "host/cut/cells/polygon.hpp"

namespace rockfold {

/// A cell's least extent across one of its faces.
struct CellWidth {
  Real width = 0;  ///< m: of the largest distances of a vertex from each face's plane the least
  std::size_t face = 0;  ///< from whose plane
};
CellWidth cell_width(const CellView& cell, const PlaneTable& planes);

/// Volume and width of a cell. The width is known where it is near the tolerance or below, else infinite.
struct CellMeasure {
  CellMoments moments;
  Real width = 0;  ///< m
};
CellMeasure measure_cell(const CellView& cell, const PlaneTable& planes);

/// m: of the largest distances of a corner from the other plane of each edge the least; in the polygon's own plane where the
/// two planes make an angle of a sine below 1e-8. Of widths from `enough` on some value from there on.
Real polygon_width(const Polygon& polygon, const PlaneTable& planes, Real enough);
/// The same of a cell's face.
Real face_width(const CellView& cell, const ConvexCell::Face& face, const PlaneTable& planes,
                Real enough);

/// Widths within this factor of the tolerance are doubtful: the user may have meant either.
constexpr Real doubt_factor = 100;
inline bool is_doubtful(Real width, Real tolerance) {
  return width * doubt_factor > tolerance && width < doubt_factor * tolerance;
}

}  // namespace rockfold
