#include "src/signals.hpp"

#include <csignal>
#include <string_view>

#include <unistd.h>

#include "src/base/interrupt.hpp"

namespace rockfold {

namespace {

constexpr std::string_view json_text =
    "{\n\"schema\": \"rockfold/1\",\n\"error\": {\"kind\":\"analysis\",\"message\":\"interrupted "
    "before there was "
    "anything to store\",\"file\":\"\",\"line\":0,\"column\":0,\"key\":\"\"}\n}\n";
constexpr std::string_view plain_text = "\r\033[Kinterrupted before there was anything to store\n";
constexpr std::size_t wipe_length = 4;  // the text's "\r\033[K", for terminals alone

/// In a signal handler only write() and _exit() are safe.
void put(int file, std::string_view text) {
  [[maybe_unused]] const auto ignored = write(file, text.data(), text.size());
}

/// Once: the analysis stops after its step. Twice: the user does not want to wait for that.
void remember(int signal) {
  if (interrupt_signal) _exit(128 + signal);
  interrupt_signal = signal;
}

void exit_plain(int signal) {
  put(STDERR_FILENO, isatty(STDERR_FILENO) ? plain_text : plain_text.substr(wipe_length));
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
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, remember);
}

int interrupted_status() {
  return interrupt_signal ? 128 + interrupt_signal : 0;
}

}  // namespace rockfold
