// --max-time and --max-memory: the program is stopped before the machine runs out of either.
#pragma once

#include <memory>
#include <string>

#include "src/app/command_line.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Looks fifty times a second, in a thread of its own. Where a limit is met, the program is asked to stop as by a signal (signals.hpp): it
/// ends at once before there is anything to keep, an analysis ends at the last step done, with a checkpoint. Where memory grows by another
/// quarter in spite of that, it ends at once in any case.
class LimitWatch {
 public:
  explicit LimitWatch(const Options& options);
  ~LimitWatch();

 private:
  class Watcher;
  std::unique_ptr<Watcher> watcher_;
};

/// "4 GB" of 4e9, "250 MB" of 2.5e8.
std::string size_text(Real bytes);

}  // namespace rockfold
