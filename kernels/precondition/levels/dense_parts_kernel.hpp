// The coarsest level of the multigrid preconditioner: its connected parts are small, each is solved by a dense inverse.
#pragma once

#include "kernels/precondition/levels/level_kernel.hpp"

namespace rockfold::solve {

struct DenseParts {
  Array<Index> part;           ///< [rows] of each row
  Array<Index> begin, member;  ///< [parts+1], rows of each part
  Array<Index> at;             ///< [rows] place among the members of the part
  Array<std::int64_t> first;   ///< [parts] of the inverse, row by row of 3·members each
  Array<float> inverse;

  bool any() const { return part.extent(0) > 0; }
};

/// Parts (the smallest row of each) and room for their inverses.
DenseParts make_dense_parts(const std::vector<Index>& part);

/// Inverts the blocks of all parts. Where a part is free to move the inverse is a generalized one (of a largest regular block).
void invert_parts(const LevelMatrix& a, const DenseParts& parts);

/// Of the coarsest level where contacts join its parts.
void factorise(CoarsestFactors& coarsest, const LevelMatrix& a);

/// x = A⁻¹ r.
void solve_parts(const DenseParts& parts, const SingleField& r, const SingleField& x);

}  // namespace rockfold::solve
