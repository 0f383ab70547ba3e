// The inner loop of stencil rows on a core. Plain C++, compiled for each instruction set where the compiler can; without
// contracted multiply-adds (see src/build_settings.cmake) all versions give the same digits.
#pragma once

#include "src/base/types.hpp"

namespace rockfold::solve {

/// Pointers to the three components of consecutive covers.
struct Components {
  const Real* x[3];
};

/// y_i[k] = scale · x_i[k] for k < length.
void stencil_start(Index length, Real scale, const Components& x, Real* const* y);

/// y_i[k] += Σ_j c[3i+j] ((plus_j[k] − x_j[k]) + (minus_j[k] − x_j[k])) for k < length.
void stencil_add(Index length, const Real* c, const Components& x, const Components& plus,
                 const Components& minus, Real* const* y);

}  // namespace rockfold::solve
