#include "src/report/progress_line.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr int widest_bar = 30, narrowest_bar = 8;

/// Columns of a text of one-column characters: UTF-8 continuation bytes take none.
int columns(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string first_columns(const std::string& text, int n) {
  std::size_t bytes = 0;
  for (int seen = 0; bytes < text.size(); ++bytes)
    if ((text[bytes] & 0xC0) != 0x80 && ++seen > n) break;
  return text.substr(0, bytes);
}

std::string repeated(std::string_view glyph, int n) {
  std::string text;
  for (int i = 0; i < n; ++i) text += glyph;
  return text;
}

double fraction(const PhaseView& view) {
  return view.total > 0 ? std::clamp(double(view.count) / double(view.total), 0.0, 1.0) : 0.0;
}

std::string bar(double part, int width, const LineStyle& style) {
  const int full = static_cast<int>(std::floor(part * width));
  if (!style.unicode) return "[" + repeated("#", full) + repeated("-", width - full) + "]";
  const std::string done = repeated("━", full), rest = repeated("─", width - full);
  return style.colour ? "\033[36m" + done + "\033[2m" + rest + "\033[0m" : done + rest;
}

struct Parts {
  std::string percent, count, rate, left;
};

Parts parts(const PhaseView& view) {
  Parts p;
  const double rate = view.seconds > 0 ? view.count / view.seconds : 0.0;
  if (view.total > 0) {
    p.percent = fmt::format("{:3.0f} %", std::floor(100 * fraction(view)));
    const std::string total = grouped(view.total);
    p.count = fmt::format("{:>{}}/{} {}", grouped(view.count), total.size(), total, view.unit);
    if (rate > 0)
      p.left = duration_text(double(std::max<std::int64_t>(view.total - view.count, 0)) / rate) +
               " left";
  } else {
    if (view.count > 0) p.count = fmt::format("{} {}", grouped(view.count), view.unit);
    if (view.seconds > 0) p.left = duration_text(view.seconds);
  }
  if (rate > 0) p.rate = fmt::format("{} {}/s", rate_text(rate), view.unit);
  return p;
}

std::string joined(std::initializer_list<std::string> texts, std::string_view separator) {
  std::string line;
  for (const auto& text : texts)
    if (!text.empty()) line += (line.empty() ? "" : std::string(separator)) + text;
  return line;
}

}  // namespace

std::string progress_line(const PhaseView& view, const LineStyle& style) {
  const int room = std::max(style.width - 1, 1);  // the last column would wrap on some terminals
  const Parts p = parts(view);
  for (const auto& tail :
       {joined({p.percent, p.count, p.rate, p.left}, "  "),
        joined({p.percent, p.count, p.left}, "  "), joined({p.percent, p.left}, "  "),
        p.percent.empty() ? p.count : p.percent}) {
    std::string plain = tail.empty() ? view.phase : view.phase + "  " + tail;
    const int frame = style.unicode ? 0 : 2;
    const int bar_width = std::min(widest_bar, room - columns(plain) - 1 - frame);
    if (view.total > 0 && bar_width >= narrowest_bar)
      return view.phase + " " + bar(fraction(view), bar_width, style) + "  " + tail;
    if (columns(plain) <= room) return plain;
  }
  return first_columns(view.phase, room);
}

std::string progress_log_line(const PhaseView& view) {
  const Parts p = parts(view);
  const auto first = p.percent.find_first_not_of(' ');
  const auto number = p.count.find_first_not_of(' ');
  return view.phase + ": " +
         joined({first == std::string::npos ? "" : p.percent.substr(first), p.count.substr(number),
                 p.rate, p.left},
                ", ");
}

std::string phase_end_line(const PhaseView& view) {
  const double rate = view.seconds > 0 ? view.count / view.seconds : 0.0;
  const auto count = view.count > 0 ? fmt::format("{:>12} {:<8}", grouped(view.count), view.unit)
                                    : std::string(21, ' ');
  const auto speed =
      view.count > 0 && rate > 0 ? fmt::format("  {:>7} {}/s", rate_text(rate), view.unit) : "";
  return fmt::format("{:<20} {} {:>8.2f} s{}", view.phase, count, view.seconds, speed);
}

std::string grouped(std::int64_t n) {
  std::string digits = std::to_string(n);
  const auto first = n < 0 ? 1 : 0;
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > first; at -= 3)
    digits.insert(at, ",");
  return digits;
}

std::string rate_text(double per_second) {
  if (per_second >= 1e6) return fmt::format("{:.3g}M", per_second / 1e6);
  if (per_second >= 1e3) return fmt::format("{:.3g}k", per_second / 1e3);
  return fmt::format("{:.3g}", per_second);
}

std::string duration_text(double seconds) {
  constexpr double longest = 359999;  // 99:59:59; also catches infinity
  const auto s = static_cast<long>(std::min(std::ceil(seconds), longest));
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace rockfold
