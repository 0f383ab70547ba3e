// The affine motion of a block from that of its points.
#pragma once

#include <array>
#include <vector>

#include "src/page/page_surface.hpp"

namespace rockfold {

/// d, then the rows of G: the displacement at x is d + G (x − c), c the mean of the block's points.
using AffineMotion = std::array<float, 12>;

/// Means of each block's points, [N] m.
std::vector<Vec3> block_middles(const PageSurface& surface);

/// Fits the displacement [P][3] of one state by least squares, block by block. `miss` is the largest distance (m) of a
/// point from where its block's motion takes it.
struct FittedMotion {
  std::vector<AffineMotion> block;  ///< [N]
  Real miss = 0;
};
FittedMotion fit_block_motions(const PageSurface& surface, const std::vector<Vec3>& middle,
                               const std::vector<float>& displacement);

}  // namespace rockfold
