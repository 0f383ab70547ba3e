#include <cmath>

#include "kernels/solve/element_kernel.hpp"
#include "kernels/solve/tet_weights.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

std::array<TetWeights, 6> tet_weights(const Lattice& lattice) {
  const auto& edge = lattice.edge;
  const Real determinant = dot(edge[0], cross(edge[1], edge[2]));
  // Gradients of the lattice's own coordinates (0 … 1 in a cell): the reciprocal basis.
  const Mat3 reciprocal{(1 / determinant) * cross(edge[1], edge[2]),
                        (1 / determinant) * cross(edge[2], edge[0]),
                        (1 / determinant) * cross(edge[0], edge[1])};
  std::array<TetWeights, 6> tets{};
  for (int t = 0; t < 6; ++t) {
    auto at = [&](int a) {
      const int c = tet6_corner[t][a];
      return Vec3{Real(c & 1), Real(c >> 1 & 1), Real(c >> 2 & 1)};
    };
    TetWeights& tet = tets[t];
    tet.volume = std::abs(determinant) / 6;
    for (int a = 0; a < 4; ++a) {
      // In lattice coordinates corners are 0 or 1: the weight of a is 1 there and 0 on the opposite face.
      const Vec3 o = at((a + 1) % 4);
      const Vec3 normal = cross(at((a + 2) % 4) - o, at((a + 3) % 4) - o);
      const Vec3 slope = (1 / dot(normal, at(a) - o)) * normal;
      const Vec3 corner = at(a) - Vec3{0.5, 0.5, 0.5};
      for (int d = 0; d < 3; ++d) {
        tet.gradient[a] += slope[d] * reciprocal[d];
        tet.first += (tet.volume / 4 * corner[d]) * edge[d];
      }
      tet.constant[a] = dot(slope, Vec3{0.5, 0.5, 0.5} - o);
    }
  }
  return tets;
}

namespace solve {

TetTable make_tet_table(const Lattice& lattice) {
  const auto tets = tet_weights(lattice);
  TetTable table{};
  table.volume = tets[0].volume;
  for (int t = 0; t < 6; ++t)
    for (int a = 0; a < 4; ++a) {
      table.corner[t][a] = tet6_corner[t][a];
      table.constant[t][a] = tets[t].constant[a];
      for (int d = 0; d < 3; ++d) table.gradient[t][a][d] = tets[t].gradient[a][d];
    }
  return table;
}

Elastic make_elastic(const ElasticMaterial& m) {
  const Real e = m.young_modulus, nu = m.poisson_ratio;
  return {e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu)), m.density};
}

std::vector<Elastic> make_elastic(const std::vector<ElasticMaterial>& materials) {
  std::vector<Elastic> result;
  for (const auto& m : materials) result.push_back(make_elastic(m));
  return result;
}

}  // namespace solve
}  // namespace rockfold
