// One line of text that says how far a phase is. Pure functions of numbers, so that tests can read
// them.
#pragma once

#include <cstdint>
#include <string>

namespace rockfold {

/// How far a phase is.
struct PhaseView {
  std::string phase;  ///< "Cutting blocks"
  std::string unit;   ///< "cells"
  std::int64_t count = 0;
  std::int64_t total = 0;  ///< 0 = unknown
  double seconds = 0;      ///< since the phase began
};

struct LineStyle {
  int width = 80;  ///< columns of the terminal; the line takes one less
  bool unicode = true;
  bool colour = true;
};

/// "Cutting blocks ━━━━━━━╸──────  48 %  13,000/27,000 cells  4.5k cells/s  0:03 left".
/// Where the terminal is narrow the bar, then the rate, then the count are left out; the phase goes
/// last.
std::string progress_line(const PhaseView& view, const LineStyle& style);

/// The same without a bar, for a log: "Cutting blocks: 48 %, 13,000/27,000 cells, 4.5k cells/s,
/// 0:03 left".
std::string progress_log_line(const PhaseView& view);

/// What stays when a phase is over: "Cutting blocks  27,000 cells  5.9 s  4.6k cells/s".
std::string phase_end_line(const PhaseView& view);

/// 27000 → "27,000".
std::string grouped(std::int64_t n);
/// 4512.3 → "4.5k".
std::string rate_text(double per_second);
/// 63.2 → "1:03", 3700 → "1:01:40".
std::string duration_text(double seconds);

}  // namespace rockfold
