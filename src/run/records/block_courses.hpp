// Looks at blocks after each step of a run with contact: how each began to move, since when all are at rest.
#pragma once

#include <limits>

#include "kernels/time/motion.hpp"
#include "src/base/archive.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

class BlockCourses {
 public:
  /// The courses begin as those of blocks that have not moved.
  BlockCourses(const RunInput& input, const PieceMoments& moments,
               const std::vector<JointLaw>& laws, std::vector<BlockCourse>& out);

  /// After a step. Cost: two passes over the covers; contact points where a block begins to move.
  void look(const Motion& motion);
  void pass(Archive& archive) { archive.all(out_, at_rest_since_); }
  /// s, of the first of the last steps that all ended at rest; NaN: the last one did not.
  Real at_rest_since() const { return at_rest_since_; }

 private:
  /// [B] N, of contact with blocks that have moved by less than half as far.
  std::vector<Real> pressing(const Motion& motion, const StateArrays& state) const;

  const RunInput& input_;
  const PieceMoments& moments_;
  const std::vector<JointLaw>& laws_;
  std::vector<BlockCourse>& out_;
  Real resting_speed_;
  Real at_rest_since_ = std::numeric_limits<Real>::quiet_NaN();
};

}  // namespace rockfold
