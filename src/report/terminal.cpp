#include "src/report/terminal.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <sys/ioctl.h>
#include <unistd.h>

#include "src/base/error.hpp"

namespace rockfold {

namespace {

constexpr double redraw_every = 0.1;  // s; faster than that no eye follows
constexpr double log_every = 5.0;     // s between plain lines where stderr is no terminal

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value && *value;
}

/// POSIX: the first of these that is set and not empty decides.
bool utf8_locale() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    if (!is_set(name)) continue;
    std::string value = std::getenv(name);
    std::transform(value.begin(), value.end(), value.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return value.find("utf-8") != std::string::npos || value.find("utf8") != std::string::npos;
  }
  return false;
}

int terminal_width(std::FILE* stream) {
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace

TerminalSettings detect_terminal(std::FILE* stream) {
  const char* kind = std::getenv("TERM");
  TerminalSettings settings;
  settings.interactive = isatty(fileno(stream)) && kind && std::string_view(kind) != "dumb";
  settings.colour = settings.interactive && !is_set("NO_COLOR");
  settings.unicode = utf8_locale();
  return settings;
}

Terminal::~Terminal() {
  clear_bar();
  if (log_) std::fclose(log_);
}

void Terminal::log_to(const std::string& path, const std::string& title) {
  constexpr std::string_view mark = "log of rockfold";
  std::string begin(mark.size(), ' ');
  if (std::ifstream(path).read(begin.data(), static_cast<std::streamsize>(begin.size())).gcount() >
          0 &&
      begin != mark)
    throw Error(ErrorKind::usage,
                "is there, and no log that could be replaced: give --log another name",
                Place{path, 0, 0, ""});
  log_ = std::fopen(path.c_str(), "w");
  if (!log_)
    throw Error(ErrorKind::io, std::string("cannot be written: ") + std::strerror(errno),
                Place{path, 0, 0, ""});
  log(std::string(mark) + " " + title);
}

void Terminal::log(const std::string& text) {
  if (!log_) return;
  std::fprintf(log_, "%s\n", text.c_str());
  std::fflush(log_);
}

void Terminal::begin(std::string_view phase, std::int64_t total, std::string_view unit) {
  if (running_) end();
  view_ = PhaseView{std::string(phase), std::string(unit), 0, total, 0.0};
  phase_timer_ = Timer();
  next_line_ = settings_.interactive ? redraw_every : log_every;
  running_ = true;
  logged_ = false;
  if (!view_.phase.empty())
    view_.phase[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(view_.phase[0])));
  if (told_) told_->tell(view_);
  if (settings_.progress && settings_.interactive) draw();
}

void Terminal::done(std::int64_t count) {
  if (!running_) return;
  view_.count = count;
  view_.seconds = phase_timer_.seconds();
  if (told_) told_->tell(view_);
  if (!settings_.progress || view_.seconds < next_line_) return;
  if (settings_.interactive) {
    draw();
    next_line_ = view_.seconds + redraw_every;
  } else {
    write_line(progress_log_line(view_));
    logged_ = true;
    next_line_ = view_.seconds + log_every;
  }
}

void Terminal::end() {
  if (!running_) return;
  running_ = false;
  view_.seconds = phase_timer_.seconds();
  clear_bar();
  log(phase_end_line(view_));
  if (told_) told_->tell_end(view_);
  if (settings_.progress && (settings_.interactive || logged_)) write_line(phase_end_line(view_));
}

void Terminal::warn(const std::string& text) {
  if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end()) return;
  warnings_.push_back(text);
  clear_bar();
  log("warning: " + text);
  write_line((settings_.colour ? "\033[33mwarning:\033[0m " : "warning: ") + text);
}

void Terminal::error_line(const std::string& text) {
  running_ = false;
  clear_bar();
  log(text);
  write_line(text);
}

void Terminal::draw() {
  const LineStyle style{terminal_width(stream_), settings_.unicode, settings_.colour};
  std::fprintf(stream_, "\r%s\033[K", progress_line(view_, style).c_str());
  std::fflush(stream_);
  drawn_ = true;
}

void Terminal::clear_bar() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stream_);
  std::fflush(stream_);
  drawn_ = false;
}

void Terminal::write_line(const std::string& text) {
  std::fprintf(stream_, "%s\n", text.c_str());
  std::fflush(stream_);
}

}  // namespace rockfold
