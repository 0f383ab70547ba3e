// The ground under an earthquake: what turns motion relative to the base into absolute motion.
#pragma once

#include "src/arrays/time_table.hpp"
#include "src/base/archive.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// s, how long a stage takes; a static one is one step of a second.
Real duration(const AnalysisStage& stage);
/// s, at which a stage begins: those before it are over.
Real start_of_stage(const Analysis& analysis, Index stage);

/// m/s², the record as it acts over the time of the analysis, whose stages it may leave at rest before its own (BaseAcceleration::stage);
/// empty if the base is at rest.
TimeTable base_acceleration(const Model& model);

/// m/s², of the base: the record, and what stands for the seismic coefficient in the steps where it acts. Empty: it is at rest.
TimeTable ground_acceleration(const Model& model);

/// A record as the model gives it, with its scale.
struct RecordSpan {
  Real peak = 0;          ///< m/s²
  Real from = 0, to = 0;  ///< s of the analysis, its first and last row
};
/// Of a model with a record and an analysis.
RecordSpan record_span(const Model& model);

/// At rest in place at t = 0; velocity and displacement are the exact integrals of the record, which is linear between its rows.
class BaseRecord {
 public:
  explicit BaseRecord(TimeTable acceleration);

  /// Times must not decrease.
  const BaseMotion& at(Real time);
  /// How far it has come: a sum of the same parts in the same order, so that a resumed run has the same digits.
  void pass(Archive& archive) { archive.all(time_, motion_); }

 private:
  void advance(Real time);

  TimeTable acceleration_;  // m/s²
  Real time_ = 0;
  BaseMotion motion_;
};

}  // namespace rockfold
