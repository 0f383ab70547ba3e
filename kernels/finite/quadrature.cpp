#include "kernels/finite/quadrature.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/integrate/moments.hpp"
#include "kernels/solve/part_functions.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold::finite {

namespace {

/// Exact for the strain energy of small strain: twice the degree of the functions' gradients.
int quadrature_degree(const LatticeFunctions& functions) {
  return 2 * std::max(0, functions.degree - 1);
}

/// Exponents in the order of monomial_index.
std::vector<std::array<int, 3>> exponents(int degree) {
  std::vector<std::array<int, 3>> list(static_cast<std::size_t>(degree + 1) * (degree + 2) *
                                       (degree + 3) / 6);
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

/// Points of a part and what makes weights of moments.
struct Rule {
  std::vector<Vec3> point;   ///< [n] η
  std::vector<Real> weight;  ///< [n][n]: weight of point q = Σ_m weight[q][m] · moment m
};

class Fitter {
 public:
  Fitter(const CoverArrays& covers, const PieceMoments& moments)
      : covers_(covers), moments_(moments), functions_(lattice_functions(covers)) {}

  Quadrature run() {
    result_.functions = functions_.nodes * functions_.functions;
    for (int form = 0; form < functions_.forms; ++form)
      for (const CellPart& part : cell_split(covers_.lattice.kind, form == 1).part) add_kind(part);
    result_.points = static_cast<int>(rules_.front().point.size());
    add_regular();
    if (degree_ == 0)
      add_cut();
    else
      add_cut_in_boxes();
    return std::move(result_);
  }

 private:
  void add_kind(const CellPart& part) {
    const auto& split = cell_split(covers_.lattice.kind,
                                   rules_.size() >= static_cast<std::size_t>(functions_.parts));
    const auto points = part_points(split, part, degree_);
    rules_.push_back({points, fitting(points, degree_)});
    for (const Vec3& eta : points) add_point(static_cast<int>(rules_.size()) - 1, eta);
    ++result_.kinds;
  }

  void add_point(int part, const Vec3& eta) {
    result_.place.push_back(eta);
    const auto gradients = functions_.gradients(part, eta);
    result_.gradient.insert(result_.gradient.end(), gradients.begin(), gradients.end());
  }

  int kind_of(Index cell, int part) const {
    return functions_.parts * LatticeFunctions::form(covers_.lattice, cell) + part;
  }

  void add_element(int kind, const Rule& rule, const Real* moments, Real share) {
    result_.kind.push_back(kind);
    const std::size_t n = rule.point.size();
    for (std::size_t q = 0; q < n; ++q) {
      Real sum = 0;
      for (std::size_t m = 0; m < n; ++m) sum += rule.weight[q * n + m] * moments[m];
      result_.weight.push_back(share * sum);
    }
  }

  void add_regular() {
    for (Index r = 0; r < covers_.regular_count(); ++r)
      for (int t = 0; t < functions_.parts; ++t) {
        const int kind = kind_of(covers_.regular_cell[r], t);
        add_element(kind, rules_[kind], functions_.part[kind].moment.data(), 1);
      }
  }

  void add_cut() {
    for (Index e = 0; e < covers_.cut_count(); ++e) {
      const int kind = kind_of(covers_.element_cell[e], covers_.element_part[e]);
      add_element(kind, rules_[kind], sum_pieces(moments_.local, e).data(), functions_.share);
    }
  }

  void add_cut_in_boxes() {
    const std::vector<Vec3> points = cell_points(degree_);
    const Rule rule{points, fitting(points, degree_)};
    const auto powers = exponents(degree_);
    for (Index e = 0; e < covers_.cut_count(); ++e) {
      const Vec3& origin = moments_.origin[e];
      const Vec3 edge = box_about(origin, e);
      std::vector<Real> sum = sum_pieces(moments_.amid, e);
      for (std::size_t m = 0; m < powers.size(); ++m)
        for (int d = 0; d < 3; ++d) sum[m] /= std::pow(edge[d], powers[m][d]);
      const int part = kind_of(covers_.element_cell[e], covers_.element_part[e]);
      for (const Vec3& p : points) {
        Vec3 eta = origin;
        for (int d = 0; d < 3; ++d) eta[d] += edge[d] * p[d];
        add_point(part, eta);
      }
      add_element(result_.kinds++, rule, sum.data(), functions_.share);
    }
  }

  /// Of one cut element.
  std::vector<Real> sum_pieces(const std::vector<Real>& moment, Index e) const {
    const std::size_t terms = moment.size() / covers_.piece_block.size();
    std::vector<Real> sum(terms, 0);
    for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q)
      for (std::size_t m = 0; m < terms; ++m) sum[m] += moment[terms * q + m];
    return sum;
  }

  /// The edges of the box with the given centre that holds the element, η.
  Vec3 box_about(const Vec3& centre, Index e) const {
    Vec3 half{};
    const Index first = 3 * covers_.triangle_begin[covers_.piece_begin[e]],
                last = 3 * covers_.triangle_begin[covers_.piece_begin[e + 1]];
    for (Index c = first; c < last; ++c) {
      const Real* x = &covers_.vertex_xyz[3 * covers_.triangle_vertex[c]];
      for (int d = 0; d < 3; ++d) {
        const Vec3& row = functions_.reciprocal[d];
        const Real eta = row[0] * x[0] + row[1] * x[1] + row[2] * x[2];
        half[d] = std::max(half[d], std::abs(eta - centre[d]));
      }
    }
    for (Real& h : half) h = std::max(h, 1e-15);  // of a piece that rounding has flattened
    return 2.0 * half;
  }

  const CoverArrays& covers_;
  const PieceMoments& moments_;
  const LatticeFunctions functions_;
  const int degree_ = quadrature_degree(functions_);
  std::vector<Rule> rules_;  // of each kind
  Quadrature result_;
};

}  // namespace

Quadrature make_quadrature(const CoverArrays& covers, const PieceMoments& moments) {
  if (covers.series)
    throw Error(
        ErrorKind::analysis,
        "local series: found kinematics = \"large\"; must be \"small\" (analysis.kinematics)");
  return Fitter(covers, moments).run();
}

}  // namespace rockfold::finite
