// Loops over independent work on the host's threads (OpenMP; --threads sets how many).
#pragma once

#include <cstdint>
#include <exception>

namespace rockfold {

/// Calls f(i) for 0 ≤ i < n, in any order, on all threads. f writes only what belongs to i, so that the result
/// does not depend on the number of threads. The first exception is rethrown when the loop is over.
/// What fits in one chunk, or is not worthwhile, runs on this thread: starting others takes some 10 µs, and far more on a
/// machine that is busy.
template <class Function>
void parallel_for(std::int64_t n, std::int64_t chunk, Function f, bool worthwhile = true) {
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic, chunk) if (worthwhile && n > chunk)
  for (std::int64_t i = 0; i < n; ++i) {
    try {
      f(i);
    } catch (...) {
#pragma omp critical(rockfold_parallel_for)
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace rockfold
