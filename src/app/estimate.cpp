#include "src/app/estimate.hpp"

#include <algorithm>
#include <ctime>

#include <sys/resource.h>

#include "src/run/reduction.hpp"

namespace rockfold {

namespace {

/// Steps that are tried of a stage: the first sets solvers up, the next ones bring loads and contacts on.
constexpr Index least_tried = 3;
constexpr Real longest_try = 4;  // s

/// s of computing until main began: libraries are found and linked.
const Real started_in = static_cast<Real>(std::clock()) / CLOCKS_PER_SEC;

Real peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<Real>(usage.ru_maxrss);
}

}  // namespace

Probe::Probe(const Model& model) {
  if (!model.analysis) return;
  for (const AnalysisStage& stage : model.analysis->stages) steps_.push_back(stage.steps);
  after_.resize(steps_.size());
  if (model.reduction) times_ = most_trials(*model.reduction) + 1;
}

Then Probe::after(const StepDone& done) {
  std::vector<Real>& after = after_[done.stage];
  after.push_back(since_.seconds());
  const auto tried = static_cast<Index>(after.size());
  const bool enough = tried >= least_tried && after.back() - after.front() > longest_try;
  return enough ? Then::end_stage : Then::go_on;
}

Watch Probe::watch() {
  return [this](const StepDone& done) { return after(done); };
}

Estimate Probe::estimate(const std::string& command) const {
  Estimate made{command, peak_memory(), since_.seconds() + started_in, 0, 0};
  for (std::size_t stage = 0; stage < steps_.size(); ++stage) {
    const std::vector<Real>& after = after_[stage];
    const Index tried = static_cast<Index>(after.size()), steps = times_ * steps_[stage];
    made.steps += steps;
    made.tried += tried;
    if (tried < 2) continue;
    const Index settled = (tried - 1) / 2;
    const Real step = (after.back() - after[settled]) / static_cast<Real>(tried - 1 - settled);
    made.seconds += step * static_cast<Real>(steps - tried);
  }
  return made;
}

}  // namespace rockfold
