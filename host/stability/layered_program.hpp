// A large linear programme solved from its first rows on, layer by layer.
#pragma once

#include <vector>

#include "host/stability/linear_program.hpp"

namespace rockfold {

/// solve() from no basis, for rows in layers of which each bears the ones before: a layer is solved with what those pass on to it, then
/// all up to it from the two bases, which fit together because columns count to the first layer they reach. The work of CLP grows with
/// more than the square of the rows, and most layers need little more once they stand by themselves. `layer`: [rows] from 0 on. Any part of
/// the programme must have a solution.
LinearSolution solve_in_layers(const LinearProgram& program, const std::vector<Index>& layer);

}  // namespace rockfold
