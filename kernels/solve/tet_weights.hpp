// The weight functions of the six tetrahedra of a lattice cell: N_a(x) = constant[a] + gradient[a] · x inside, with x from the
// cell's centre. The same in every cell of a lattice.
#pragma once

#include <array>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

struct TetWeights {
  std::array<Real, 4> constant{};  ///< at the centre of the lattice cell
  std::array<Vec3, 4> gradient{};  ///< 1/m
  Real volume = 0;                 ///< m³ of the whole tetrahedron
  Vec3 first{};                    ///< m⁴, its first moments about the cell's centre
};

std::array<TetWeights, 6> tet_weights(const Lattice& lattice);

}  // namespace rockfold
