// Polynomials as unknowns of the covers.
#pragma once

#include <vector>

#include "tests/solve/systems/polynomial_field.hpp"

namespace rockfold {

/// A polynomial of degree ≤ 2 in the covers: Σ N_a (u(x_a) + share ∂u/∂ξ·ξ) with share 1/2 is u where weights are linear, and the
/// Taylor expansion on a block.
inline std::vector<Vec3> represent(const CoverArrays& covers, const PolynomialField& field) {
  const bool block = covers.lattice.kind == LatticeKind::block;
  std::vector<Vec3> d(covers.unknown_count());
  for (Index p = 0; p < covers.cover_count(); ++p) {
    const Vec3 x = covers.lattice.node_position(covers.cover_node[p]);
    const Mat3& edge = covers.lattice.edge;
    d[p] = field.at(x);
    for (int k = 1; k < covers.functions(); ++k)
      for (int i = 0; i < 3; ++i) {
        const int m = (k - 1) % 3, n = k < 7 ? m : (m + 1) % 3;
        Real first = 0, second = 0;
        for (int a = 0; a < 3; ++a) {
          first += edge[m][a] * field.derivative(i, a, x);
          for (int b = 0; b < 3; ++b)
            second += edge[m][a] * edge[n][b] * field.derivative(i, a, b, x);
        }
        Vec3& to = d[k * covers.cover_count() + p];
        if (k < 4)
          to[i] = (block ? 1 : 0.5) * first;
        else
          to[i] = block ? (k < 7 ? 0.5 : 1) * second : 0;
      }
  }
  return d;
}

}  // namespace rockfold
