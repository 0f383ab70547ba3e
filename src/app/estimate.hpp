// What a command will take, from carrying out its beginning: all phases, and the first steps of each stage of its analysis.
#pragma once

#include <optional>
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
  /// s: when supports or loads begin to move anew, if no step from there on was carried out.
  std::optional<Real> not_tried_from;
};

/// Watches the steps of an analysis whose stages are left after their first ones. Where supports or loads begin to move later on,
/// the steps before are left out but for some, so that steps with motion are among those that it sees.
class Probe {
 public:
  explicit Probe(const Model& model);

  /// Takes the quiet steps out of a model whose files have been read, before it is run.
  void shorten(Model& model);

  /// For run_analysis().
  Watch watch();
  /// After the command; `command` as the user would write it.
  Estimate estimate(const std::string& command) const;

 private:
  /// Steps of a stage that are alike.
  struct Phase {
    Index steps = 0;          ///< in the model
    Index most = 0;           ///< in what is run
    std::vector<Real> after;  ///< s since the start, after each one tried
  };

  Then after(const StepDone& done);
  /// s of its steps that were not tried.
  Real rest_of(const Phase& phase) const;

  Timer since_;
  Index times_ = 1;  ///< that the analysis is done
  std::vector<std::vector<Phase>>
      phases_;  ///< of each stage: one, or a quiet one before one with motion
  std::vector<Real>
      begins_;  ///< s, ascending: when supports or loads begin to move in the run; `left_out_` later in the model
  Real first_ = 0;     ///< s, in the run: until then no stage ends early
  Real left_out_ = 0;  ///< s
  Real reached_ = 0;   ///< s, in the run
};

}  // namespace rockfold
