// The preconditioners as maps z = B r. Each holds views of what it is made from: it is good until those values change. `work` lends its
// space for sums.
#pragma once

#include "kernels/krylov/krylov_work_kernel.hpp"
#include "kernels/precondition/cover_grid_kernel.hpp"
#include "kernels/precondition/direct_kernel.hpp"
#include "kernels/precondition/multigrid_kernel.hpp"

namespace rockfold::solve {

/// Block Jacobi over unknowns: the inverted 3×3 blocks of the diagonal, [U].
ApplyInverse of_blocks(const Blocks& inverse, const KrylovWork& work);
/// Block Jacobi over covers, with all of their functions.
ApplyInverse of_cover_blocks(const CoverBlocks& blocks, const KrylovWork& work);
/// A cycle of multigrid, for covers of one function.
ApplyInverse of_multigrid(const Multigrid& grid, const KrylovWork& work);
/// Likewise of several; `a` applies the matrix.
ApplyInverse of_cover_grid(const CoverGrid& grid, const Apply& a, const KrylovWork& work);
/// Direct factorisation.
ApplyInverse of_factors(const Factors& factors, const KrylovWork& work);

}  // namespace rockfold::solve
