// How reports tell of the whole mass.
#pragma once

#include <string>
#include <vector>

#include "host/stability/stability.hpp"

namespace rockfold {

/// "blocks 12, 14 push block 9 out along bedding; and 2 more move": of those with most momentum.
std::string motion_words(const RigidMass& mass, const std::vector<MovingBlock>& moving);
/// "fails: factor of safety 0.82: …", in one line.
std::string whole_mass_words(const StabilityReport& report);

}  // namespace rockfold
