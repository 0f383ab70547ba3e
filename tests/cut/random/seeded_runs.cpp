#include "tests/cut/random/seeded_runs.hpp"

#include <array>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <map>
#include <string_view>

#include <gtest/gtest.h>
#include <unistd.h>

namespace rockfold::test {

namespace {

constexpr unsigned shown_failures = 5;
constexpr std::array fatal{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};
constexpr unsigned longest = 200;  // s a seed: what takes longer is caught in a loop

volatile std::sig_atomic_t seed_at_work = -1;

// Only what a signal handler may do.
void say_seed(int number) {
  char text[32] = "\nended by seed ";
  char* end = std::to_chars(text + 15, text + 31, static_cast<int>(seed_at_work)).ptr;
  *end++ = '\n';
  [[maybe_unused]] const auto written =
      write(STDERR_FILENO, text, static_cast<std::size_t>(end - text));
  std::signal(number, SIG_DFL);
  std::raise(number);
}

class SeedGuard {
 public:
  SeedGuard() {
    for (std::size_t i = 0; i < fatal.size(); ++i) before_[i] = std::signal(fatal[i], say_seed);
  }
  ~SeedGuard() {
    alarm(0);
    for (std::size_t i = 0; i < fatal.size(); ++i) std::signal(fatal[i], before_[i]);
  }
  SeedGuard(const SeedGuard&) = delete;
  SeedGuard& operator=(const SeedGuard&) = delete;

 private:
  std::array<void (*)(int), fatal.size()> before_{};
};

std::string joined(const Faults& faults) {
  std::string text;
  for (const std::string& f : faults) text += "\n  " + f;
  return text;
}

}  // namespace

unsigned from_environment(const char* variable, unsigned normal) {
  const char* text = std::getenv(variable);
  return text ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : normal;
}

void check_seeds(unsigned first, unsigned count, const std::function<SeededCase(unsigned)>& check) {
  const SeedGuard guard;
  std::map<std::string, unsigned> failures;  // by kind and rule
  unsigned failed = 0;
  for (unsigned seed = first; seed < first + count; ++seed) {
    seed_at_work = static_cast<std::sig_atomic_t>(seed);
    alarm(longest);
    const SeededCase result = check(seed);
    if (result.faults.empty()) continue;
    ++failures[result.kind + ", " + rule_of(result.faults.front())];
    if (++failed <= shown_failures)
      ADD_FAILURE() << "seed " << seed << ", " << result.kind << ":" << joined(result.faults)
                    << "\n"
                    << (result.details ? result.details() : "");
  }
  if (failed == 0) return;
  std::string table;
  for (const auto& [what, times] : failures) table += "\n  " + std::to_string(times) + " " + what;
  ADD_FAILURE() << failed << " of " << count << " failed:" << table;
}

}  // namespace rockfold::test
