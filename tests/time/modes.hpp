// Vibration modes of a free rock, by the reference's dense matrices.
#pragma once

#include <cmath>

#include "src/base/vector.hpp"
#include "tests/reference/box_covers.hpp"
#include "tests/reference/dense_system.hpp"

namespace rockfold::reference {

struct Mode {
  Real omega = 0;              ///< rad/s
  std::vector<Vec3> shape;     ///< of unit modal mass
  std::vector<Vec3> weighted;  ///< M · shape
};

inline Real product(const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  Real sum = 0;
  for (std::size_t p = 0; p < x.size(); ++p) sum += dot(x[p], y[p]);
  return sum;
}

inline void add(Real factor, const std::vector<Vec3>& x, std::vector<Vec3>& y) {
  for (std::size_t p = 0; p < x.size(); ++p) y[p] += factor * x[p];
}

/// Makes x of unit mass and orthogonal to all of `basis`.
inline void orthonormalise(const Dense& mass, const std::vector<std::vector<Vec3>>& basis,
                           std::vector<Vec3>& x) {
  for (int twice = 0; twice < 2; ++twice)
    for (const auto& b : basis) add(-product(b, multiply(mass, x)), b, x);
  const Real norm = std::sqrt(product(x, multiply(mass, x)));
  for (Vec3& v : x) v = (1 / norm) * v;
}

/// By inverse iteration beside the six rigid motions.
inline Mode first_elastic_mode(const CoverArrays& covers,
                               const std::vector<ElasticMaterial>& materials) {
  const Dense k = assemble_stiffness(covers, materials), mass = assemble_mass(covers, materials);
  std::vector<std::vector<Vec3>> rigid;
  for (int d = 0; d < 6; ++d) {
    rigid.push_back(sample_at_nodes(covers, [d](const Vec3& x) {
      Vec3 axis{};
      axis[d % 3] = 1;
      return d < 3 ? axis : cross(axis, x);
    }));
    auto mode = rigid.back();
    rigid.pop_back();
    orthonormalise(mass, rigid, mode);
    rigid.push_back(mode);
  }
  Mode mode;
  mode.shape = scattered(covers.unknown_count(), 7);
  orthonormalise(mass, rigid, mode.shape);
  const Real shift = 0.1 * product(mode.shape, multiply(k, mode.shape)) / 1e3;
  const Dense shifted = combine(1, k, shift, mass);
  Real before = 0;
  for (int i = 0; i < 200; ++i) {
    mode.shape = solve(shifted, multiply(mass, mode.shape));
    orthonormalise(mass, rigid, mode.shape);
    const Real square = product(mode.shape, multiply(k, mode.shape));
    if (std::abs(square - before) < 1e-13 * square) break;
    before = square;
  }
  mode.omega = std::sqrt(before);
  mode.weighted = multiply(mass, mode.shape);
  return mode;
}

}  // namespace rockfold::reference
