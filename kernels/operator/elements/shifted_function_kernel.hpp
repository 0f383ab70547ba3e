// The functions of a part as polynomials about any point: what cut elements are integrated with.
//
// In a sliver of size ε in the corner of its cell the weights of the other corners are of order ε (ε³ in a hexahedron), and so are
// their covers' functions. As sums of monomials about the cell's centre they are small differences of large numbers, and the
// matrix of a cover that only the sliver holds is rounding alone: it need not be positive. About a point amid the sliver, with
// moments about that same point, all terms have the size of the function.
#pragma once

#include "kernels/operator/elements/element_table_kernel.hpp"

namespace rockfold::solve {

/// p(ξ) becomes p(ξ + by): Horner's scheme, one axis after the other, in place.
KOKKOS_INLINE_FUNCTION void shift_polynomial(Real* p, int degree, const Real* by) {
  using integrate::index_of;
  for (int axis = 0; axis < 3; ++axis)
    for (int sweep = 0; sweep < degree; ++sweep)
      for (int along = degree - 1; along >= sweep; --along)
        for (int i = 0; along + i < degree; ++i)
          for (int j = 0; along + i + j < degree; ++j) {
            const int at = axis == 0   ? index_of(along, i, j)
                           : axis == 1 ? index_of(i, along, j)
                                       : index_of(i, j, along);
            const int next = axis == 0   ? index_of(along + 1, i, j)
                             : axis == 1 ? index_of(i, along + 1, j)
                                         : index_of(i, j, along + 1);
            p[at] += by[axis] * p[next];
          }
}

/// Function k of node a, whose cover takes it `of`, about η = origin.
class ShiftedFunction {
 public:
  KOKKOS_INLINE_FUNCTION ShiftedFunction(const PartTable& table, int part, int a, int k,
                                         const Real* origin, const Argument& of) {
    using integrate::count_to;
    const std::size_t node = static_cast<std::size_t>(part) * table.nodes + a;
    const int weight_terms = count_to(table.weight_degree),
              polynomial_terms = count_to(table.polynomial_degree);
    Real weight[most_terms], polynomial[most_terms], by[3];
    for (int m = 0; m < weight_terms; ++m) weight[m] = table.weight(node * weight_terms + m);
    for (int m = 0; m < polynomial_terms; ++m)
      polynomial[m] = table.polynomial(k * polynomial_terms + m);
    shift_polynomial(weight, table.weight_degree, origin);
    for (int d = 0; d < 3; ++d) by[d] = origin[d] - table.place(3 * node + d) - of.middle[d];
    Real unit = 1 / of.reach;
    for (int degree = 1; degree <= table.polynomial_degree; ++degree, unit /= of.reach)
      for (int m = count_to(degree - 1); m < count_to(degree); ++m) polynomial[m] *= unit;
    shift_polynomial(polynomial, table.polynomial_degree, by);

    for (int m = 0; m < table.terms; ++m) value_[m] = 0;
    for (int m = 0; m < weight_terms; ++m)
      for (int n = 0; n < polynomial_terms; ++n)
        value_[table.sum_index(m * table.terms + n)] += weight[m] * polynomial[n];
    differentiate(table);
  }

  KOKKOS_INLINE_FUNCTION FunctionTerms terms() const {
    return {value_, {slope_[0], slope_[1], slope_[2]}};
  }

 private:
  KOKKOS_INLINE_FUNCTION void differentiate(const PartTable& table) {
    using integrate::index_of;
    for (int degree = 0; degree < table.degree; ++degree)
      for (int a = degree; a >= 0; --a)
        for (int b = degree - a; b >= 0; --b) {
          const int c = degree - a - b;
          const Real along[3] = {(a + 1) * value_[index_of(a + 1, b, c)],
                                 (b + 1) * value_[index_of(a, b + 1, c)],
                                 (c + 1) * value_[index_of(a, b, c + 1)]};
          for (int d = 0; d < 3; ++d)
            slope_[d][index_of(a, b, c)] = along[0] * table.reciprocal[0][d] +
                                           along[1] * table.reciprocal[1][d] +
                                           along[2] * table.reciprocal[2][d];
        }
    if (table.degree == 0)
      for (auto& slope : slope_) slope[0] = 0;
  }

  Real value_[most_terms], slope_[3][most_slope_terms];
};

}  // namespace rockfold::solve
