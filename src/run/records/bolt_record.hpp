// What bolts bear as a run goes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernels/time/motion.hpp"
#include "src/base/archive.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

class BoltRecord {
 public:
  explicit BoltRecord(const BoltElements& bolts) : bolts_(bolts) {}

  /// After a step.
  void look(const Motion& motion);
  /// As they are at the end: [bolts that meet rock].
  std::vector<BoltResult> at_end(const Motion& motion) const;
  /// Likewise; none where it bridges no joint.
  std::optional<ShotcreteResult> shotcrete_at_end(const Motion& motion) const;
  /// To store; the displacements count as `displacement` of the covers does.
  BoltLineState lines(const Motion& motion, const std::vector<Vec3>& displacement) const;
  void pass(Archive& archive) { archive.pass(broken_at_); }

 private:
  const BoltElements& bolts_;
  std::vector<std::optional<Real>> broken_at_;  ///< [B] s
};

}  // namespace rockfold
