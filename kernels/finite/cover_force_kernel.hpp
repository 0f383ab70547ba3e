// H at a point, and the forces of rock that has one cover to itself: one thread finds them.
#pragma once

#include "kernels/finite/deformation_kernel.hpp"
#include "kernels/finite/strain_kernel.hpp"

namespace rockfold::finite {

/// H at one point: Σ over nodes and functions of d ⊗ ∇φ, constants as differences to the first node's.
KOKKOS_INLINE_FUNCTION void gradient_at(const Deformation& body, const Field& d, Index e, int q,
                                        Real* h) {
  const Index* cover = &body.cover(static_cast<std::size_t>(e) * body.nodes);
  const Real* g = body.gradients(e, q);
  for (int i = 0; i < 9; ++i) h[i] = 0;
  for (int a = 0; a < body.nodes; ++a)
    for (int k = 0; k < body.functions; ++k, ++g)
      for (int i = 0; i < 3; ++i) {
        const Real u =
            d(k * body.covers + cover[a], i) - (k == 0 && body.nodes > 1 ? d(cover[0], i) : 0);
        for (int j = 0; j < 3; ++j) h[3 * i + j] += u * g[j * body.stride];
      }
}

/// f[3k + i] −= ∫ F S ∇φ of cover p, whose elements have no other, displaced by d; turn: the rotation of its mean F, none where that has none.
KOKKOS_INLINE_FUNCTION void take_internal_force(const Deformation& body, const Field& d, Index p,
                                                Real* f, Real* turn) {
  Real mean[9] = {};
  for (Index s = body.begin(p); s < body.begin(p + 1); ++s) {
    const Index e = static_cast<Index>(body.entry(s) / body.nodes);
    const solve::Elastic& material = body.elastic(body.material(e));
    for (int q = 0; q < body.points; ++q) {
      const std::size_t at = static_cast<std::size_t>(e) * body.points + q;
      Real h[9], strain[6], stress[6], p1[9];
      gradient_at(body, d, e, q, h);
      for (int k = 0; k < 6; ++k)
        stress[k] = body.initial.extent(0) == 0 ? 0 : body.initial(6 * at + k);
      green_strain(h, strain);
      add_elastic_stress(material, 1, strain, stress);
      first_stress(h, stress, p1);
      const Real weight = body.weight(at), share = device::math::fabs(weight);
      for (int i = 0; i < 9; ++i) mean[i] += share * (h[i] + (i % 4 == 0 ? 1 : 0));
      const Real* g = body.gradients(e, q);
      for (int k = 0; k < body.functions; ++k, ++g)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) f[3 * k + i] -= weight * p1[3 * i + j] * g[j * body.stride];
    }
  }
  const Real size = device::math::cbrt(determinant(mean));
  for (int i = 0; i < 9; ++i) turn[i] = size > 0 ? mean[i] / size : 0;
  if (size > 0 && make_rotation(turn)) return;
  for (int i = 0; i < 9; ++i) turn[i] = i % 4 == 0 ? 1 : 0;
}

}  // namespace rockfold::finite
