// Points that integrate over the faces of a box, element by element.
#pragma once

#include <cmath>
#include <functional>

#include "src/arrays/cover_arrays.hpp"
#include "src/base/gauss.hpp"
#include "src/base/vector.hpp"

namespace rockfold::reference {

/// Calls visit(element, x, outward normal, area) for the points of all triangles of pieces that lie in a face of the box; n² points a triangle,
/// exact for polynomials up to degree 2n − 2 over it. Only cut elements have such triangles.
inline void for_each_face_point(
    const CoverArrays& covers, const Vec3& low, const Vec3& high, int n,
    const std::function<void(Index, const Vec3&, const Vec3&, Real)>& visit) {
  const auto rule = gauss_points(n);
  const Index whole = covers.parts_per_cell() * covers.regular_count();
  const Real share = cell_split(covers.lattice.kind).share;
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index t = covers.triangle_begin[covers.piece_begin[e]];
         t < covers.triangle_begin[covers.piece_begin[e + 1]]; ++t) {
      Vec3 v[3];
      for (int i = 0; i < 3; ++i) {
        const Real* x = &covers.vertex_xyz[3 * covers.triangle_vertex[3 * t + i]];
        v[i] = covers.lattice.cell_centre(covers.element_cell[e]) + Vec3{x[0], x[1], x[2]};
      }
      for (int d = 0; d < 3; ++d)
        for (const int side : {-1, 1}) {
          const Real at = side < 0 ? low[d] : high[d];
          if (std::abs(v[0][d] - at) + std::abs(v[1][d] - at) + std::abs(v[2][d] - at) > 1e-9)
            continue;
          Vec3 normal{};
          normal[d] = side;
          const Real area = share * norm(cross(v[1] - v[0], v[2] - v[0]));  // twice that
          for (const auto& [r, by_r] : rule)
            for (const auto& [s, by_s] : rule)
              visit(whole + e, v[0] + r * ((v[1] - v[0]) + s * (v[2] - v[1])), normal,
                    area * r * by_r * by_s);
        }
    }
}

}  // namespace rockfold::reference
