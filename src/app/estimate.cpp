#include "src/app/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <sys/resource.h>

#include "src/run/reduction.hpp"

namespace rockfold {

namespace {

/// Steps that are tried of a phase: the first sets solvers up, the next ones bring loads and contacts on.
constexpr Index least_tried = 3;
constexpr Real longest_try = 4;  // s
/// Steps that stay of a quiet phase before motion: enough for the rock to take up its weight.
constexpr Index quiet_steps = 10;

/// s of computing until main began: libraries are found and linked.
const Real started_in = static_cast<Real>(std::clock()) / CLOCKS_PER_SEC;

Real peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<Real>(usage.ru_maxrss);
}

/// Of supports, loads and the base, whose times count from the analysis' start.
std::vector<TimeTable*> tables_of(Model& model) {
  std::vector<TimeTable*> tables;
  for (Fixed& f : model.fixed) tables.push_back(&f.table);
  for (Traction& t : model.tractions) tables.push_back(&t.table);
  for (PointLoad& p : model.point_loads) tables.push_back(&p.table);
  if (model.base_acceleration && model.base_acceleration->stage == 0)
    tables.push_back(&model.base_acceleration->table);
  return tables;
}

/// s, ascending: when something begins to move while all is still.
std::vector<Real> begins_of_motion(const std::vector<TimeTable*>& tables) {
  std::vector<std::pair<Real, Real>> moves;  // from, to
  for (const TimeTable* table : tables)
    for (std::size_t i = 1; i < table->time.size(); ++i)
      if (table->value[i] != table->value[i - 1])
        moves.emplace_back(table->time[i - 1], table->time[i]);
  std::sort(moves.begin(), moves.end());
  std::vector<Real> begins;
  Real until = -1;
  for (const auto& [from, to] : moves) {
    if (from > until) begins.push_back(from);
    until = std::max(until, to);
  }
  return begins;
}

/// As it is from `from` on, `earlier` seconds before; until then its value then.
void shift(TimeTable& table, Real from, Real earlier) {
  if (table.empty()) return;
  TimeTable made;
  made.time = {from - earlier};
  made.value = {table.at(from)};
  for (std::size_t i = 0; i < table.time.size(); ++i)
    if (table.time[i] > from) {
      made.time.push_back(table.time[i] - earlier);
      made.value.push_back(table.value[i]);
    }
  table = std::move(made);
}

}  // namespace

Probe::Probe(const Model& model) {
  if (!model.analysis) return;
  for (const AnalysisStage& stage : model.analysis->stages)
    phases_.push_back({{stage.steps, stage.steps, {}}});
  if (model.reduction) times_ = most_trials(*model.reduction) + 1;
}

void Probe::shorten(Model& model) {
  if (!model.analysis) return;
  const std::vector<TimeTable*> tables = tables_of(model);
  begins_ = begins_of_motion(tables);
  Real end = 0;
  for (const AnalysisStage& stage : model.analysis->stages)
    end += stage.time_step * static_cast<Real>(stage.steps);
  std::erase_if(begins_, [&](Real t) { return t >= end; });
  if (begins_.empty() || model.analysis->has(AnalysisType::static_)) return;
  const Real first = begins_.front();
  Real begin = 0;
  for (std::size_t s = 0; s < phases_.size(); ++s) {
    AnalysisStage& stage = model.analysis->stages[s];
    const Real quiet_time = first - begin;
    begin += stage.time_step * static_cast<Real>(stage.steps);
    constexpr Real rounding = 1e-9;
    const auto quiet = static_cast<Index>(std::min(
        std::floor(quiet_time / stage.time_step + rounding), static_cast<Real>(stage.steps)));
    if (quiet <= 0) break;
    const Index kept = std::min(quiet, quiet_steps), moving = stage.steps - quiet;
    phases_[s] = {{quiet, kept, {}}};
    if (moving > 0) phases_[s].push_back({moving, moving, {}});
    stage.steps = kept + moving;
    left_out_ += stage.time_step * static_cast<Real>(quiet - kept);
    if (moving > 0) break;
  }
  for (TimeTable* table : tables) shift(*table, first, left_out_);
  for (Real& t : begins_) t -= left_out_;
  first_ = begins_.front();
}

Then Probe::after(const StepDone& done) {
  reached_ = done.time;
  std::vector<Phase>& phases = phases_[done.stage];
  Phase& phase = done.step <= phases.front().most ? phases.front() : phases.back();
  phase.after.push_back(since_.seconds());
  // What moves later would not be seen.
  if (reached_ < first_ || &phase != &phases.back()) return Then::go_on;
  const auto tried = static_cast<Index>(phase.after.size());
  const bool enough =
      tried >= least_tried && phase.after.back() - phase.after.front() > longest_try;
  return enough ? Then::end_stage : Then::go_on;
}

Watch Probe::watch() {
  return [this](const StepDone& done) { return after(done); };
}

Real Probe::rest_of(const Phase& phase) const {
  const auto tried = static_cast<Index>(phase.after.size());
  if (tried < 2) return 0;
  const Index settled = (tried - 1) / 2;
  const Real step =
      (phase.after.back() - phase.after[settled]) / static_cast<Real>(tried - 1 - settled);
  return step * static_cast<Real>(times_ * phase.steps - tried);
}

Estimate Probe::estimate(const std::string& command) const {
  Estimate made{command, peak_memory(), since_.seconds() + started_in, 0, 0, {}};
  for (const std::vector<Phase>& stage : phases_)
    for (const Phase& phase : stage) {
      made.steps += times_ * phase.steps;
      made.tried += static_cast<Index>(phase.after.size());
      made.seconds += rest_of(phase);
    }
  for (const Real begin : begins_)
    if (begin >= reached_ && !made.not_tried_from) made.not_tried_from = begin + left_out_;
  return made;
}

}  // namespace rockfold
