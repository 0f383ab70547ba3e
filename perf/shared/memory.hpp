// The memory that this process has used at most.
#pragma once

#include <sys/resource.h>

namespace rockfold {

/// Bytes resident at the peak (of the process: benchmarks that need less than one before them show that one's).
inline double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace rockfold
