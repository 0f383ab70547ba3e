#include "tests/reference/dense_system.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "src/base/vector.hpp"

namespace rockfold::reference {
namespace {

struct ElementView {
  std::array<Index, 4> cover{};
  std::array<Vec3, 4> corner{};  ///< of the tetrahedron
  Index material = 0;
};

std::array<Vec3, 4> tet_corners(const Lattice& lattice, Index cell, int t) {
  const auto ijk = lattice.cell_ijk(cell);
  std::array<Vec3, 4> x{};
  for (int k = 0; k < 4; ++k) {
    const int c = tet6_corner[t][k];
    x[k] = lattice.node_position({ijk[0] + (c & 1), ijk[1] + (c >> 1 & 1), ijk[2] + (c >> 2)});
  }
  return x;
}

/// Calls visit(element, tetrahedra that fill it), all in the model's coordinates.
void for_each_element(
    const CoverArrays& a,
    const std::function<void(const ElementView&, const std::vector<std::array<Vec3, 4>>&)>& visit) {
  for (Index r = 0; r < a.regular_count(); ++r)
    for (int t = 0; t < 6; ++t) {
      ElementView e{{}, tet_corners(a.lattice, a.regular_cell[r], t), a.regular_material[r]};
      for (int k = 0; k < 4; ++k) e.cover[k] = a.regular_cover[8 * r + tet6_corner[t][k]];
      visit(e, {e.corner});
    }
  for (Index c = 0; c < a.cut_count(); ++c) {
    ElementView e{
        {}, tet_corners(a.lattice, a.element_cell[c], a.element_part[c]), a.element_material[c]};
    for (int k = 0; k < 4; ++k) e.cover[k] = a.element_cover[4 * c + k];
    std::vector<std::array<Vec3, 4>> filling;
    const Vec3 centre = a.lattice.cell_centre(a.element_cell[c]);
    auto vertex = [&](Index v) {
      return centre + Vec3{a.vertex_xyz[3 * v], a.vertex_xyz[3 * v + 1], a.vertex_xyz[3 * v + 2]};
    };
    for (Index q = a.piece_begin[c]; q < a.piece_begin[c + 1]; ++q) {
      Vec3 middle{};  // pieces are convex
      const Index vertices = a.vertex_begin[q + 1] - a.vertex_begin[q];
      for (Index v = a.vertex_begin[q]; v < a.vertex_begin[q + 1]; ++v)
        middle += (1.0 / vertices) * vertex(v);
      for (Index t = a.triangle_begin[q]; t < a.triangle_begin[q + 1]; ++t)
        filling.push_back({middle, vertex(a.triangle_vertex[3 * t]),
                           vertex(a.triangle_vertex[3 * t + 1]),
                           vertex(a.triangle_vertex[3 * t + 2])});
    }
    visit(e, filling);
  }
}

Real signed_volume(const std::array<Vec3, 4>& v) {
  return dot(v[1] - v[0], cross(v[2] - v[0], v[3] - v[0])) / 6;
}

/// Weight of corner k at x: the volume that x makes with the other three over the whole.
Real weight_at(const std::array<Vec3, 4>& corner, int k, const Vec3& x) {
  std::array<Vec3, 4> with = corner;
  with[k] = x;
  return signed_volume(with) / signed_volume(corner);
}

/// Gradient of a weight by its values at the corner and at unit steps: it is linear.
Vec3 gradient(const std::array<Vec3, 4>& corner, int k) {
  const Real step = norm(corner[1] - corner[0]);
  Vec3 g{};
  for (int d = 0; d < 3; ++d) {
    Vec3 there = corner[0];
    there[d] += step;
    g[d] = (weight_at(corner, k, there) - weight_at(corner, k, corner[0])) / step;
  }
  return g;
}

using Voigt = std::array<std::array<Real, 6>, 6>;

Voigt elasticity(const ElasticMaterial& m) {
  const Real e = m.young_modulus, nu = m.poisson_ratio;
  const Real factor = e / ((1 + nu) * (1 - 2 * nu));
  Voigt d{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) d[i][j] = factor * (i == j ? 1 - nu : nu);
    d[3 + i][3 + i] = factor * (1 - 2 * nu) / 2;
  }
  return d;
}

/// Strains xx yy zz xy yz zx of a unit displacement of one corner along `axis`.
std::array<Real, 6> strain(const Vec3& g, int axis) {
  std::array<Real, 6> s{};
  s[axis] = g[axis];
  if (axis == 0) s[3] = g[1], s[5] = g[2];
  if (axis == 1) s[3] = g[0], s[4] = g[2];
  if (axis == 2) s[4] = g[1], s[5] = g[0];
  return s;
}

}  // namespace

Dense assemble_stiffness(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials) {
  Dense k(3 * covers.cover_node.size());
  for_each_element(covers, [&](const ElementView& e, const auto& filling) {
    Real volume = 0;
    for (const auto& tet : filling) volume += signed_volume(tet);
    const Voigt d = elasticity(materials[e.material]);
    std::array<std::array<Real, 6>, 12> column{};  // of B
    for (int a = 0; a < 12; ++a) column[a] = strain(gradient(e.corner, a / 3), a % 3);
    for (int a = 0; a < 12; ++a)
      for (int b = 0; b < 12; ++b) {
        Real sum = 0;
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j) sum += column[a][i] * d[i][j] * column[b][j];
        k(3 * e.cover[a / 3] + a % 3, 3 * e.cover[b / 3] + b % 3) += volume * sum;
      }
  });
  return k;
}

Dense assemble_mass(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials) {
  Dense m(3 * covers.cover_node.size());
  // Four points, exact to degree two (Zienkiewicz & Taylor, table of tetrahedral quadrature).
  const Real near = 0.58541019662496852, far = 0.13819660112501050;
  for_each_element(covers, [&](const ElementView& e, const auto& filling) {
    for (const auto& tet : filling)
      for (int q = 0; q < 4; ++q) {
        Vec3 x{};
        for (int k = 0; k < 4; ++k) x += (k == q ? near : far) * tet[k];
        const Real dm = materials[e.material].density * signed_volume(tet) / 4;
        Real weight[4];
        for (int a = 0; a < 4; ++a) weight[a] = weight_at(e.corner, a, x);
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b)
            for (int d = 0; d < 3; ++d)
              m(3 * e.cover[a] + d, 3 * e.cover[b] + d) += dm * weight[a] * weight[b];
      }
  });
  return m;
}

Dense assemble_springs(const CoverArrays& covers, const FixedPoints& fixed) {
  Dense k(3 * covers.cover_node.size());
  for (std::size_t n = 0; n < fixed.points.size(); ++n)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        for (int d = 0; d < 3; ++d)
          if (fixed.component[n][d])
            k(3 * fixed.points.unknown[4 * n + a] + d, 3 * fixed.points.unknown[4 * n + b] + d) +=
                fixed.stiffness[n] * fixed.points.weight[4 * n + a] *
                fixed.points.weight[4 * n + b];
  return k;
}

Dense combine(Real a, const Dense& x, Real b, const Dense& y) {
  Dense sum(x.n);
  for (std::size_t i = 0; i < sum.entry.size(); ++i) sum.entry[i] = a * x.entry[i] + b * y.entry[i];
  return sum;
}

std::vector<Vec3> multiply(const Dense& a, const std::vector<Vec3>& x) {
  std::vector<Vec3> y(x.size());
  for (std::size_t i = 0; i < a.n; ++i)
    for (std::size_t j = 0; j < a.n; ++j) y[i / 3][i % 3] += a(i, j) * x[j / 3][j % 3];
  return y;
}

std::vector<Vec3> solve(Dense a, const std::vector<Vec3>& b) {
  const std::size_t n = a.n;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) a(j, j) -= a(j, k) * a(j, k);
    a(j, j) = std::sqrt(a(j, j));
    for (std::size_t i = j + 1; i < n; ++i) {
      for (std::size_t k = 0; k < j; ++k) a(i, j) -= a(i, k) * a(j, k);
      a(i, j) /= a(j, j);
    }
  }
  std::vector<Vec3> x = b;
  auto at = [&](std::size_t i) -> Real& { return x[i / 3][i % 3]; };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) at(i) -= a(i, k) * at(k);
    at(i) /= a(i, i);
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) at(i) -= a(k, i) * at(k);
    at(i) /= a(i, i);
  }
  return x;
}

std::vector<Vec3> scattered(std::size_t count, unsigned seed) {
  std::vector<Vec3> values(count);
  unsigned state = 2654435761u * (seed + 1);
  for (Vec3& v : values)
    for (Real& x : v) {
      state = state * 1664525u + 1013904223u;
      x = (state >> 8) / Real(1 << 23) - 1;
    }
  return values;
}

Real largest(const std::vector<Vec3>& x) {
  Real most = 0;
  for (const Vec3& v : x)
    for (Real c : v) most = std::max(most, std::abs(c));
  return most;
}

Real largest_difference(const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
  std::vector<Vec3> difference;
  for (std::size_t i = 0; i < x.size(); ++i) difference.push_back(x[i] - y[i]);
  return largest(difference);
}

}  // namespace rockfold::reference
