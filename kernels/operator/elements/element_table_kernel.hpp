// Every manifold element, whole and cut, in the numbering of CoverArrays: its part, covers, material and moments.
#pragma once

#include "kernels/operator/elements/element_kernel.hpp"

namespace rockfold::solve {

/// Cover functions are monomials of (ξ − middle) / reach.
struct Argument {
  Real middle[3];
  Real reach;
};

struct ElementTable {
  PartTable parts;
  int functions = 0;           ///< of a cover
  Index covers = 0;            ///< P
  Index regular = 0, cut = 0;  ///< lattice cells, elements
  Array<Index> regular_cover;  ///< [R][nodes of a cell]
  Array<Index> regular_material;
  Array<std::uint8_t> regular_form;  ///< [R]
  Array<Index> element_cover;        ///< [E][nodes of a part]
  Array<Index> element_material;
  Array<std::uint8_t> element_part;  ///< [E] form · parts + part
  Array<Real> cut_moment;            ///< [E][moments], m³, times the share of the split
  Array<Real> amid_moment;  ///< [E][moments] likewise about `origin`; empty for linear functions
  Array<Real> origin;       ///< [E][3] η amid the element
  Array<Real> middle;       ///< [P][3] of cover functions, or empty
  Real reach = 1;
  Array<Elastic> elastic;  ///< [materials]
  Array<Real>
      mean_slope;  ///< [elements][width][3] 1/m where elements differ in their functions and it is wanted; else empty

  KOKKOS_INLINE_FUNCTION Index count() const { return parts.parts * regular + cut; }
  KOKKOS_INLINE_FUNCTION bool whole(Index e) const { return e < parts.parts * regular; }
  KOKKOS_INLINE_FUNCTION int part(Index e) const {
    return whole(e) ? regular_form(e / parts.parts) * parts.parts + e % parts.parts
                    : element_part(e - parts.parts * regular);
  }
  KOKKOS_INLINE_FUNCTION Index material(Index e) const {
    return whole(e) ? regular_material(e / parts.parts)
                    : element_material(e - parts.parts * regular);
  }
  /// The cover of node a of the element's part; its function k is unknown k · covers + that.
  KOKKOS_INLINE_FUNCTION Index cover(Index e, int a) const {
    return whole(e)
               ? regular_cover(e / parts.parts * parts.cell_nodes + parts.cell_node(part(e), a))
               : element_cover((e - parts.parts * regular) * parts.nodes + a);
  }
  KOKKOS_INLINE_FUNCTION Argument argument(Index cover) const {
    Argument of{{0, 0, 0}, reach};
    if (middle.extent(0) > 0)
      for (int d = 0; d < 3; ++d) of.middle[d] = middle(3 * static_cast<std::size_t>(cover) + d);
    return of;
  }
  /// [parts.moments] ∫ η^m dV about the centre of the element's lattice cell, m³.
  KOKKOS_INLINE_FUNCTION const Real* moments(Index e) const {
    return whole(e)
               ? parts.whole(part(e))
               : &cut_moment(static_cast<std::size_t>(e - parts.parts * regular) * parts.moments);
  }
};

/// Throws Error(analysis) where the moments are not of the degree that the functions need.
ElementTable make_element_table(const CoverArrays& covers, const PieceMoments& moments,
                                const std::vector<ElasticMaterial>& materials);

/// h[i][j] = ∂u_i/∂x_j of an element from the gradients of its functions. Functions 0 enter by differences to the first
/// node's: a translation leaves exactly nothing.
template <class Motion>
KOKKOS_INLINE_FUNCTION void displacement_gradient(const ElementTable& table, Index e,
                                                  const Real (*gradient)[3], const Motion& d,
                                                  Real (*h)[3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) h[i][j] = 0;
  const int functions = table.functions;
  const Index first = table.cover(e, 0);
  for (int a = 0; a < table.parts.nodes; ++a) {
    const Index cover = table.cover(e, a);
    for (int k = 0; k < functions; ++k) {
      if (a == 0 && k == 0) continue;
      const Real* g = gradient[a * functions + k];
      for (int i = 0; i < 3; ++i) {
        const Real u = d(k * table.covers + cover, i) - (k == 0 ? d(first, i) : 0);
        for (int j = 0; j < 3; ++j) h[i][j] += u * g[j];
      }
    }
  }
}

}  // namespace rockfold::solve
