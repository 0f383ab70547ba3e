#include "host/cover/piece_index.hpp"

#include <algorithm>

#include "src/base/vector.hpp"

namespace rockfold {

Index PieceIndex::find_regular(const CoverArrays& covers, Index lattice_cell) {
  const auto it =
      std::lower_bound(covers.regular_cell.begin(), covers.regular_cell.end(), lattice_cell);
  return it != covers.regular_cell.end() && *it == lattice_cell
             ? static_cast<Index>(it - covers.regular_cell.begin())
             : none;
}

Index PieceIndex::find_piece(const CoverArrays& covers, Index lattice_cell, int tet,
                             Index rock) const {
  const auto first =
      std::lower_bound(covers.element_cell.begin(), covers.element_cell.end(), lattice_cell);
  for (auto e = static_cast<Index>(first - covers.element_cell.begin());
       e < covers.cut_count() && covers.element_cell[e] == lattice_cell; ++e) {
    if (covers.element_part[e] != tet) continue;
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      if (piece_rock[q] == rock) return q;
  }
  return none;
}

std::array<Real, 4> tetrahedron_weights(const Lattice& lattice, Index lattice_cell, int tet,
                                        const Vec3& x) {
  // Coordinates within the lattice cell, 0 … 1 each.
  const auto ijk = lattice.cell_ijk(lattice_cell);
  const Vec3 r = x - lattice.node_position(ijk);
  const Vec3 bc = cross(lattice.edge[1], lattice.edge[2]);
  const Real det = dot(lattice.edge[0], bc);
  const Vec3 xi{dot(r, bc) / det, dot(r, cross(lattice.edge[2], lattice.edge[0])) / det,
                dot(r, cross(lattice.edge[0], lattice.edge[1])) / det};
  const auto corner = [&](int a) {
    const int c = tet6_corner[tet][a];
    return Vec3{Real(c & 1), Real(c >> 1 & 1), Real(c >> 2 & 1)};
  };
  // The tetrahedra have unit determinant, so Cramer's rule needs no division.
  const Vec3 o = corner(0), a = corner(1) - o, b = corner(2) - o, c = corner(3) - o, q = xi - o;
  std::array<Real, 4> w;
  w[1] = dot(q, cross(b, c));
  w[2] = dot(a, cross(q, c));
  w[3] = dot(a, cross(b, q));
  w[0] = 1 - w[1] - w[2] - w[3];
  return w;
}

}  // namespace rockfold
