// The cells of planes with small integer coefficients, by brute force in integers: an oracle that neither cuts nor keeps
// any topology.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold::test {

/// n·x = d, coefficients in lowest terms, the first that is not zero positive: equal planes are equal arrays.
using LatticePlane = std::array<std::int64_t, 4>;
LatticePlane lattice_plane(const std::array<std::int64_t, 3>& normal,
                           const std::array<std::int64_t, 3>& point);

/// Planes with |coefficients| up to some thousands; the first six bound the box. All meeting points of three planes are
/// computed once, in homogeneous integers; the cell that holds a point has those corners that lie on its side of each
/// plane or on it. O(planes³) to build, O(points · planes) a cell.
class LatticeArrangement {
 public:
  /// A cube 0 ≤ x, y, z ≤ edge cut by planes, of which those given twice count once.
  LatticeArrangement(std::int64_t edge, const std::vector<LatticePlane>& planes);

  struct Cell {
    std::vector<signed char> side;  ///< of each plane: what tells cells apart
    Index vertices = 0, faces = 0;  ///< edges by Euler
    Real volume = 0;
  };
  /// The cell that holds `inside`, which must not be within rounding of a plane.
  Cell cell(const Vec3& inside) const;

 private:
  struct Point {
    Vec3 x;
    std::vector<signed char> side;
  };
  std::vector<LatticePlane> planes_;
  std::vector<Point> points_;
};

}  // namespace rockfold::test
