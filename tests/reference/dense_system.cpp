#include "tests/reference/dense_system.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "src/base/vector.hpp"

namespace rockfold::reference {
namespace {

using Tetrahedron = std::array<Vec3, 4>;

struct ElementView {
  std::vector<Index> cover;
  std::vector<Vec3> node;  ///< places of the part's nodes
  Index material = 0;
  Real share = 1;
};

Real signed_volume(const Tetrahedron& v) {
  return rockfold::dot(v[1] - v[0], cross(v[2] - v[0], v[3] - v[0])) / 6;
}

ElementView make_view(const CoverArrays& a, Index cell, int part, Index material) {
  ElementView e;
  const CellSplit& split = a.lattice.split(cell);
  for (int k = 0; k < split.part[part].nodes; ++k)
    e.node.push_back(a.lattice.node_position(a.lattice.cell_node(cell, split.part[part].node[k])));
  e.material = material;
  if (a.lattice.kind == LatticeKind::tet5_mixed) e.share = 0.5;
  return e;
}

/// Tetrahedra that fill a whole part.
std::vector<Tetrahedron> fill(const std::vector<Vec3>& v) {
  if (v.size() == 4) return {{v[0], v[1], v[2], v[3]}};
  std::vector<Tetrahedron> result;
  for (const auto& t : {std::array{0, 1, 3, 7}, std::array{0, 3, 2, 7}, std::array{0, 2, 6, 7},
                        std::array{0, 6, 4, 7}, std::array{0, 4, 5, 7}, std::array{0, 5, 1, 7}})
    result.push_back({v[t[0]], v[t[1]], v[t[2]], v[t[3]]});
  return result;
}

/// Calls visit(element, tetrahedra that fill it), all in the model's coordinates.
void for_each_element(
    const CoverArrays& a,
    const std::function<void(const ElementView&, const std::vector<Tetrahedron>&)>& visit) {
  for (Index r = 0; r < a.regular_count(); ++r)
    for (int t = 0; t < a.parts_per_cell(); ++t) {
      ElementView e = make_view(a, a.regular_cell[r], t, a.regular_material[r]);
      const CellPart& part = a.lattice.split(a.regular_cell[r]).part[t];
      for (int k = 0; k < part.nodes; ++k)
        e.cover.push_back(a.regular_cover[a.nodes_per_cell() * r + part.node[k]]);
      visit(e, fill(e.node));
    }
  for (Index c = 0; c < a.cut_count(); ++c) {
    ElementView e = make_view(a, a.element_cell[c], a.element_part[c], a.element_material[c]);
    const int nodes = a.nodes_per_part();
    for (int k = 0; k < nodes; ++k) e.cover.push_back(a.element_cover[nodes * c + k]);
    std::vector<Tetrahedron> filling;
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

/// A function at a point: value and gradient.
struct Sample {
  Real value = 0;
  Vec3 slope{};
};

Sample times(const Sample& f, const Sample& g) {
  return {f.value * g.value, g.value * f.slope + f.value * g.slope};
}

/// The weight of node k at x: by volumes in a tetrahedron, as a product of three linear functions in a hexahedron.
Sample weight(const ElementView& e, const Mat3& edge, std::size_t k, const Vec3& x) {
  if (e.node.size() == 1) return {1, {}};
  if (e.node.size() == 4) {
    const Vec3 &o = e.node[(k + 1) % 4], &p = e.node[(k + 2) % 4], &q = e.node[(k + 3) % 4];
    const Vec3 normal = cross(p - o, q - o);
    const Real height = rockfold::dot(normal, e.node[k] - o);
    return {rockfold::dot(normal, x - o) / height, (1 / height) * normal};
  }
  Sample product{1, {}};
  for (int d = 0; d < 3; ++d) {
    // 1 at the node, 0 at the opposite face
    const Vec3 normal = cross(edge[(d + 1) % 3], edge[(d + 2) % 3]);
    const Real sign = (k >> d & 1) != 0 ? 1 : -1, height = rockfold::dot(normal, edge[d]);
    product = times(product, {1 + sign * rockfold::dot(normal, x - e.node[k]) / height,
                              (sign / height) * normal});
  }
  return product;
}

/// Cover function k about a node, in units of the lattice's edges.
Sample cover_function(const Mat3& edge, const Vec3& node, int k, const Vec3& x) {
  std::array<Sample, 3> xi;
  for (int d = 0; d < 3; ++d) {
    const Vec3 normal = cross(edge[(d + 1) % 3], edge[(d + 2) % 3]);
    const Real height = rockfold::dot(normal, edge[d]);
    xi[d] = {rockfold::dot(normal, x - node) / height, (1 / height) * normal};
  }
  if (k == 0) return {1, {}};
  if (k < 4) return xi[k - 1];
  if (k < 7) return times(xi[k - 4], xi[k - 4]);
  return times(xi[k - 7], xi[(k - 6) % 3]);
}

/// Points and weights of Gauss and Legendre on (0, 1), exact to degree 2n − 1.
std::vector<std::pair<Real, Real>> gauss(int n) {
  std::vector<std::pair<Real, Real>> rule;
  for (int i = 0; i < n; ++i) {
    Real z = std::cos(std::acos(-1.0) * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 50; ++step) {
      Real p = 1, before = 0;
      for (int j = 0; j < n; ++j) {
        const Real older = before;
        before = p;
        p = ((2 * j + 1) * z * before - j * older) / (j + 1);
      }
      slope = n * (z * p - before) / (z * z - 1);
      z -= p / slope;
    }
    rule.emplace_back((1 + z) / 2, 1 / ((1 - z * z) * slope * slope));
  }
  return rule;
}

/// Calls at(x, dV) for points of a tetrahedron, exact to degree 2n − 3: a cube with a face and an edge collapsed.
template <class At>
void integrate(const Tetrahedron& v, int n, At at) {
  const Real six_volume = 6 * signed_volume(v);
  const auto rule = gauss(n);
  for (const auto& [r, wr] : rule)
    for (const auto& [s, ws] : rule)
      for (const auto& [t, wt] : rule) {
        const Vec3 x = v[0] + r * ((v[1] - v[0]) + s * ((v[2] - v[1]) + t * (v[3] - v[2])));
        at(x, six_volume * r * r * s * wr * ws * wt);
      }
}

/// Calls visit(element, unknowns, functions there, dV) at points that integrate products of two functions exactly.
template <class Visit>
void for_each_point(const CoverArrays& a, Visit visit) {
  const int weights = a.lattice.kind == LatticeKind::hex8    ? 3
                      : a.lattice.kind == LatticeKind::block ? 0
                                                             : 1;
  const int points = weights + a.order + 2, n = a.functions();
  for_each_element(a, [&](const ElementView& e, const std::vector<Tetrahedron>& filling) {
    std::vector<Index> unknown;
    for (const Index p : e.cover)
      for (int k = 0; k < n; ++k) unknown.push_back(k * a.cover_count() + p);
    std::vector<Sample> function(unknown.size());
    for (const auto& tet : filling)
      integrate(tet, points, [&](const Vec3& x, Real dv) {
        for (std::size_t f = 0; f < function.size(); ++f)
          function[f] =
              times(weight(e, a.lattice.edge, f / n, x),
                    cover_function(a.lattice.edge, e.node[f / n], static_cast<int>(f) % n, x));
        visit(e, unknown, function, e.share * dv);
      });
  });
}

/// Calls visit(element, unknowns, each function at the points, dV of the points) for each element.
template <class Visit>
void for_each_rule(const CoverArrays& a, Visit visit) {
  const int weights = a.lattice.kind == LatticeKind::hex8    ? 3
                      : a.lattice.kind == LatticeKind::block ? 0
                                                             : 1;
  const int points = weights + a.order + 2, n = a.functions();
  for_each_element(a, [&](const ElementView& e, const std::vector<Tetrahedron>& filling) {
    std::vector<Index> unknown;
    for (const Index p : e.cover)
      for (int k = 0; k < n; ++k) unknown.push_back(k * a.cover_count() + p);
    std::vector<std::vector<Sample>> at(unknown.size());
    std::vector<Real> volume;
    for (const auto& tet : filling)
      integrate(tet, points, [&](const Vec3& x, Real dv) {
        for (std::size_t f = 0; f < unknown.size(); ++f)
          at[f].push_back(
              times(weight(e, a.lattice.edge, f / n, x),
                    cover_function(a.lattice.edge, e.node[f / n], static_cast<int>(f) % n, x)));
        volume.push_back(e.share * dv);
      });
    visit(e, unknown, at, volume);
  });
}

}  // namespace

Dense assemble_stiffness(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials) {
  Dense k(3 * covers.unknown_count());
  for_each_rule(
      covers, [&](const ElementView& e, const std::vector<Index>& unknown,
                  const std::vector<std::vector<Sample>>& at, const std::vector<Real>& volume) {
        const ElasticMaterial& m = materials[e.material];
        const Real young = m.young_modulus, nu = m.poisson_ratio;
        const Real mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
        for (std::size_t f = 0; f < unknown.size(); ++f)
          for (std::size_t g = 0; g < unknown.size(); ++g) {
            Real s[3][3] = {};  // ∫ ∂_i φ_f ∂_j φ_g
            for (std::size_t q = 0; q < volume.size(); ++q)
              for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                  s[i][j] += volume[q] * at[f][q].slope[i] * at[g][q].slope[j];
            // C_iajb = λ δ_ia δ_jb + μ (δ_ij δ_ab + δ_ib δ_aj) with ∂_a φ_f ∂_b φ_g
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j)
                for (int a = 0; a < 3; ++a)
                  for (int b = 0; b < 3; ++b) {
                    const Real c = (i == a && j == b ? lambda : 0) + (i == j && a == b ? mu : 0) +
                                   (i == b && a == j ? mu : 0);
                    if (c != 0) k(3 * unknown[f] + i, 3 * unknown[g] + j) += c * s[a][b];
                  }
          }
      });
  return k;
}

Dense assemble_mass(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials) {
  Dense m(3 * covers.unknown_count());
  for_each_rule(
      covers, [&](const ElementView& e, const std::vector<Index>& unknown,
                  const std::vector<std::vector<Sample>>& at, const std::vector<Real>& volume) {
        for (std::size_t f = 0; f < unknown.size(); ++f)
          for (std::size_t g = 0; g < unknown.size(); ++g) {
            Real sum = 0;
            for (std::size_t q = 0; q < volume.size(); ++q)
              sum += volume[q] * at[f][q].value * at[g][q].value;
            for (int d = 0; d < 3; ++d)
              m(3 * unknown[f] + d, 3 * unknown[g] + d) += materials[e.material].density * sum;
          }
      });
  return m;
}

Dense assemble_springs(const CoverArrays& covers, const FixedPoints& fixed) {
  Dense k(3 * covers.unknown_count());
  const MaterialPoints& points = fixed.points;
  for (std::size_t n = 0; n < points.size(); ++n)
    for (Index a = points.begin[n]; a < points.begin[n + 1]; ++a)
      for (Index b = points.begin[n]; b < points.begin[n + 1]; ++b)
        for (int d = 0; d < 3; ++d)
          if (fixed.component[n][d])
            k(3 * points.unknown[a] + d, 3 * points.unknown[b] + d) +=
                fixed.stiffness[n] * points.weight[a] * points.weight[b];
  return k;
}

std::vector<Real> eigenvalues(Dense a) {
  const std::size_t n = a.n;
  for (int sweep = 0; sweep < 30; ++sweep) {
    Real off = 0, all = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        all += a(i, j) * a(i, j);
        if (i != j) off += a(i, j) * a(i, j);
      }
    if (off <= 1e-30 * all) break;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        if (std::abs(a(p, q)) <= 1e-30 * std::sqrt(all)) continue;
        const Real theta = (a(q, q) - a(p, p)) / (2 * a(p, q));
        const Real t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const Real c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (std::size_t k = 0; k < n; ++k) {
          const Real x = a(k, p), y = a(k, q);
          a(k, p) = c * x - s * y;
          a(k, q) = s * x + c * y;
        }
        for (std::size_t k = 0; k < n; ++k) {
          const Real x = a(p, k), y = a(q, k);
          a(p, k) = c * x - s * y;
          a(q, k) = s * x + c * y;
        }
      }
  }
  std::vector<Real> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(a(i, i));
  std::sort(values.begin(), values.end());
  return values;
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
