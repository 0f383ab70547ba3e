// SIGINT and SIGTERM as a flag that long loops poll, so that what was computed is stored before the exit.
#pragma once

#include <csignal>

namespace rockfold {

/// The signal that asked the program to stop, or 0.
inline volatile std::sig_atomic_t interrupt_signal = 0;

inline void catch_interrupts() {
  auto remember = [](int signal) { interrupt_signal = signal; };
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

}  // namespace rockfold
