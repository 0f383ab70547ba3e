// Lines, words and numbers of a text in memory, each with its place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/files/faults.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// The lines of a text, without their ends (LF, CRLF or CR); a byte order mark is skipped. Lines that end with
/// `continuation`, but for comments behind '#', go on in the next one: the line then holds these ends.
class Lines {
 public:
  explicit Lines(std::string_view text, char continuation = '\n');

  /// Goes to the next line; false at the end.
  bool next();
  std::string_view line() const { return line_; }
  /// Of the first one of lines that go on.
  int number() const { return number_; }
  /// What follows the current line's end.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_, line_;
  char continuation_;
  int number_ = 0, more_ = 0;  ///< lines that the current one goes on in
};

/// The words of a line, separated by blanks and by the characters of `separators`.
class Words {
 public:
  explicit Words(std::string_view line, std::string_view separators = "")
      : line_(line), separators_(separators) {}

  /// The next word; "" at the end of the line.
  std::string_view next();
  /// What follows the word that was read last, without blanks and separators around it.
  std::string_view rest() const;
  /// Of the word that was read last, from 1, in bytes.
  int column() const { return static_cast<int>(column_); }

 private:
  bool separates(char c) const {
    return c == ' ' || c == '\t' || separators_.find(c) != std::string_view::npos;
  }

  std::string_view line_, separators_;
  std::size_t at_ = 0, column_ = 0;
};

/// The word as a number, read to the nearest double whatever the locale; none if it is not one from
/// end to end. May be NaN or infinite.
std::optional<Real> parse_number(std::string_view word);
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Why the number cannot be a coordinate ("x is nan: must be a finite number (m)"); "" if it can.
std::string coordinate_fault(std::string_view name, Real value);

/// The word as a coordinate called `name`; adds a fault and gives 0 if it is none.
Real parse_coordinate(std::string_view word, std::string_view name, int line, int column,
                      Faults& faults);

/// x, y and z from the next three words; adds a fault if there are fewer or others.
Vec3 parse_point(Words& words, int line, Faults& faults);

std::string_view trimmed(std::string_view text);
std::string lower_case(std::string_view text);

}  // namespace rockfold
