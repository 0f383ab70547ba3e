#include "host/files/faults.hpp"

#include <utility>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr std::size_t most_told = 20;

/// Bytes of the UTF-8 character at the front of `text`; 0 = none that can be shown.
std::size_t character_length(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
  const std::size_t length = first >= 0xC2 && first < 0xE0   ? 2
                             : first >= 0xE1 && first < 0xED ? 3
                             : first >= 0xF1 && first < 0xF4 ? 4
                                                             : 0;  // and the rare rest: unshown
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  return length;
}

}  // namespace

void Faults::add(int line, int column, std::string message) {
  if (found_.size() == most_told) {
    ++left_out_;
    return;
  }
  Place place = place_;
  place.line = line;
  place.column = column;
  found_.push_back({std::move(place), std::move(message)});
}

void Faults::fail(int line, int column, std::string message) {
  add(line, column, std::move(message));
  throw_if_any();
  throw Error(ErrorKind::model, "unreachable: a fault was just added", place_);
}

void Faults::throw_if_any() {
  if (found_.empty()) return;
  if (left_out_ > 0) found_.push_back({place_, fmt::format("{} more errors", left_out_)});
  throw Error(ErrorKind::model, found_);
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  while (!word.empty() && text.size() <= longest) {
    const auto length = character_length(word);
    text += length == 0 ? "?" : word.substr(0, length);
    word.remove_prefix(length == 0 ? 1 : length);
  }
  return text + (word.empty() ? "'" : "…'");
}

std::string point_text(const Vec3& point) {
  return fmt::format("({:.10g}, {:.10g}, {:.10g})", point[0], point[1], point[2]);
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace rockfold
