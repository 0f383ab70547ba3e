// Runs as processes of their own: one that fails, or takes too long or too much memory, does no harm to others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/base/types.hpp"
#include "src/sweep/processes/run_queue.hpp"

namespace rockfold::sweep {

/// One process: the program itself with these arguments.
struct Job {
  Index run = 0;
  std::vector<std::string> arguments;
  std::string out, err;  ///< files that stdout and stderr go to
};

/// What a run had more of than it may.
enum class Limit { none, time, memory };

/// How one ended.
struct Ended {
  Index run = 0;
  Real seconds = 0;
  int exit_status = -1;       ///< −1: a signal ended it
  int signal = 0;             ///< which
  Limit limit = Limit::none;  ///< for which it was ended
};

struct PoolSettings {
  Index workers = 1;      ///< ≥ 1
  Real time_limit = 0;    ///< s of wall time; 0: none
  Real memory_limit = 0;  ///< bytes in memory (resident), looked at fifty times a second; 0: none
};

/// Processor cores that this process may use.
Index core_count();

/// Starts what the queue hands out and tells of each end. A process that someone else kills (kill, the kernel short of memory) is started
/// again, twice at most. Returns when the queue is over and all have ended, or, where a signal asked the program to stop
/// (src/base/interrupt.hpp), after having ended those under way. Their children end with this process, however it ends.
/// Throws Error(io) where no process can be started.
void run_jobs(const PoolSettings& settings, RunQueue& queue,
              const std::function<Job(Index run)>& job_of,
              const std::function<void(const Ended&)>& ended);

}  // namespace rockfold::sweep
