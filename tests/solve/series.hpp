// Local series that tests use, and a field that lies in the span of one.
#pragma once

#include <cmath>
#include <memory>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

/// The monomials of order `to` that order `from` lacks: polynomials given as a series.
class MonomialSeries : public LocalSeries {
 public:
  MonomialSeries(const Lattice& lattice, int from, int to)
      : reciprocal_(lattice.reciprocal()),
        degree_(2 * (to + (lattice.kind == LatticeKind::hex8 ? 3 : 1))),
        linear_(from < 1),
        quadratic_(to > 1) {}
  int functions() const override { return (linear_ ? 3 : 0) + (quadratic_ ? 6 : 0); }
  int degree() const override { return degree_; }  // exact for the mass
  void evaluate(const SeriesPoint& at, FunctionValue* f) const override {
    const Vec3& xi = at.xi;
    for (int d = 0; d < 3 && linear_; ++d) *f++ = {xi[d], reciprocal_[d]};
    for (int d = 0; d < 3 && quadratic_; ++d) {
      const int e = (d + 1) % 3;
      f[d] = {xi[d] * xi[d], 2 * xi[d] * reciprocal_[d]};
      f[3 + d] = {xi[d] * xi[e], xi[e] * reciprocal_[d] + xi[d] * reciprocal_[e]};
    }
  }

 private:
  Mat3 reciprocal_;
  int degree_;
  bool linear_, quadratic_;
};

/// exp(rX) sin(rY) and exp(rX) cos(rY) − 1 with X = x − node: with constants they hold every multiple of exp(rx) sin(ry), a harmonic
/// function that no polynomial is; then X² + Y², over the square of a metre, if it is wanted.
class HarmonicSeries : public LocalSeries {
 public:
  /// `only`: covers whose nodes lie at x at least so far have it, m.
  explicit HarmonicSeries(Real rate, int degree = 16, Real only = -1e300, bool square = false)
      : rate_(rate), only_(only), degree_(degree), square_(square) {}
  int functions() const override { return square_ ? 3 : 2; }
  int degree() const override { return degree_; }
  void evaluate(const SeriesPoint& at, FunctionValue* f) const override {
    if (at.node[0] < only_) return;
    const Vec3 x = at.x - at.node;
    const Real e = std::exp(rate_ * x[0]), s = e * std::sin(rate_ * x[1]),
               c = e * std::cos(rate_ * x[1]);
    f[0] = {s, {rate_ * s, rate_ * c, 0}};
    f[1] = {c - 1, {rate_ * c, -rate_ * s, 0}};
    if (square_) f[2] = {x[0] * x[0] + x[1] * x[1], {2 * x[0], 2 * x[1], 0}};
  }

 private:
  Real rate_, only_;
  int degree_;
  bool square_;
};

/// u_z = size · exp(rx) sin(ry) + bend · (x² + y²): div u = 0 and Δu = 4 bend, in equilibrium under the tractions σ n and a body force
/// −4μ bend along z, where σ_zx = μ ∂u_z/∂x and σ_zy = μ ∂u_z/∂y are all there is.
struct HarmonicField {
  Real rate, size, bend = 0;

  Vec3 at(const Vec3& x) const {
    return {
        0, 0,
        size * std::exp(rate * x[0]) * std::sin(rate * x[1]) + bend * (x[0] * x[0] + x[1] * x[1])};
  }
  /// ∂u_z/∂x, ∂u_z/∂y.
  Vec3 slope(const Vec3& x) const {
    const Real e = size * rate * std::exp(rate * x[0]);
    return {e * std::sin(rate * x[1]) + 2 * bend * x[0],
            e * std::cos(rate * x[1]) + 2 * bend * x[1], 0};
  }
  Vec3 traction(const ElasticMaterial& m, const Vec3& x, const Vec3& n) const {
    const Real mu = m.young_modulus / (2 * (1 + m.poisson_ratio));
    const Vec3 g = slope(x);
    return {mu * g[0] * n[2], mu * g[1] * n[2], mu * (g[0] * n[0] + g[1] * n[1])};
  }
};

}  // namespace rockfold
