// What a command will take, from carrying out its beginning: all phases, and the first steps of each stage of its analysis.
#pragma once

#include <string>
#include <vector>

#include "src/base/timer.hpp"
#include "src/model/model.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

struct Estimate {
  std::string command;
  Real memory = 0;   ///< bytes, at the highest
  Real seconds = 0;  ///< of wall time
  Index steps = 0,
        tried = 0;  ///< of the analysis, and those that were carried out for this; 0: there is none
};

/// Watches the steps of an analysis whose stages are left after their first ones.
class Probe {
 public:
  explicit Probe(const Model& model);

  /// For run_analysis().
  Watch watch();
  /// After the command; `command` as the user would write it.
  Estimate estimate(const std::string& command) const;

 private:
  Then after(const StepDone& done);

  Timer since_;
  Index times_ = 1;                       ///< that the analysis is done
  std::vector<Index> steps_;              ///< of each stage
  std::vector<std::vector<Real>> after_;  ///< s since the start, after each step tried of a stage
};

}  // namespace rockfold
