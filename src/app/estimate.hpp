// What a command will take, from carrying out its beginning: all of its stages, and the first steps of its analysis.
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

/// Watches the steps of an analysis that is stopped after its first ones.
class Probe {
 public:
  explicit Probe(const Model& model);

  /// For run_analysis().
  Watch watch();
  /// After the command; `command` as the user would write it.
  Estimate estimate(const std::string& command) const;

 private:
  Timer since_;
  Index steps_ = 0;
  std::vector<Real> after_;  ///< s since the start, after each step
};

}  // namespace rockfold
