#include "src/threads.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <omp.h>

namespace rockfold {

namespace {

/// A thread that waits for the others looks this often (some 20 µs) before it sleeps. libgomp's default is 15 times as
/// much, and on a machine that others use too its threads then burn the time that the last of them needs: the
/// demo's steps took 20 to 60 times as long. Reckoned with 1e3 … 1e5: no difference on an idle machine.
constexpr const char* spins = "20000";

/// libgomp reads its settings before main() and before any constructor, so only a .preinit_array entry comes early enough.
void set_spins() {
  if (!std::getenv("OMP_WAIT_POLICY")) setenv("GOMP_SPINCOUNT", spins, 0);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const set_spins_early)() = set_spins;

/// CPUs' worth of time that the control group gives us (version 2, then 1), or 0 = no limit.
int group_limit() {
  double quota = 0, period = 0;
  std::ifstream("/sys/fs/cgroup/cpu.max") >> quota >>
      period;  // "max 100000" fails to read: no limit
  if (period <= 0) {
    std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") >> quota;  // -1 = no limit
    std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_period_us") >> period;
  }
  return quota > 0 && period > 0 ? std::max(1, static_cast<int>(quota / period + 0.5)) : 0;
}

}  // namespace

void use_threads(int threads) {
  if (threads == 0 && !std::getenv("OMP_NUM_THREADS")) {
    const int limit = group_limit();
    if (limit > 0) threads = std::min(limit, omp_get_max_threads());
  }
  if (threads > 0) omp_set_num_threads(threads);
}

}  // namespace rockfold
