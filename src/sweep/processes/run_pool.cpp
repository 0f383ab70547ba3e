#include "src/sweep/processes/run_pool.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <map>
#include <utility>

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "src/app/process/memory.hpp"
#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/timer.hpp"

namespace rockfold::sweep {

namespace {

constexpr int most_tries = 3;
constexpr long longest_wait = 20'000'000;  // ns; children that end wake us sooner …
constexpr long short_wait = 1'000'000;     // … and other processes of the sweep do not

struct Process {
  pid_t id = 0;
  Index run = 0;
  Timer since;
  Limit limit = Limit::none;
};

[[noreturn]] void fail(const std::string& what) {
  throw Error(ErrorKind::io, what + ": " + std::strerror(errno));
}

/// In the child, between fork and exec: system calls alone.
[[noreturn]] void become(const char* const* arguments, const Job& job, const sigset_t& mask,
                         pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  setpgid(0, 0);  // Ctrl-C is for the sweep, which ends its runs
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
  sigprocmask(SIG_SETMASK, &mask, nullptr);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  const int in = open("/dev/null", O_RDONLY), out = open(job.out.c_str(), flags, 0666),
            err = open(job.err.c_str(), flags, 0666);
  if (in < 0 || out < 0 || err < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0)
    _exit(127);
  execv("/proc/self/exe", const_cast<char* const*>(arguments));
  _exit(127);
}

Limit limit_met(const Process& process, const PoolSettings& settings) {
  if (settings.time_limit > 0 && process.since.seconds() > settings.time_limit) return Limit::time;
  if (settings.memory_limit > 0 && resident_bytes(process.id) > settings.memory_limit)
    return Limit::memory;
  return Limit::none;
}

class Pool {
 public:
  Pool(const PoolSettings& settings, const std::function<Job(Index)>& job_of)
      : settings_(settings), job_of_(job_of) {
    sigset_t children;
    sigemptyset(&children);
    sigaddset(&children, SIGCHLD);
    sigprocmask(SIG_BLOCK, &children, &before_);
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    for (const Process& p : processes_) kill(p.id, SIGKILL);
    for (const Process& p : processes_) waitpid(p.id, nullptr, 0);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }

  bool full() const { return std::ssize(processes_) >= settings_.workers; }
  bool idle() const { return processes_.empty(); }
  void start(Index run);
  /// Looks after them; runs that have ended are appended to `ended`, those to be started again to `again`.
  void attend(std::vector<Ended>& ended, std::vector<Index>& again);
  void wait(long longest) const;

 private:
  const PoolSettings& settings_;
  const std::function<Job(Index)>& job_of_;
  std::vector<Process> processes_;
  std::map<Index, int> tries_;
  sigset_t before_{};
};

void Pool::start(Index run) {
  const Job job = job_of_(run);
  std::vector<const char*> arguments{"rockfold"};
  for (const std::string& a : job.arguments) arguments.push_back(a.c_str());
  arguments.push_back(nullptr);
  const pid_t parent = getpid(), id = fork();
  if (id < 0) fail("cannot start a run");
  if (id == 0) become(arguments.data(), job, before_, parent);
  processes_.push_back({id, run, {}, Limit::none});
}

void Pool::attend(std::vector<Ended>& ended, std::vector<Index>& again) {
  for (std::size_t i = 0; i < processes_.size();) {
    Process& p = processes_[i];
    if (p.limit == Limit::none) {
      p.limit = limit_met(p, settings_);
      if (p.limit != Limit::none) kill(p.id, SIGKILL);
    }
    int status = 0;
    if (waitpid(p.id, &status, WNOHANG) != p.id) {
      ++i;
      continue;
    }
    Ended end{p.run, p.since.seconds(), -1, 0, p.limit};
    if (WIFEXITED(status)) end.exit_status = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    processes_.erase(processes_.begin() + static_cast<long>(i));
    const bool killed = end.limit == Limit::none &&
                        (end.signal == SIGKILL || end.signal == SIGTERM || end.signal == SIGINT ||
                         end.signal == SIGHUP || end.exit_status == 130 || end.exit_status == 143);
    if (killed && ++tries_[end.run] < most_tries)
      again.push_back(end.run);
    else
      ended.push_back(end);
  }
}

/// Until a child ends, or for `longest` ns.
void Pool::wait(long longest) const {
  sigset_t children;
  sigemptyset(&children);
  sigaddset(&children, SIGCHLD);
  const timespec time{0, longest};
  sigtimedwait(&children, nullptr, &time);
}

}  // namespace

Index core_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

void run_jobs(const PoolSettings& settings, RunQueue& queue,
              const std::function<Job(Index run)>& job_of,
              const std::function<void(const Ended&)>& ended) {
  Pool pool(settings, job_of);
  std::vector<Ended> done;
  std::vector<Index> again;
  const auto next = [&]() -> std::optional<Index> {
    if (again.empty()) return queue.next();
    const Index run = again.back();
    again.pop_back();
    return run;
  };
  while (true) {
    // The next ones first: they compute while what the last ones have left is read.
    while (!pool.full() && interrupt_signal == 0) {
      const auto run = next();
      if (!run) break;
      pool.start(*run);
    }
    for (const Ended& end : done) ended(end);
    done.clear();
    if (interrupt_signal != 0 || (pool.idle() && queue.over())) return;
    pool.wait(queue.shared() ? short_wait : longest_wait);
    pool.attend(done, again);
  }
}

}  // namespace rockfold::sweep
