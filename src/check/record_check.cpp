#include "src/check/record_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "src/base/vector.hpp"
#include "src/report/error_text.hpp"
#include "src/run/base_motion.hpp"

namespace rockfold {
namespace {

/// Of the peak: what is cut off, or held, is told from there on.
constexpr Real cut_share = 0.05, held_share = 0.01;
constexpr Real g = 9.81;  // m/s²

/// The record over the time of the analysis, unlike base_acceleration() with all its rows.
class Record {
 public:
  explicit Record(const Model& model)
      : base_(*model.base_acceleration),
        analysis_(*model.analysis),
        span_(record_span(model)),
        start_(start_of_stage(analysis_, base_.stage)),
        end_(start_of_stage(analysis_, static_cast<Index>(analysis_.stages.size()))) {}

  std::vector<std::string> warnings() const {
    if (is_constant()) return {};
    const AnalysisStage& stage = analysis_.stages[base_.stage];
    const Real end_of_step = start_ + duration(stage);
    if (span_.from >= end_of_step || span_.to <= start_) return {beside(stage, end_of_step)};
    std::vector<std::string> found;
    if (span_.from < start_ && largest(span_.from, start_) > cut_share * span_.peak)
      found.push_back(
          fmt::format("begins {:.4g} s before its step, at t = {:.4g} s: that part, up to {:.3g} "
                      "g, does not act",
                      start_ - span_.from, span_.from, largest(span_.from, start_) / g));
    if (span_.to > end_ && largest(end_, span_.to) > cut_share * span_.peak)
      found.push_back(
          fmt::format("goes on to t = {:.4g} s, and the analysis ends at t = {:.4g} s: the last "
                      "{:.4g} s, up to {:.3g} g, do not act",
                      span_.to, end_, span_.to - end_, largest(end_, span_.to) / g));
    if (span_.from > start_ && is_held(size_of(0)))
      found.push_back(fmt::format(
          "begins at t = {:.4g} s with {:.3g} g, which acts from the start of its step, "
          "t = {:.4g} s, on: give it a first row of 0",
          span_.from, size_of(0) / g, start_));
    const std::size_t last = base_.table.time.size() - 1;
    if (span_.to < end_ && is_held(size_of(last)))
      found.push_back(
          fmt::format("ends at t = {:.4g} s with {:.3g} g, which goes on acting to the end of the "
                      "analysis, t = "
                      "{:.4g} s: give it a last row of 0",
                      span_.to, size_of(last) / g, end_));
    return found;
  }

 private:
  std::string beside(const AnalysisStage& stage, Real end_of_step) const {
    const bool late = span_.from >= end_of_step;
    return fmt::format(
        "lies beside {}, which takes t = {:.4g} to {:.4g} s: it {} at t = {:.4g} s, and all that "
        "acts "
        "there is its {} value, {:.3g} g. Its t = 0 is the start of the step",
        stage.name.empty() ? "the analysis" : "step \"" + stage.name + "\"", start_, end_of_step,
        late ? "begins" : "ends", late ? span_.from : span_.to, late ? "first" : "last",
        size_of(late ? 0 : base_.table.time.size() - 1) / g);
  }

  bool is_constant() const {
    const auto& values = base_.table.value;
    return std::all_of(values.begin(), values.end(), [&](const Vec3& a) { return a == values[0]; });
  }

  /// A table of the model that goes up to its largest value and stays there is meant.
  bool is_held(Real size) const {
    return size > held_share * span_.peak && (!base_.file.empty() || size < span_.peak);
  }

  /// m/s², of a row.
  Real size_of(std::size_t row) const {
    return std::abs(base_.scale) * norm(base_.table.value[row]);
  }

  /// m/s², between two times of the analysis.
  Real largest(Real from, Real to) const {
    Real most = std::abs(base_.scale) *
                std::max(norm(base_.table.at(from - start_)), norm(base_.table.at(to - start_)));
    for (std::size_t row = 0; row < base_.table.time.size(); ++row)
      if (const Real t = start_ + base_.table.time[row]; t > from && t < to)
        most = std::max(most, size_of(row));
    return most;
  }

  const BaseAcceleration& base_;
  const Analysis& analysis_;
  RecordSpan span_;
  Real start_, end_;  // s, of its step and of the analysis
};

}  // namespace

void warn_of_record(const Model& model, Terminal& terminal) {
  if (!model.base_acceleration || model.base_acceleration->table.empty() || !model.analysis) return;
  for (const std::string& warning : Record(model).warnings())
    terminal.warn(diagnostic_line({model.base_acceleration->place, warning}));
}

}  // namespace rockfold
