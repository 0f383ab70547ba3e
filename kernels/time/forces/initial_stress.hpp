// The stress that is in the rock before anything moves.
#pragma once

#include <array>
#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/arrays/load_arrays.hpp"

namespace rockfold::motion {

/// Pa at the height z.
std::array<Real, 6> stress_at(const InitialStress& stress, Real z);

/// m: heights of the elements' lattice cells and of the elements' centroids, in the element numbering of CoverArrays.
struct ElementHeights {
  std::vector<Real> cell, centroid;
};
ElementHeights element_heights(const CoverArrays& covers, const PieceMoments& moments);

/// [U] ∫ Bᵀ σ0 dV, N: what the covers are pulled with by the initial stress; exact, the stress being linear in z.
std::vector<Vec3> initial_stress_force(const CoverArrays& covers, const PieceMoments& moments,
                                       const InitialStress& stress);

}  // namespace rockfold::motion
