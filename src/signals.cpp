#include "src/signals.hpp"

#include <csignal>
#include <string_view>

#include <pthread.h>
#include <unistd.h>

#include "src/base/interrupt.hpp"
#include "src/io/partial_file.hpp"

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

pthread_t main_thread;  // the one that writes files

/// In a signal handler little more than write() and _exit() is safe.
void put(int file, std::string_view text) {
  [[maybe_unused]] const auto ignored = write(file, text.data(), text.size());
}

void put_on_stderr(std::string_view text) {
  put(STDERR_FILENO, isatty(STDERR_FILENO) ? text : text.substr(wipe_length));
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
    _exit(128 + signal);
  }
  interrupt_signal = signal;
}

void exit_plain(int signal) {
  put_on_stderr(plain_text);
  _exit(128 + signal);
}

void exit_json(int signal) {
  put(STDOUT_FILENO, json_text);
  exit_plain(signal);
}

}  // namespace

void exit_at_once_when_interrupted(bool json) {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, json ? exit_json : exit_plain);
}

void remember_interrupts() {
  main_thread = pthread_self();
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, remember);
}

int interrupted_status() {
  return interrupt_signal ? 128 + interrupt_signal : 0;
}

}  // namespace rockfold
