// What a step that does not come to balance is told by: which blocks, where, and the keys that would help.
#pragma once

#include <string>

#include "kernels/time/motion.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

/// Each doubling of the substeps halves the way of a substep; this many and the motion is not a motion any more.
inline constexpr int most_substeps = 1024;

std::string three_digits(Real value);

/// Two blocks that press each other, and where.
struct Trouble {
  Index block[2] = {none, none};
  Vec3 place{};
};

/// Of the block with the largest unbalanced force the contact that is closed most. With contact, before the motion goes back.
Trouble find_trouble(const RunInput& input, const Motion& motion);

/// Throws Error(analysis): step number `step`, which ends at `time` s, has not converged.
[[noreturn]] void refuse(const SolveReport& report, const Trouble& trouble, Index step, Real time,
                         const RunInput& input);

}  // namespace rockfold
