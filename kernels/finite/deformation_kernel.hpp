// Elements under finite strain on the device: St. Venant–Kirchhoff elasticity in the undeformed state,
//   F = I + H,  H = ∂u/∂X,  E = ½ (H + Hᵀ + HᵀH),  S = S₀ + λ tr(E) I + 2μ E,  f_i = ∫ F S ∇φ_i dV.
// A rotation leaves E = 0 to rounding however far it goes: no strain, no growth of the volume.
//
// H is evaluated at the element's quadrature points from differences to the first node's constant: a translation leaves none
// at all. A step's forces may be taken at its end, or as Simo & Tarnow (Z. angew. Math. Phys. 43 (1992) 757) take them: F in
// the middle, S as the mean of both ends, which keeps momentum, angular momentum and energy.
#pragma once

#include "kernels/finite/quadrature.hpp"
#include "kernels/operator/operator_kernel.hpp"
#include "src/arrays/load_arrays.hpp"

namespace rockfold::finite {

using device::Array;
using device::Field;

/// Where in a step forces are taken.
struct ForceRule {
  bool middle = false;  ///< energy–momentum; otherwise at the end
  /// Rayleigh damping: S += viscosity · C : (E end − E start), and C : Deformation::carried where `carries`. By rule `middle` it is β
  /// over the step's length; at the end βγ_N/(β_N Δt), as Newmark's formulas find the strain rate there.
  Real viscosity = 0;
  Array<Real> stiffening = {};  ///< [elements] what each has beyond that; empty: none
  Real of_stiffening = 1;
  bool carries = false;
  bool geometric = true;  ///< the part of the tangent that the stress makes
  KOKKOS_INLINE_FUNCTION Real viscosity_of(Index e) const {
    return stiffening.extent(0) == 0 ? viscosity : viscosity + of_stiffening * stiffening(e);
  }
};

struct Deformation {
  Index elements = 0, covers = 0;
  int nodes = 0, functions = 0, points = 0;  ///< of an element, of a cover, of an element
  int stride = 0;                            ///< ≥ nodes·functions
  Array<Real> gradient;   ///< [kinds][points][3][stride] 1/m, zero beyond nodes·functions
  Array<int> kind;        ///< [elements]
  Array<Real> weight;     ///< [elements][points] m³
  Array<Index> cover;     ///< [elements][nodes]
  Array<Index> material;  ///< [elements]
  Array<solve::Elastic> elastic;
  Array<Real> initial;        ///< [elements][points][6] S₀, Pa; empty where there is none
  Array<Index> begin;         ///< [covers+1]
  Array<std::int64_t> entry;  ///< nodes·e + a: the elements of each cover
  Array<Real> start, now;     ///< [elements][points][9] H at the step's start, and now
  Array<Real> carried;        ///< [elements][points][6] see carry_rate; empty until it is called
  Array<Real> force;          ///< [elements][points][9] weight · F S, by rule
  KOKKOS_INLINE_FUNCTION int width() const { return nodes * functions; }
  /// [3][stride] of an element at point q.
  KOKKOS_INLINE_FUNCTION const Real* gradients(Index e, int q) const {
    return &gradient((static_cast<std::size_t>(kind(e)) * points + q) * 3 * stride);
  }
};

Deformation make_deformation(const CoverArrays& covers, const PieceMoments& moments,
                             const std::vector<ElasticMaterial>& materials,
                             const InitialStress& initial);

/// H from the unknowns.
void deform(const Deformation& body, const Field& displacement);
/// The step is accepted: start = now.
void keep(const Deformation& body);

/// What the rates at the step's start add to the strain rate that damps (see ForceRule):
///   carried = of_velocity · Ė + of_acceleration · Ë,  Ė = sym(Fᵀ ∇v),  Ë = sym(Fᵀ ∇a) + ∇vᵀ ∇v
void carry_rate(Deformation& body, const Field& velocity, Real of_velocity,
                const Field& acceleration, Real of_acceleration);

/// J: ∫ (E end − E start) : η · C : (E end − E start) dV, η = `viscosity` + `more` [elements] (empty: nothing).
Real viscous_work(const Deformation& body, Real viscosity, const Array<Real>& more,
                  const Array<Real>& partial, const Array<Real>& sums);

/// f = ∫ F S ∇φ over all unknowns, N.
void internal_forces(const Deformation& body, const ForceRule& rule, const Field& f);

/// Writes the stiffness of all block rows: the derivative of the forces (twice it, by rule `middle`, with F in the middle on both
/// sides: symmetric, and right where a step turns little).
void assemble_tangent(const Deformation& body, const ForceRule& rule,
                      const solve::DeviceBlocks& block);

/// Turns a correction x found with the tangent of rule `middle` from the middle of the step to its end, cover by cover. The exact
/// derivative is Bᵀ(F middle) C B(F end): not symmetric. With F end = Q · F middle, Q a rotation, B(F end) x is B(F middle) Qᵀx, so
/// that the symmetric tangent finds Qᵀx. Without this a rotation of the correction would strain, and steps that turn
/// stiff blocks far would never converge.
void turn_from_middle(const Deformation& body, const Field& x);

/// J now, beside that of the undeformed state.
Real strain_energy(const Deformation& body, const Array<Real>& partial, const Array<Real>& sums);

/// Cauchy stress F S Fᵀ / det F now, mean over each element, Pa xx yy zz xy yz zx, [6·elements].
void mean_stress(const Deformation& body, const Array<Real>& stress);
/// The first element with det F <= 0, or none. Points outside the rock, whose weights are not positive, do not count; nor do
/// slivers that no solution resolves: those whose forces at a strain of 1 are below `least`, N.
Index first_inverted(const Deformation& body, Real least);
/// The largest root of the sum of squares of the terms of H at an element's first point: displacements carry rounding in their own measure,
/// however little they strain, and of many terms it adds up so.
Real largest_terms(const Deformation& body, const Field& d);
/// N: the forces of a strain of one rounding error everywhere, as large as it is on average.
Real rounding_force(const Deformation& body, const Array<Real>& partial, const Array<Real>& sums);

}  // namespace rockfold::finite
