// Time steps in which blocks move so far that contact hardly finds its way, or does not see what they passed through.
#pragma once

#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/load_arrays.hpp"
#include "src/model/model.hpp"
#include "src/report/terminal.hpp"

namespace rockfold {

/// Compares the way of a step with the size of blocks that rest on others, and with the thickness of each block that starts with one
/// of the `velocities` or falls from where it touches nothing.
void warn_of_long_contact_steps(const Model& model, const BlockArrays& blocks,
                                const CoverArrays& covers, const FixedPoints& fixed,
                                const std::vector<RigidVelocity>& velocities, Terminal& terminal);

}  // namespace rockfold
