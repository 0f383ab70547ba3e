#include "src/app/estimate.hpp"

#include <algorithm>

#include <sys/resource.h>

#include "src/run/reduction.hpp"

namespace rockfold {

namespace {

/// Steps that are tried: the first sets solvers up; a tenth of all, but no longer than it takes to see how long one takes.
constexpr Index least_tried = 3;
constexpr Index share_tried = 10;
constexpr Real longest_try = 2;  // s

Real peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<Real>(usage.ru_maxrss);
}

}  // namespace

Probe::Probe(const Model& model) {
  if (!model.analysis) return;
  steps_ = model.analysis->steps();
  if (model.reduction) steps_ *= most_trials(*model.reduction) + 1;
}

Watch Probe::watch() {
  return [this](const StepDone&) {
    after_.push_back(since_.seconds());
    const auto tried = static_cast<Index>(after_.size());
    return tried >= std::max(least_tried, steps_ / share_tried) ||
           (tried >= least_tried && after_.back() - after_.front() > longest_try);
  };
}

Estimate Probe::estimate(const std::string& command) const {
  Estimate made{command, peak_memory(), since_.seconds(), 0, 0};
  if (after_.empty()) return made;
  made.steps = steps_;
  made.tried = static_cast<Index>(after_.size());
  if (made.tried > 1) {
    const Real step = (after_.back() - after_.front()) / static_cast<Real>(made.tried - 1);
    made.seconds += step * static_cast<Real>(steps_ - made.tried);
  }
  return made;
}

}  // namespace rockfold
