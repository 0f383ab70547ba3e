// Wall time of the program's phases.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/base/progress.hpp"
#include "src/base/timer.hpp"

namespace rockfold {

/// "cut", "cover", …, in the order in which they were first measured; ends with "total" in a
/// document.
using PhaseSeconds = std::vector<std::pair<std::string, double>>;

class PhaseClock {
 public:
  explicit PhaseClock(Progress& progress) : progress_(progress) {}

  /// Calls f, which tells its own progress if it takes long, and adds its time to the phase.
  template <class Function>
  auto measure(const std::string& phase, Function f) {
    const Timed timed{*this, phase, {}};
    return f();
  }
  /// The same for an f that tells nothing: the user sees what goes on, and at its end the time.
  template <class Function>
  auto measure(const std::string& phase, std::string_view what, Function f) {
    progress_.begin(what, 0, "");
    const Ended ended{progress_};
    return measure(phase, f);
  }
  void add(const std::string& phase, double seconds);

  /// All phases so far, then "total" since construction.
  PhaseSeconds seconds() const;

 private:
  struct Timed {
    PhaseClock& clock;
    const std::string& phase;
    Timer timer;
    ~Timed() { clock.add(phase, timer.seconds()); }
  };
  struct Ended {
    Progress& progress;
    ~Ended() { progress.end(); }
  };
  Progress& progress_;
  PhaseSeconds seconds_;
  Timer total_;
};

}  // namespace rockfold
