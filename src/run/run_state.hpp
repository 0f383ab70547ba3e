// What a run is between two of its steps, as bytes: checkpoints, and the states that are stored on the way.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "src/base/archive.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"
#include "src/run/scheme_choice.hpp"

namespace rockfold {

/// How a checkpoint begins.
struct CheckpointFacts {
  std::uint64_t format = 0;
  Index steps = 0;   ///< done
  Index states = 0;  ///< stored by then; what was stored later is computed again
  Real time = 0;     ///< s
};

/// Throws std::runtime_error where the bytes are no checkpoint of this program's.
CheckpointFacts checkpoint_facts(std::span<const std::byte> checkpoint);
CheckpointFacts make_checkpoint_facts(Index steps, Index states, Real time);

/// How a run is started again, and how it leaves what it can be started from.
struct Checkpoints {
  /// Called between steps, and where a signal ends the run.
  std::function<void(std::span<const std::byte>)> save;
  Real every = 0;                        ///< s of wall time between two calls
  std::span<const std::byte> from = {};  ///< where to go on; empty: at the start
};

/// Where a run is.
struct RunPosition {
  Index stage = 0;  ///< of Analysis::stages
  Index step = 0;   ///< steps of it that are done
  Index begun = 0;  ///< 1: the stage has taken over from the one before …
  Index settled =
      0;  ///< 1: … rock that it excavates has been let go, as far as it does so at once …
  Index started = 0;    ///< 1: … and it has its first acceleration
  Index newton = 0;     ///< iterations of the step so far
  Index under_way = 0;  ///< 1: within a step, of whose `parts` `done` are done; it ends at `end`
  Index parts = 1, done = 0;
  Index needed = 1;       ///< parts without which it did not converge
  Index inverted = none;  ///< element that a longer part turned inside out
  Real end = 0;           ///< s
  Real stage_began = 0;   ///< s
  Index by_substeps =
      0;  ///< "auto" takes the rest of the stage by explicit substeps, 1: for its work, 2: as a step failed
  SchemeWork work;  ///< of the stage
  Real walls_before =
      1;  ///< share of the forces on walls that was left when the release under way began
};

/// The part of a run's result that grows step by step. The monitors must be there.
void pass_histories(Archive& archive, RunResult& result);

/// Lengths of the stages, so that a run goes on only with those that its steps were taken with. Throws Error(usage) where one
/// that is over, or the one under way, has become another; `step` steps of stage number `stage` are done.
void pass_stages(Archive& archive, const Analysis& analysis, Index stage, Index step);

std::vector<std::byte> packed(const StoredState& state);
/// Throws std::runtime_error.
StoredState unpacked_state(std::span<const std::byte> bytes);
/// Of its step, time and motion: the same on any number of threads, in repeated and resumed runs.
std::uint64_t hash_of(const StoredState& state);

}  // namespace rockfold
