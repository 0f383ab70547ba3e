// The functions of an element on the host: weights of its nodes times the cover functions of theirs.
//
// With φ_ak(η) = N_a(η) m_k(η − η_a) the displacement in an element is Σ_ak φ_ak d_ak. Cover functions m_k are the monomials
// up to the cover's order in lattice coordinates about its own node:
//   order 0: 1;  order 1: ξ_0 ξ_1 ξ_2;  order 2: ξ_0² ξ_1² ξ_2² ξ_0ξ_1 ξ_1ξ_2 ξ_2ξ_0
// or, in rock that is smaller than a lattice cell, about the middle of what rock the cover holds (CoverArrays::middle).
// It is the same space as the thesis' (Eq. 4-6), far better conditioned.
#pragma once

#include <array>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// A function of position at a point.
struct FunctionValue {
  Real value = 0;
  Vec3 gradient{};  ///< 1/m
};

/// Of a cover. The kernels' stack arrays have room for so many.
inline constexpr int most_functions = 10;

/// How many cover functions an order has: 1, 4, 10.
constexpr int functions_of_order(int order) {
  return order == 0 ? 1 : order == 1 ? 4 : 10;
}

/// The monomials m_k(ξ), k < functions.
std::array<Real, most_functions> cover_functions(const Vec3& xi, int functions);

/// All functions of a cover at ξ.
std::array<Real, most_functions> cover_functions(const CoverArrays& covers, Index cover,
                                                 const Vec3& xi);

/// Where the linear functions of a cover vanish: m, its node or the middle of its rock.
Vec3 function_origin(const CoverArrays& covers, Index cover);

/// Of an element's functions: to which polynomials are integrated exactly where functions are evaluated at points.
int sampling_degree(const CoverArrays& covers);

/// N_a(η) of a part's nodes.
std::array<Real, 8> part_weights(const CellPart& part, const Vec3& eta);

/// Which of the forms of its split a lattice cell has: 1 for the odd one of tet5, else 0.
int form_of_cell(const Lattice& lattice, Index cell);

/// Where an element lies and which physical covers it belongs to.
struct ElementNodes {
  Index cell = none;             ///< lattice cell
  int part = 0;                  ///< into its split
  std::array<Index, 8> cover{};  ///< of the part's nodes
};
/// Elements are numbered as in CoverArrays.
ElementNodes element_nodes(const CoverArrays& covers, Index element);
/// The block of an element; of welded rock that of its first piece.
Index block_of(const CoverArrays& covers, Index element);
/// Into Model::materials.
Index material_of(const CoverArrays& covers, Index element);

/// All φ_ak with their gradients, of any element at any point: for what is integrated or evaluated on the host.
class ElementFunctions {
 public:
  explicit ElementFunctions(const CoverArrays& covers);

  int width() const { return width_; }  ///< nodes of a part · functions of a cover
  /// φ_ak and ∂φ_ak/∂x at η, [a · functions + k].
  void at(const ElementNodes& element, const Vec3& eta, FunctionValue* function) const;

 private:
  const CoverArrays& covers_;
  Mat3 reciprocal_;   // gradients of η, 1/m
  Mat3 of_argument_;  // of what the monomials are taken of
  int functions_, width_;
};

/// Adds the material point x (m) of an element to `points`. Where two splits are overlaid (tet5_mixed), `other` is
/// the element of the second split that holds it, and the point moves by the mean of the two.
void add_material_point(const CoverArrays& covers, const Vec3& x, Index element,
                        MaterialPoints& points, Index other = none);

/// m, of a point of `points` that has an element.
Vec3 point_position(const CoverArrays& covers, const MaterialPoints& points, std::size_t n);

/// Σ weight · field over a point's unknowns.
template <class T>
T interpolate(const MaterialPoints& points, std::size_t n, const std::vector<T>& field) {
  T sum{};
  for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
    for (std::size_t d = 0; d < sum.size(); ++d)
      sum[d] += points.weight[i] * field[points.unknown[i]][d];
  return sum;
}

}  // namespace rockfold
