// What a run keeps as it goes: monitors and energies each step, states every so often.
#pragma once

#include <optional>

#include "kernels/time/motion.hpp"
#include "src/base/archive.hpp"
#include "src/base/timer.hpp"
#include "src/run/base_motion.hpp"
#include "src/run/records/block_courses.hpp"
#include "src/run/records/bolt_record.hpp"
#include "src/run/records/joint_monitors.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

class Recorder {
 public:
  Recorder(const RunInput& input, const PieceMoments& moments, const StoreState& store,
           RunResult& result);

  /// Displacements count from `displacement` of the covers from now on.
  void count_from(std::vector<Vec3> displacement);
  /// Rock is gone, whose displacement is none: it counts from nothing.
  void leave_out(const GoneRock& gone);
  /// [B] 1: gone; empty where nothing goes in the analysis.
  const std::vector<std::uint8_t>& gone() const { return gone_; }
  /// After `step` steps. Stores the state at the first and last, and at those that are a multiple of output.every.
  void record(const Motion& motion, Index step, bool last);
  /// What has been displaced since.
  std::vector<Vec3> counted(std::vector<Vec3> displacement) const;
  /// BlockCourses::at_rest_since(); only with contact.
  Real at_rest_since() const { return courses_->at_rest_since(); }
  /// Of the end.
  void find_support(const Motion& motion, RunResult& result) const;
  /// Contact points as they are now; only with contact.
  std::vector<ContactSample> contacts(const Motion& motion) const;
  /// Stores the state unless that has been done.
  void store(const Motion& motion, Index step);
  /// How many states have been stored.
  Index stored_states() const { return states_; }
  /// What it keeps between steps.
  void pass(Archive& archive);

 private:
  void record_monitors(const Motion& motion);
  /// Its acceleration is the mean over the time over which that of the motion is.
  BaseMotion base_motion(const Motion& motion);

  const RunInput& input_;
  const PieceMoments& moments_;
  const StoreState& store_;
  RunResult& result_;
  TrackedPoints monitors_;
  std::vector<JointLaw> laws_;           ///< with contact
  std::optional<JointMonitors> joints_;  ///< likewise
  std::optional<BlockCourses> courses_;  ///< likewise
  std::optional<BoltRecord> bolts_;      ///< with bolts
  BaseRecord base_;
  Index every_;
  Index stored_ = none;                 ///< step stored last
  Index states_ = 0;                    ///< how many were
  std::vector<Vec3> zero_;              ///< of the covers' displacement; empty: none
  std::vector<Vec3> zero_of_monitors_;  ///< likewise
  std::vector<std::uint8_t> gone_;      ///< [B]
};

}  // namespace rockfold
