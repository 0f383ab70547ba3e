// Strength reduction (Zienkiewicz, Humpheson & Lewis, Géotechnique 25, 1975): the factor by which friction and cohesion of the joints
// may be divided before the mass no longer comes to rest.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "src/base/progress.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

/// The analysis with the joints' strength divided by a factor.
struct ReductionTrial {
  Real factor = 1;
  Real time = 0;   ///< s, at which it was decided
  Real speed = 0;  ///< m/s, of the fastest block then
  bool stands = false;
};

struct Reduction {
  std::vector<ReductionTrial> trials;  ///< in the order in which they were made
  bool interrupted = false;            ///< a signal ended the search

  /// The largest factor with which the mass stood, and the smallest with which it did not; none: there was no such trial.
  std::optional<Real> stands() const;
  std::optional<Real> fails() const;
  /// Half way between both, if there are both.
  std::optional<Real> factor() const;
  /// Of the run whose states are stored: that in which the mass fails, or, if it never does, the largest.
  Real shown() const;
};

/// tan φ and cohesion divided by `factor`, peak and residual ones. Dilation is no more than the friction that is left; tensile strength
/// and stiffness stay.
std::vector<JointMaterial> with_strength_divided(std::vector<JointMaterial> joints, Real factor);

/// Bisection between the factors of Model::reduction, which must be set, from 1 on if it lies between them. A mass fails that is not at
/// rest at the end, or of which a block has moved by more than StrengthReduction::max_displacement of its size. Throws as run_analysis
/// does, and Error(model) where blocks touch nothing.
Reduction find_reduction(const RunInput& input, Progress& progress);

/// How many analyses find_reduction makes at most.
Index most_trials(const StrengthReduction& spec);

/// Blocks that fail in a run to its end: not at rest then, or moved too far. Ids from 0, ascending.
std::vector<Index> failing_blocks(const Model& model, const BlockArrays& blocks,
                                  const RunResult& run);

std::vector<std::byte> packed(const Reduction& reduction);
/// Throws std::runtime_error.
Reduction unpacked_reduction(std::span<const std::byte> bytes);

}  // namespace rockfold
