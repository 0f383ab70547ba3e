// The user's terminal: warnings, and the progress of the phases, on one stream (stderr) so that
// they never overwrite each other. On a terminal a bar that is drawn in place; elsewhere a plain
// line every few seconds.
#pragma once

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "src/base/progress.hpp"
#include "src/base/timer.hpp"
#include "src/report/progress_line.hpp"
#include "src/report/progress_stream.hpp"

namespace rockfold {

struct TerminalSettings {
  bool progress = true;      ///< false: warnings and errors alone
  bool interactive = false;  ///< the stream is a terminal that understands \r
  bool colour = false;
  bool unicode = false;
};

/// The settings for a stream: is it a terminal, NO_COLOR, TERM=dumb, the character set of LC_ALL,
/// LC_CTYPE, LANG.
TerminalSettings detect_terminal(std::FILE* stream);

class Terminal : public Progress {
 public:
  Terminal(std::FILE* stream, const TerminalSettings& settings)
      : stream_(stream), settings_(settings) {}
  ~Terminal() override;
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// From now on writes what it tells, and how long each phase took, to a file too, below a title. Throws Error(io) where it
  /// cannot be written, Error(usage) where a file is there that is no log.
  void log_to(const std::string& path, const std::string& title);
  /// From now on tells how far each phase is to another program too. Throws Error(usage) where the descriptor is not open.
  void tell_progress_to(int descriptor) { told_.emplace(descriptor); }
  /// A line for the log alone; nothing without one.
  void log(const std::string& text);

  void set_progress(bool progress) { settings_.progress = progress; }

  void begin(std::string_view phase, std::int64_t total, std::string_view unit) override;
  void done(std::int64_t count) override;
  void end() override;

  /// Tells the user once and keeps the text for the JSON; the same text again is not repeated.
  void warn(const std::string& text);
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// An error line; any bar is wiped first.
  void error_line(const std::string& text);

 private:
  void draw();
  void clear_bar();
  void write_line(const std::string& text);

  std::FILE* stream_;
  std::FILE* log_ = nullptr;
  std::optional<ProgressStream> told_;
  TerminalSettings settings_;
  std::vector<std::string> warnings_;
  PhaseView view_;
  Timer phase_timer_;
  double next_line_ = 0;  ///< s of the phase's time at which to draw or log again
  bool running_ = false;
  bool logged_ = false;  ///< this phase has written a plain line
  bool drawn_ = false;   ///< a bar stands on the terminal's last line
};

}  // namespace rockfold
