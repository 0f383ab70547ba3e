#include "kernels/operator/elements/part_functions.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/operator/elements/part_table_kernel.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

using integrate::count_to;

/// A polynomial in three variables.
struct Polynomial {
  int degree = 0;
  std::vector<Real> term;  ///< [count_to(degree)]

  explicit Polynomial(int of_degree) : degree(of_degree), term(count_to(of_degree), 0.0) {}
  Real& at(int a, int b, int c) { return term[monomial_index(a, b, c)]; }
  Real at(int a, int b, int c) const { return term[monomial_index(a, b, c)]; }
};

template <class Visit>
void for_each_monomial(int degree, Visit visit) {
  for (int n = 0; n <= degree; ++n)
    for (int a = n; a >= 0; --a)
      for (int b = n - a; b >= 0; --b) visit(a, b, n - a - b);
}

/// The product, cut off at a degree that the caller knows it to have.
Polynomial product(const Polynomial& p, const Polynomial& q, int degree) {
  Polynomial result(degree);
  for_each_monomial(p.degree, [&](int a, int b, int c) {
    if (p.at(a, b, c) == 0) return;
    for_each_monomial(q.degree, [&](int i, int j, int k) {
      if (q.at(i, j, k) != 0) result.at(a + i, b + j, c + k) += p.at(a, b, c) * q.at(i, j, k);
    });
  });
  return result;
}

/// (η_axis − by)^power
Polynomial shifted_power(int axis, Real by, int power) {
  Polynomial result(0);
  result.term[0] = 1;
  Polynomial factor(1);
  factor.term[0] = -by;
  factor.term[1 + axis] = 1;
  for (int i = 0; i < power; ++i) result = product(result, factor, i + 1);
  return result;
}

/// m(η − η_a) in η.
Polynomial about_node(const std::vector<Real>& function, int degree, const Vec3& node) {
  Polynomial result(degree);
  for_each_monomial(degree, [&](int a, int b, int c) {
    const Real factor = function[monomial_index(a, b, c)];
    if (factor == 0) return;
    const Polynomial xy =
        product(shifted_power(0, node[0], a), shifted_power(1, node[1], b), a + b);
    const Polynomial xyz = product(xy, shifted_power(2, node[2], c), a + b + c);
    for (std::size_t m = 0; m < xyz.term.size(); ++m) result.term[m] += factor * xyz.term[m];
  });
  return result;
}

/// N_a, of degree 3 as stored.
Polynomial weight(const CellPart& part, int a) {
  Polynomial result(3);
  for (int m = 0; m < 8; ++m) result.at(m & 1, m >> 1 & 1, m >> 2) = part.weight[a][m];
  return result;
}

int weight_degree(const CellPart& part) {
  return part.nodes == 1 ? 0 : part.nodes == 4 ? 1 : 3;
}

/// Coefficients of ∂p/∂x_d, d the axis in space.
std::vector<Real> slope(const Polynomial& p, int d, const Mat3& reciprocal, int terms) {
  std::vector<Real> result(terms, 0.0);
  for_each_monomial(p.degree, [&](int a, int b, int c) {
    const std::array<int, 3> power{a, b, c};
    for (int axis = 0; axis < 3; ++axis) {
      if (power[axis] == 0) continue;
      auto lower = power;
      --lower[axis];
      result[monomial_index(lower[0], lower[1], lower[2])] +=
          power[axis] * reciprocal[axis][d] * p.at(a, b, c);
    }
  });
  return result;
}

Vec3 place(const CellSplit& split, int node) {
  const HalfSteps& at = split.node[node];
  return {0.5 * at[0] - 0.5, 0.5 * at[1] - 0.5, 0.5 * at[2] - 0.5};
}

/// Triangles of a tetrahedron's or a hexahedron's boundary, seen from outside, by its nodes.
std::vector<std::array<int, 3>> boundary(int nodes) {
  if (nodes == 4) return {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  if (nodes == 8)
    return {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
            {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return {};
}

/// ∫ η^m over the whole part, in units of the cell's edges.
std::vector<Real> whole_moments(const CellSplit& split, const CellPart& part, int degree) {
  integrate::BodyIntegral<2 * solve::most_degree> body;
  for (const auto& triangle : boundary(part.nodes)) {
    Real v[3][3];
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 3; ++d) v[k][d] = place(split, part.node[triangle[k]])[d];
    body.add(v);
  }
  body.finish();
  return {body.sum, body.sum + count_to(degree)};
}

PartFunctions part_functions(const LatticeFunctions& all, const CellSplit& split,
                             const CellPart& part, const CoverPolynomials& polynomials,
                             Real cell_volume) {
  PartFunctions result;
  for (int a = 0; a < part.nodes; ++a) {
    result.node.push_back(part.node[a]);
    result.place.push_back(place(split, part.node[a]));
    const Polynomial n = weight(part, a);
    result.weight.insert(result.weight.end(), n.term.begin(),
                         n.term.begin() + count_to(all.weight_degree));
    for (const auto& function : polynomials.function) {
      const Polynomial phi =
          product(n, about_node(function, polynomials.degree, result.place.back()), all.degree);
      result.value.insert(result.value.end(), phi.term.begin(), phi.term.end());
      for (int d = 0; d < 3; ++d) {
        const auto terms = slope(phi, d, all.reciprocal, all.slope_terms());
        result.slope.insert(result.slope.end(), terms.begin(), terms.end());
      }
    }
  }
  result.moment = whole_moments(split, part, all.moment_degree());
  for (Real& m : result.moment) m *= cell_volume;
  return result;
}

}  // namespace

int LatticeFunctions::terms() const {
  return count_to(degree);
}
int LatticeFunctions::slope_terms() const {
  return count_to(std::max(degree - 1, 0));
}

std::vector<Real> LatticeFunctions::values(int of, const Vec3& eta) const {
  std::vector<Real> monomial(terms()), value(nodes * functions);
  solve::fill_monomials(eta.data(), degree, monomial.data());
  for (std::size_t f = 0; f < value.size(); ++f)
    value[f] = solve::dot_terms(&part[of].value[f * terms()], monomial.data(), terms());
  return value;
}

std::vector<Vec3> LatticeFunctions::gradients(int of, const Vec3& eta) const {
  std::vector<Real> monomial(slope_terms());
  solve::fill_monomials(eta.data(), std::max(degree - 1, 0), monomial.data());
  std::vector<Vec3> gradient(nodes * functions);
  for (std::size_t f = 0; f < gradient.size(); ++f)
    for (int d = 0; d < 3; ++d)
      gradient[f][d] = solve::dot_terms(&part[of].slope[(3 * f + d) * slope_terms()],
                                        monomial.data(), slope_terms());
  return gradient;
}

CoverPolynomials cover_polynomials(int order) {
  CoverPolynomials polynomials;
  polynomials.degree = order;
  // The order of shape_functions.hpp: ones, then each ξ_d, then squares, then products.
  std::vector<std::array<int, 3>> power{{0, 0, 0}};
  if (order > 0) power.insert(power.end(), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  if (order > 1)
    power.insert(power.end(), {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}});
  for (const auto& p : power) {
    polynomials.function.emplace_back(count_to(order), 0.0);
    polynomials.function.back()[monomial_index(p[0], p[1], p[2])] = 1;
  }
  return polynomials;
}

LatticeFunctions lattice_functions(const Lattice& lattice, int order) {
  const CoverPolynomials polynomials = cover_polynomials(order);
  const CellSplit& split = cell_split(lattice.kind);
  LatticeFunctions all;
  all.forms = lattice.kind == LatticeKind::tet5 ? 2 : 1;
  all.parts = split.part_count();
  all.nodes = split.nodes_per_part();
  all.cell_nodes = split.node_count();
  all.functions = polynomials.functions();
  all.weight_degree = weight_degree(split.part.front());
  all.polynomials = polynomials;
  all.degree = all.weight_degree + polynomials.degree;
  all.share = split.share;
  all.reciprocal = lattice.reciprocal();
  const Real volume =
      std::abs(dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2]))) * split.share;
  for (int form = 0; form < all.forms; ++form) {
    const CellSplit& of_form = cell_split(lattice.kind, form == 1);
    for (const CellPart& part : of_form.part)
      all.part.push_back(part_functions(all, of_form, part, polynomials, volume));
  }
  return all;
}

LatticeFunctions lattice_functions(const CoverArrays& covers) {
  return lattice_functions(covers.lattice, covers.order);
}

namespace solve {

PartTable make_part_table(const LatticeFunctions& all) {
  PartTable table;
  table.forms = all.forms;
  table.parts = all.parts;
  table.nodes = all.nodes;
  table.cell_nodes = all.cell_nodes;
  table.functions = all.functions;
  table.width = all.nodes * all.functions;
  table.degree = all.degree;
  table.terms = all.terms();
  table.slope_terms = all.slope_terms();
  table.moments = count_to(all.moment_degree());
  table.weight_degree = all.weight_degree;
  table.polynomial_degree = all.polynomials.degree;
  table.share = all.share;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) table.reciprocal[i][j] = all.reciprocal[i][j];
  std::vector<Index> node;
  std::vector<Real> value, slope, moment, place, weight, polynomials;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const PartFunctions& part : all.part) {
    append(node, part.node);
    append(value, part.value);
    append(slope, part.slope);
    append(moment, part.moment);
    append(weight, part.weight);
    for (const Vec3& eta : part.place) append(place, eta);
  }
  for (const auto& function : all.polynomials.function) append(polynomials, function);
  std::vector<std::array<int, 3>> power;
  for_each_monomial(all.degree, [&](int a, int b, int c) { power.push_back({a, b, c}); });
  std::vector<Index> sum_index;
  for (const auto& p : power)
    for (const auto& q : power)
      sum_index.push_back(monomial_index(p[0] + q[0], p[1] + q[1], p[2] + q[2]));
  table.sum_index = device::to_device("solve::sum_index", sum_index);
  table.node = device::to_device("solve::part_node", node);
  table.value = device::to_device("solve::part_value", value);
  table.slope = device::to_device("solve::part_slope", slope);
  table.moment = device::to_device("solve::part_moment", moment);
  table.place = device::to_device("solve::part_place", place);
  table.weight = device::to_device("solve::part_weight", weight);
  table.polynomial = device::to_device("solve::cover_polynomials", polynomials);
  return table;
}

}  // namespace solve
}  // namespace rockfold
