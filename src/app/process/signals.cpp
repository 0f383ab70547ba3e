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
constexpr std::string_view kept_json_text =
    "{\n\"schema\": \"rockfold/1\",\n\"error\": {\"kind\":\"analysis\",\"message\":\"interrupted: "
    "the result ends with the last state that was "
    "stored\",\"file\":\"\",\"line\":0,\"column\":0,\"key\":\"\"}\n}\n";
constexpr std::size_t wipe_length = 4;  // the texts' "\r\033[K", for terminals alone

/// Why the program was asked to stop where no signal from outside did; made before the signal, so that a handler need only write it.
struct Stop {
  std::string key, why;
  std::string plain, json;  ///< all that is said where there is nothing to store
};
std::atomic<const Stop*> stop{nullptr};
bool json_asked = false;
volatile std::sig_atomic_t answering = 0;    // stdout holds what is no error document
volatile std::sig_atomic_t asked_again = 0;  // a second signal came
volatile std::sig_atomic_t at_once = 0;      // nothing is waited for

/// What the analysis has after a second signal. GNU timeout sends its signal to the process and then to its group: two in a row are
/// no user who has lost patience.
constexpr unsigned seconds_of_grace = 1;

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

void put_document(std::string_view text) {
  if (json_asked && answering == 0) put(STDOUT_FILENO, text);
}

void tell_stop(const Stop& why) {
  put_document(why.json);
  put_on_stderr(why.plain);
}

[[noreturn]] void end_now() {
  const bool kept = settle_partial_files();
  if (kept) put_on_stderr(kept_text);
  if (const Stop* why = stop.load())
    tell_stop(*why);
  else
    put_document(kept ? kept_json_text : json_text);
  leave(interrupt_signal);
}

/// Once: the analysis stops after its step. Twice: it has another second for that. While a state is written the main thread lets signals
/// wait; others hand theirs to it.
void remember(int signal) {
  if (pthread_equal(pthread_self(), main_thread) == 0) {
    pthread_kill(main_thread, signal);
    return;
  }
  if (interrupt_signal == 0) {
    interrupt_signal = signal;
  } else if (asked_again != 0 || at_once != 0) {
    end_now();
  } else if (signal != SIGALRM) {
    asked_again = 1;
    alarm(seconds_of_grace);
  }
}

void exit_at_once(int signal) {
  if (const Stop* why = stop.load()) {
    tell_stop(*why);
  } else {
    put_document(json_text);
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
  for (const int signal : {SIGINT, SIGTERM, SIGALRM}) std::signal(signal, remember);
}

void analysis_is_over() {
  alarm(0);
  asked_again = 0;
}

void answer_begins() {
  answering = 1;
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
  } else {
    at_once = 1;
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
