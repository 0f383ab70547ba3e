#include "kernels/finite/quadrature.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/integrate/moments.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold::finite {

namespace {

int monomials_up_to(int degree) {
  return (degree + 1) * (degree + 2) * (degree + 3) / 6;
}

/// Exponents in the order of monomial_index.
std::vector<std::array<int, 3>> exponents(int degree) {
  std::vector<std::array<int, 3>> list(monomials_up_to(degree));
  for (int a = 0; a <= degree; ++a)
    for (int b = 0; a + b <= degree; ++b)
      for (int c = 0; a + b + c <= degree; ++c) list[monomial_index(a, b, c)] = {a, b, c};
  return list;
}

/// As many points as monomials, inside a tetrahedron: its lattice of degree + 1 points an edge, drawn in by half a step.
std::vector<Vec3> tetrahedron_points(const std::array<Vec3, 4>& corner, int degree) {
  std::vector<Vec3> points;
  const Real whole = degree + 2;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) {
        const std::array<Real, 4> share{degree - i - j - k + 0.5, i + 0.5, j + 0.5, k + 0.5};
        Vec3 x{};
        for (int a = 0; a < 4; ++a) x += (share[a] / whole) * corner[a];
        points.push_back(x);
      }
  return points;
}

/// As many points as monomials in the cell −1/2 … 1/2: a grid's lower corner over points that spread over the edge in any number.
std::vector<Vec3> cell_points(int degree) {
  // Leja's order of Chebyshev points: each as far as can be from those before.
  std::vector<Real> candidate, edge;
  constexpr int many = 64;
  for (int i = 0; i <= many; ++i) candidate.push_back(-0.5 * std::cos(std::acos(-1.0) * i / many));
  for (int n = 0; n <= degree; ++n) {
    Real best = -1, at = 0;
    for (const Real x : candidate) {
      Real product = 1;
      for (const Real y : edge) product *= std::abs(x - y);
      if (edge.empty()) product = 1 - std::abs(x);  // the middle first
      if (product > best * (1 + 1e-12)) best = product, at = x;
    }
    edge.push_back(at);
  }
  std::vector<Vec3> points;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) points.push_back({edge[i], edge[j], edge[k]});
  return points;
}

std::vector<Vec3> part_points(const CellSplit& split, const CellPart& part, int degree) {
  if (part.nodes != 4) return cell_points(degree);
  std::array<Vec3, 4> corner;
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 3; ++d) corner[a][d] = 0.5 * split.node[part.node[a]][d] - 0.5;
  return tetrahedron_points(corner, degree);
}

/// Row q of the inverse of (monomial m at point q) transposed: weights = inverse · moments. Gauss–Jordan with pivoting.
std::vector<Real> fitting(const std::vector<Vec3>& points, int degree) {
  const auto powers = exponents(degree);
  const std::size_t n = points.size();
  std::vector<Real> a(n * n), inverse(n * n, 0);
  for (std::size_t m = 0; m < n; ++m)
    for (std::size_t q = 0; q < n; ++q) {
      Real value = 1;
      for (int d = 0; d < 3; ++d)
        for (int i = 0; i < powers[m][d]; ++i) value *= points[q][d];
      a[m * n + q] = value;
      inverse[m * n + q] = m == q ? 1 : 0;
    }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(a[r * n + c]) > std::abs(a[pivot * n + c])) pivot = r;
    for (std::size_t k = 0; k < n; ++k) {
      std::swap(a[c * n + k], a[pivot * n + k]);
      std::swap(inverse[c * n + k], inverse[pivot * n + k]);
    }
    const Real scale = 1 / a[c * n + c];
    for (std::size_t k = 0; k < n; ++k) a[c * n + k] *= scale, inverse[c * n + k] *= scale;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const Real share = a[r * n + c];
      if (share == 0) continue;
      for (std::size_t k = 0; k < n; ++k) {
        a[r * n + k] -= share * a[c * n + k];
        inverse[r * n + k] -= share * inverse[c * n + k];
      }
    }
  }
  return inverse;
}

/// The surface of a whole part, in η.
void add_whole_part(const CellSplit& split, const CellPart& part, ClosedSurfaces& surfaces) {
  const auto first = static_cast<Index>(surfaces.vertex_xyz.size() / 3);
  for (int a = 0; a < part.nodes; ++a)
    for (int d = 0; d < 3; ++d)
      surfaces.vertex_xyz.push_back(0.5 * split.node[part.node[a]][d] - 0.5);
  const std::vector<Index> tetrahedron{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const std::vector<Index> hexahedron{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                      2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  for (const Index v : part.nodes == 4 ? tetrahedron : hexahedron)
    surfaces.triangle_vertex.push_back(first + v);
  surfaces.triangle_begin.push_back(static_cast<Index>(surfaces.triangle_vertex.size() / 3));
}

Real cell_volume(const Lattice& lattice) {
  return std::abs(dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2])));
}

/// Moments of all pieces in η, [Q][monomial_count].
std::vector<Real> moments_of_pieces(const CoverArrays& covers) {
  ClosedSurfaces surfaces{covers.triangle_begin, covers.triangle_vertex, covers.vertex_xyz};
  const Mat3 to_local = covers.lattice.reciprocal();
  for (std::size_t v = 0; v + 2 < surfaces.vertex_xyz.size(); v += 3) {
    const Vec3 x{surfaces.vertex_xyz[v], surfaces.vertex_xyz[v + 1], surfaces.vertex_xyz[v + 2]};
    for (int d = 0; d < 3; ++d) surfaces.vertex_xyz[v + d] = dot(to_local[d], x);
  }
  return integrate_monomials(surfaces);
}

class Fitter {
 public:
  explicit Fitter(const CoverArrays& covers) : covers_(covers), degree_(quadrature_degree(covers)) {
    const LatticeKind kind = covers.lattice.kind;
    forms_.push_back(&cell_split(kind, false));
    if (kind == LatticeKind::tet5) forms_.push_back(&cell_split(kind, true));
    parts_ = covers.parts_per_cell();
  }

  Quadrature run() {
    result_.kinds = static_cast<int>(forms_.size()) * parts_;
    result_.points = monomials_up_to(degree_);
    result_.functions = covers_.nodes_per_part() * covers_.functions();
    for (const CellSplit* split : forms_)
      for (const CellPart& part : split->part) add_kind(*split, part);
    add_regular();
    add_cut();
    return std::move(result_);
  }

 private:
  void add_kind(const CellSplit& split, const CellPart& part) {
    const auto points = part_points(split, part, degree_);
    inverse_.push_back(fitting(points, degree_));
    for (const Vec3& eta : points) {
      result_.place.push_back(eta);
      const auto gradients = function_gradients(covers_, split, part, eta);
      result_.gradient.insert(result_.gradient.end(), gradients.begin(), gradients.end());
    }
  }

  int kind_of(Index cell, int part) const {
    const bool odd = forms_.size() > 1 && &covers_.lattice.split(cell) == forms_[1];
    return (odd ? parts_ : 0) + part;
  }

  void add_element(int kind, const Real* moments) {
    result_.kind.push_back(kind);
    const Real scale = forms_.front()->share * cell_volume(covers_.lattice);
    const int n = result_.points;
    for (int q = 0; q < n; ++q) {
      Real sum = 0;
      for (int m = 0; m < n; ++m) sum += inverse_[kind][q * n + m] * moments[m];
      result_.weight.push_back(scale * sum);
    }
  }

  void add_regular() {
    if (covers_.regular_count() == 0) return;
    ClosedSurfaces whole;
    whole.triangle_begin = {0};
    for (const CellSplit* split : forms_)
      for (const CellPart& part : split->part) add_whole_part(*split, part, whole);
    const auto moments = integrate_monomials(whole);
    for (Index r = 0; r < covers_.regular_count(); ++r)
      for (int t = 0; t < parts_; ++t) {
        const int kind = kind_of(covers_.regular_cell[r], t);
        add_element(kind, &moments[static_cast<std::size_t>(kind) * monomial_count]);
      }
  }

  void add_cut() {
    if (covers_.cut_count() == 0) return;
    // Below this a volume drowns in the rounding of its vertices: such a piece only keeps its covers from being idle.
    constexpr Real floor = 1e-16;
    const auto pieces = moments_of_pieces(covers_);
    std::vector<Real> sum(result_.points);
    for (Index e = 0; e < covers_.cut_count(); ++e) {
      std::fill(sum.begin(), sum.end(), 0);
      for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q) {
        const Real* of_piece = &pieces[static_cast<std::size_t>(q) * monomial_count];
        if (!(of_piece[0] > -1e-9))
          throw Error(ErrorKind::analysis,
                      "piece " + std::to_string(q) + " of manifold element " +
                          std::to_string(parts_ * covers_.regular_count() + e) +
                          " is inside out: its volume is " + std::to_string(of_piece[0]) +
                          " lattice cells, expected > 0");
        for (int m = 0; m < result_.points; ++m) sum[m] += of_piece[m];
      }
      const int kind = kind_of(covers_.element_cell[e], covers_.element_part[e]);
      if (sum[0] > floor) {
        add_element(kind, sum.data());
      } else {
        result_.kind.push_back(kind);
        result_.weight.insert(result_.weight.end(), result_.points,
                              floor * cell_volume(covers_.lattice) / result_.points);
      }
    }
  }

  const CoverArrays& covers_;
  const int degree_;
  int parts_ = 0;
  std::vector<const CellSplit*> forms_;
  std::vector<std::vector<Real>> inverse_;  // of each kind, [Q][Q]
  Quadrature result_;
};

}  // namespace

int quadrature_degree(const CoverArrays& covers) {
  const int nodes = covers.nodes_per_part();
  if (nodes == 1) return std::max(0, 2 * (covers.order - 1));
  // Weights are linear in tetrahedra, trilinear in hexahedra: gradients have degree order, order + 2.
  return std::min(max_degree, 2 * (covers.order + (nodes == 8 ? 2 : 0)));
}

std::vector<Vec3> function_gradients(const CoverArrays& covers, const CellSplit& split,
                                     const CellPart& part, const Vec3& eta) {
  const Mat3 reciprocal = covers.lattice.reciprocal();
  const auto weight = part_weights(part, eta);
  const auto slopes = part_slopes(part, eta);
  std::vector<Vec3> gradients;
  for (int a = 0; a < part.nodes; ++a) {
    Vec3 xi;
    for (int d = 0; d < 3; ++d) xi[d] = eta[d] - (0.5 * split.node[part.node[a]][d] - 0.5);
    const auto value = cover_functions(xi, covers.functions());
    const auto slope = cover_slopes(xi, covers.functions());
    for (int k = 0; k < covers.functions(); ++k) {
      const Vec3 local = value[k] * slopes[a] + weight[a] * slope[k];
      Vec3 g{};
      for (int d = 0; d < 3; ++d) g += local[d] * reciprocal[d];
      gradients.push_back(g);
    }
  }
  return gradients;
}

Quadrature make_quadrature(const CoverArrays& covers) {
  return Fitter(covers).run();
}

}  // namespace rockfold::finite
