// Progress for other programs: a JSON document a line on a file descriptor of theirs, as `gpg --status-fd` has it.
#pragma once

#include <cstdio>

#include "src/base/timer.hpp"
#include "src/report/progress_line.hpp"

namespace rockfold {

/// {"phase": "Cutting", "unit": "cells", "done": 120, "total": 200, "seconds": 0.4, "ended": false}; `total` is null where it is unknown.
class ProgressStream {
 public:
  /// Throws Error(usage) where `descriptor` is not open for writing. Closes it in the end.
  explicit ProgressStream(int descriptor);
  ~ProgressStream();
  ProgressStream(const ProgressStream&) = delete;
  ProgressStream& operator=(const ProgressStream&) = delete;

  /// How far a phase is, ten times a second at most; its begin and end are always told.
  void tell(const PhaseView& view);
  void tell_end(const PhaseView& view);

 private:
  void write(const PhaseView& view, bool ended);

  std::FILE* stream_;
  Timer since_last_;
};

}  // namespace rockfold
