// The states of a run as a page stores them: motion and stress of the points, or of blocks as a whole.
#pragma once

#include <vector>

#include "src/page/page_arrays.hpp"
#include "src/page/page_surface.hpp"

namespace rockfold {

/// The states that a page shows: 0, N, 2N, … and the last. [S]
std::vector<Index> shown_states(const hdf5::File& file, Index every);

/// Adds, for the shown states (S of them):
///   state_time [S] s, state_step [S]
///   block_motion [S][N][12], where every block moves as a whole: displacement = d + G (x − c) about its points' mean
///     c (block_middle [N][3], relative to `origin`), as d, then the rows of G; or
///   point_displacement [S][3][P] of which one unit is displacement_unit[s] m
///   von_mises, sigma_1, sigma_3, strength_ratio: [S][P] over 0 … 1000 = FIELD_range [2], at points of elements; or
///   block_stress [S][N][6] Pa, the means of the blocks
void add_states(const hdf5::File& file, const PageSurface& surface,
                const std::vector<Index>& states, const Vec3& origin, PageArrays& arrays);

}  // namespace rockfold
