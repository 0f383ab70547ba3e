#include "src/app/process/signals.hpp"

#include <atomic>
#include <csignal>
#include <string_view>

#include <pthread.h>
#include <unistd.h>

#include "src/base/interrupt.hpp"
#include "src/io/partial_file.hpp"
#include "src/report/error_text.hpp"

namespace rockfold {

namespace {

constexpr std::string_view json_text =
    "{\n\"schema\": \"rockfold/1\",\n\"error\": {\"kind\":\"analysis\",\"message\":\"interrupted "
    "before there was "
    "anything to store\",\"file\":\"\",\"line\":0,\"column\":0,\"key\":\"\"}\n}\n";
constexpr std::string_view plain_text = "\r\033[Kinterrupted before there was anything to store\n";
constexpr std::string_view kept_text =
    "\r\033[Kinterrupted again: the result ends with the last state that was stored\n";
constexpr std::size_t wipe_length = 4;  // the texts' "\r\033[K", for terminals alone

/// Why the program was asked to stop where no signal from outside did; made before the signal, so that a handler need only write it.
struct Stop {
  std::string key, why;
  std::string plain, json;  ///< all that is said where there is nothing to store
};
std::atomic<const Stop*> stop{nullptr};
bool json_asked = false;

constexpr int failed_status = 1;

pthread_t main_thread;  // the one that writes files

/// In a signal handler little more than write() and _exit() is safe.
void put(int file, std::string_view text) {
  [[maybe_unused]] const auto ignored = write(file, text.data(), text.size());
}

void put_on_stderr(std::string_view text) {
  put(STDERR_FILENO, isatty(STDERR_FILENO) ? text : text.substr(wipe_length));
}

[[noreturn]] void leave(int signal) {
  _exit(stop.load() ? failed_status : 128 + signal);
}

void tell_stop(const Stop& why) {
  if (json_asked) put(STDOUT_FILENO, why.json);
  put_on_stderr(why.plain);
}

/// Once: the analysis stops after its step. Twice: the user does not want to wait for that. While a state is written the main
/// thread lets signals wait; others hand theirs to it.
void remember(int signal) {
  if (pthread_equal(pthread_self(), main_thread) == 0) {
    pthread_kill(main_thread, signal);
    return;
  }
  if (interrupt_signal) {
    if (settle_partial_files()) put_on_stderr(kept_text);
    if (const Stop* why = stop.load()) tell_stop(*why);
    leave(signal);
  }
  interrupt_signal = signal;
}

void exit_at_once(int signal) {
  if (const Stop* why = stop.load()) {
    tell_stop(*why);
  } else {
    if (json_asked) put(STDOUT_FILENO, json_text);
    put_on_stderr(plain_text);
  }
  leave(signal);
}

Error error_of(const Stop& why, const std::string& state) {
  return {ErrorKind::analysis, why.why + ": " + state, Place{"", 0, 0, why.key}};
}

}  // namespace

void exit_at_once_when_interrupted(bool json) {
  json_asked = json;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, exit_at_once);
}

void remember_interrupts() {
  main_thread = pthread_self();
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, remember);
}

void request_stop(const std::string& key, const std::string& why) {
  if (!stop.load()) {
    static Stop made;
    made.key = key;
    made.why = why;
    const Error error = error_of(made, "stopped");
    made.plain = "\r\033[K" + error_lines(error).front() + "\n";
    made.json = error_document_text(error);
    stop = &made;
  }
  std::raise(SIGTERM);
}

std::optional<Error> stop_error(const std::string& state) {
  if (const Stop* why = stop.load()) return error_of(*why, state);
  return {};
}

int interrupted_status() {
  if (stop.load()) return failed_status;
  return interrupt_signal ? 128 + interrupt_signal : 0;
}

}  // namespace rockfold
