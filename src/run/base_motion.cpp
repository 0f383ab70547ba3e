#include "src/run/base_motion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// The record of a base that is at rest until `start`, s; it comes up within the first step, whose loads are those of its ends.
TimeTable begun_at(Real start, Real first_step, const TimeTable& record) {
  TimeTable table{{start, start + first_step}, {{}, record.at(first_step)}};
  for (std::size_t row = 0; row < record.time.size(); ++row) {
    if (!(record.time[row] > first_step)) continue;
    table.time.push_back(start + record.time[row]);
    table.value.push_back(record.value[row]);
  }
  return table;
}

}  // namespace

Real duration(const AnalysisStage& stage) {
  if (stage.type == AnalysisType::static_) return 1;
  return (stage.steps - 1) * stage.time_step + stage.last_time_step.value_or(stage.time_step);
}

Real start_of_stage(const Analysis& analysis, Index stage) {
  Real start = 0;
  for (Index s = 0; s < stage; ++s) start += duration(analysis.stages[s]);
  return start;
}

TimeTable base_acceleration(const Model& model) {
  TimeTable table;
  if (!model.base_acceleration) return table;
  const BaseAcceleration& base = *model.base_acceleration;
  table = base.table;
  for (Vec3& a : table.value) a = base.scale * a;
  if (base.stage == 0 || table.empty()) return table;
  const Analysis& analysis = *model.analysis;
  return begun_at(start_of_stage(analysis, base.stage), analysis.stages[base.stage].time_step,
                  table);
}

namespace {

/// A base that is accelerated against the seismic coefficient while steps ask for it. It comes and goes within a step, whose loads are those of
/// its ends.
TimeTable seismic_acceleration(const Model& model) {
  TimeTable table;
  if (!model.support || !model.analysis || !model.analysis->is_seismic()) return table;
  const Vec3 acting = -norm(model.gravity) * model.support->seismic_coefficient;
  Vec3 before{};
  Real time = 0;
  for (const AnalysisStage& stage : model.analysis->stages) {
    const Vec3 now = stage.seismic ? acting : Vec3{};
    if (now != before) {
      if (table.time.empty() || table.time.back() < time) {
        table.time.push_back(time);
        table.value.push_back(before);
      }
      const bool is_static = stage.type == AnalysisType::static_;
      table.time.push_back(time + (is_static ? 1 : stage.time_step));
      table.value.push_back(now);
    }
    time += duration(stage);
    before = now;
  }
  return table;
}

}  // namespace

TimeTable ground_acceleration(const Model& model) {
  const TimeTable record = base_acceleration(model), seismic = seismic_acceleration(model);
  if (seismic.empty()) return record;
  if (record.empty()) return seismic;
  TimeTable sum;
  std::set_union(record.time.begin(), record.time.end(), seismic.time.begin(), seismic.time.end(),
                 std::back_inserter(sum.time));
  for (const Real t : sum.time) sum.value.push_back(record.at(t) + seismic.at(t));
  return sum;
}

RecordSpan record_span(const Model& model) {
  const BaseAcceleration& base = *model.base_acceleration;
  RecordSpan span;
  if (base.table.empty()) return span;
  for (const Vec3& a : base.table.value)
    span.peak = std::max(span.peak, std::abs(base.scale) * norm(a));
  const Real start = start_of_stage(*model.analysis, base.stage);
  span.from = start + base.table.time.front();
  span.to = start + base.table.time.back();
  return span;
}

BaseRecord::BaseRecord(TimeTable acceleration) : acceleration_(std::move(acceleration)) {
  motion_.acceleration = acceleration_.at(0);
}

const BaseMotion& BaseRecord::at(Real time) {
  for (const Real row : acceleration_.time)
    if (row > time_ && row < time) advance(row);
  if (time > time_) advance(time);
  return motion_;
}

/// Over a time in which the acceleration is linear.
void BaseRecord::advance(Real time) {
  const Real dt = time - time_;
  const Vec3 before = motion_.acceleration, after = acceleration_.at(time);
  motion_.displacement += dt * motion_.velocity + (dt * dt / 6) * (2 * before + after);
  motion_.velocity += (dt / 2) * (before + after);
  motion_.acceleration = after;
  time_ = time;
}

}  // namespace rockfold
