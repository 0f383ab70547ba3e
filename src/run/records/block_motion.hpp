// The motion of each block as a whole, from the motion of the covers.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// Averages over the blocks' volume; `displacement` is that of the covers. With `large` kinematics the rotation is that of
/// the mean deformation gradient (up to half a turn) and the volume that of the deformed block, by the means of its elements.
std::vector<BlockMotion> average_block_motion(const CoverArrays& covers,
                                              const PieceMoments& moments,
                                              const std::vector<Vec3>& displacement, Index blocks,
                                              bool large = false);

/// Over the lattice nodes of whole cells and the vertices of cut elements but slivers beside others of their block, whose corners hardly resist; the displacement is that
/// of the covers.
LargestDisplacement find_largest_displacement(const CoverArrays& covers,
                                              const PieceMoments& moments,
                                              const std::vector<Vec3>& displacement);

}  // namespace rockfold
