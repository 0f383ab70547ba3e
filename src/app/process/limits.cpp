#include "src/app/process/limits.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "src/app/process/memory.hpp"
#include "src/app/process/signals.hpp"
#include "src/base/timer.hpp"

namespace rockfold {

namespace {

constexpr std::chrono::milliseconds between_looks{20};
/// Of max_memory: what a checkpoint and the writing of results may take on top; beyond it nothing is waited for.
constexpr Real hard_share = 1.25;

}  // namespace

std::string size_text(Real bytes) {
  constexpr std::pair<const char*, Real> units[] = {{"TB", 1e12}, {"GB", 1e9}, {"MB", 1e6}};
  for (const auto& [name, size] : units)
    if (bytes >= size) return fmt::format("{:.3g} {}", bytes / size, name);
  return fmt::format("{:.3g} kB", bytes / 1e3);
}

class LimitWatch::Watcher {
 public:
  Watcher(Real time, Real memory) : time_(time), memory_(memory), thread_([this] { watch(); }) {}
  Watcher(const Watcher&) = delete;
  Watcher& operator=(const Watcher&) = delete;
  ~Watcher() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }

 private:
  void watch() {
    std::unique_lock lock(mutex_);
    bool stopped = false;
    while (!wake_.wait_for(lock, between_looks, [this] { return done_; })) {
      const Real bytes = memory_ > 0 ? resident_bytes() : 0;
      if (bytes > memory_ * (stopped ? hard_share : 1)) {
        request_stop("--max-memory",
                     fmt::format("the program needs more than {}", size_text(memory_)));
        if (stopped) return;
        stopped = true;
      } else if (!stopped && time_ > 0 && since_.seconds() > time_) {
        request_stop("--max-time", fmt::format("the program needs more than {:g} s", time_));
        stopped = true;
      }
    }
  }

  Real time_, memory_;  ///< s, bytes; 0: no limit
  Timer since_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;  // the last: it uses the others
};

LimitWatch::LimitWatch(const Options& options) {
  if (options.max_time > 0 || options.max_memory > 0)
    watcher_ = std::make_unique<Watcher>(options.max_time, options.max_memory);
}

LimitWatch::~LimitWatch() = default;

}  // namespace rockfold
