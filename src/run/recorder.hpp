// What a run keeps as it goes: monitors and energies each step, states every so often.
#pragma once

#include "kernels/time/motion.hpp"
#include "src/base/timer.hpp"
#include "src/run/base_motion.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

/// m/s², the record as it acts; empty if the base is at rest.
TimeTable base_acceleration(const Model& model);

class Recorder {
 public:
  Recorder(const RunInput& input, const PieceMoments& moments, const StoreState& store,
           RunResult& result);

  /// After `step` steps. Stores the state at the first and last, and at those that are a multiple of output.every.
  void record(const Motion& motion, Index step, bool last);
  /// Stores the state unless that has been done.
  void store(const Motion& motion, Index step);

 private:
  void record_monitors(const Motion& motion);

  const RunInput& input_;
  const PieceMoments& moments_;
  const StoreState& store_;
  RunResult& result_;
  TrackedPoints monitors_;
  BaseRecord base_;
  Index every_;
  Index stored_ = none;  ///< step stored last
};

}  // namespace rockfold
