// The ground under an earthquake: what turns motion relative to the base into absolute motion.
#pragma once

#include "src/arrays/time_table.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// At rest in place at t = 0; velocity and displacement are the exact integrals of the record, which is linear between its rows.
class BaseRecord {
 public:
  explicit BaseRecord(TimeTable acceleration);

  /// Times must not decrease.
  const BaseMotion& at(Real time);

 private:
  void advance(Real time);

  TimeTable acceleration_;  // m/s²
  Real time_ = 0;
  BaseMotion motion_;
};

}  // namespace rockfold
