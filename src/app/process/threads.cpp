#include "src/app/process/threads.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <omp.h>
#include <unistd.h>

namespace rockfold {

namespace {

/// How often a thread that waits for the others looks before it sleeps (some 3 µs). libgomp's own default is 300000.
/// On a machine that others use too, its threads then burn the time that the last of them needs to arrive. Measured
/// there, two steps of the demo on 4 cores: 0.9 s with this, 43 … 69 s with the default; 1 thread: 0.5 s.
constexpr const char* spins = "1000";

/// CPUs' worth of time that the control group gives us (version 2, then 1), or 0 = no limit.
int group_limit() {
  double quota = 0, period = 0;
  std::ifstream("/sys/fs/cgroup/cpu.max") >> quota >>
      period;  // "max 100000" fails to read: no limit
  if (period <= 0) {
    std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") >> quota;  // -1 = no limit
    std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_period_us") >> period;
  }
  return quota > 0 && period > 0 ? std::max(1, static_cast<int>(std::lround(quota / period))) : 0;
}

}  // namespace

void keep_waits_short(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  setenv("GOMP_SPINCOUNT", spins, 1);
  execv("/proc/self/exe", argv);  // if that cannot be, we go on as we are
}

void use_threads(int threads) {
  if (threads == 0 && !std::getenv("OMP_NUM_THREADS")) {
    const int limit = group_limit();
    if (limit > 0) threads = std::min(limit, omp_get_max_threads());
  }
  if (threads > 0) omp_set_num_threads(threads);
}

}  // namespace rockfold
