// Rock that fills a tiny corner of one lattice cell: the functions of most of its covers nearly vanish there.
#pragma once

#include <cmath>
#include <vector>

#include "kernels/constraints/cover_system.hpp"
#include "tests/reference/box_covers.hpp"

namespace rockfold::reference {

/// A corner of the given size, in units of the cell's edges, turned against the lattice.
inline CoverArrays corner_of_a_cell(LatticeKind kind, int order, Real size) {
  Lattice lattice;
  lattice.kind = kind;
  lattice.origin = {-1, -1, -1};
  lattice.edge = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  lattice.cells = {2, 2, 2};
  CoverArrays covers =
      cover_regions(lattice, {box({0, 0, 0}, {size, 0.7 * size, 0.8 * size})}).arrays;
  covers.order = order;
  return covers;
}

/// The roots of the inverses of the diagonal of the stiffness, by unknown and component: what makes all functions alike.
inline std::vector<Vec3> stiffness_scale(const CoverSystem& system, Index unknowns) {
  std::vector<Vec3> scale(unknowns);
  for (Index i = 0; i < unknowns; ++i)
    for (int d = 0; d < 3; ++d) {
      std::vector<Vec3> unit(unknowns, Vec3{});
      unit[i][d] = 1;
      scale[i][d] = 1 / std::sqrt(system.apply({1, 0, 0}, unit)[i][d]);
    }
  return scale;
}

}  // namespace rockfold::reference
