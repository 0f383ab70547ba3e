// Contours of a function on a square grid.
#pragma once

#include <vector>

#include "src/report/drawings/svg.hpp"

namespace rockfold {

/// Values at low + step (i, j), 0 ≤ i, j < size, in rows of i.
struct ContourGrid {
  std::size_t size = 0;
  Point2 low{};
  Real step = 1;
  std::vector<Real> value;  ///< [size²] those on the rim must be less than every level

  Real at(std::size_t i, std::size_t j) const { return value[j * size + i]; }
};

/// Closed loops round all that is at least `level`, by marching squares with linear edges: what is higher lies to the left of each
/// where y points up. In a square whose opposite corners are high, its mean decides whether they are joined.
std::vector<std::vector<Point2>> contour_loops(const ContourGrid& grid, Real level);

/// Levels at equal steps of 1, 2 or 5 times a power of ten, from one step on to below `most`; at most eight.
std::vector<Real> contour_levels(Real most);

}  // namespace rockfold
