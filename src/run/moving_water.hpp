// Water in joints while blocks move: how high it stands, and on how much of each joint's sides it presses.
#pragma once

#include <optional>
#include <vector>

#include "kernels/time/motion.hpp"
#include "src/base/archive.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

class MovingWater {
 public:
  explicit MovingWater(const RunInput& input);

  /// Of the start, for MotionSetup; none without water.
  const LoadPoints* at_start() const { return any() ? &start_ : nullptr; }
  bool any() const { return input_.water != nullptr; }

  /// Before a step, or a part of one, from the motion's state to `end` s. `first`: nothing has been looked for contacts yet.
  void begin_step(Motion& motion, Real end, bool first);
  /// Of a motion restored from bytes.
  void restore(Motion& motion) const;
  /// As it stands at the end.
  std::optional<WaterInJoints> at_end(const Motion& motion);
  void pass(Archive& archive) { archive.pass(left_); }

 private:
  std::vector<Real> shares(const Motion& motion);

  const RunInput& input_;
  std::vector<JointLaw> laws_;
  std::vector<Real>
      left_;  ///< [sides] of the pressure, in joints that drain: what has run out does not come back
  LoadPoints start_;
};

}  // namespace rockfold
