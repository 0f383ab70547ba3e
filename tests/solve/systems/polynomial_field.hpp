// Displacements that are polynomials, with the stress, body force and load that belong to them.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "src/base/vector.hpp"
#include "tests/reference/dense_system.hpp"

namespace rockfold {

struct PolynomialField {
  struct Term {
    Real factor;
    int a, b, c;
  };
  std::array<std::vector<Term>, 3> u;

  /// Without any symmetry, of the degree given (up to 3).
  static PolynomialField of_degree(int degree) {
    PolynomialField field;
    Real factor = 0.7;
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a <= degree; ++a)
        for (int b = 0; a + b <= degree; ++b)
          for (int c = 0; a + b + c <= degree; ++c) {
            factor = std::fmod(factor * 7.31 + 0.17, 1.0);
            field.u[i].push_back({1e-3 * (factor - 0.4), a, b, c});
          }
    return field;
  }

  /// ∂^k u_i, k given for each axis.
  Real derivative(int i, const std::array<int, 3>& k, const Vec3& x) const {
    Real sum = 0;
    for (const Term& t : u[i]) {
      const std::array<int, 3> power{t.a, t.b, t.c};
      Real value = t.factor;
      for (int d = 0; d < 3; ++d) {
        for (int j = 0; j < k[d]; ++j) value *= power[d] - j;
        value *= power[d] >= k[d] ? std::pow(x[d], power[d] - k[d]) : 0;
      }
      sum += value;
    }
    return sum;
  }
  Real derivative(int i, int a, const Vec3& x) const {
    std::array<int, 3> k{};
    ++k[a];
    return derivative(i, k, x);
  }
  Real derivative(int i, int a, int b, const Vec3& x) const {
    std::array<int, 3> k{};
    ++k[a];
    ++k[b];
    return derivative(i, k, x);
  }
  Vec3 at(const Vec3& x) const {
    return {derivative(0, {0, 0, 0}, x), derivative(1, {0, 0, 0}, x), derivative(2, {0, 0, 0}, x)};
  }

  /// σ_ij, row by row.
  Mat3 stress(const ElasticMaterial& m, const Vec3& x) const {
    const Real mu = m.young_modulus / (2 * (1 + m.poisson_ratio));
    const Real lambda = 2 * mu * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
    Mat3 s{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        s[i][j] = mu * (derivative(i, j, x) + derivative(j, i, x));
        if (i == j)
          for (int d = 0; d < 3; ++d) s[i][j] += lambda * derivative(d, d, x);
      }
    return s;
  }
  /// −div σ
  Vec3 body_force(const ElasticMaterial& m, const Vec3& x) const {
    const Real mu = m.young_modulus / (2 * (1 + m.poisson_ratio));
    const Real lambda = 2 * mu * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
    Vec3 b{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        b[i] -= (lambda + mu) * derivative(j, i, j, x) + mu * derivative(i, j, j, x);
    return b;
  }

  /// What a box of one material is loaded with, its boundary included.
  std::vector<Vec3> load(const CoverArrays& covers, const ElasticMaterial& m, const Vec3& low,
                         const Vec3& high) const {
    std::vector<std::function<Real(const Vec3&)>> faces;
    for (int d = 0; d < 3; ++d)
      for (const Real at : {low[d], high[d]})
        faces.emplace_back([d, at](const Vec3& x) { return x[d] - at; });
    return reference::assemble_load(
        covers, [&](const Vec3& x) { return body_force(m, x); },
        [&](const Vec3& x, const Vec3& n) {
          const Mat3 s = stress(m, x);
          return Vec3{dot(s[0], n), dot(s[1], n), dot(s[2], n)};
        },
        faces);
  }
};

}  // namespace rockfold
