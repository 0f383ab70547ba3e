// The numbers that a key accepts, and how a message says so.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "src/base/types.hpp"

namespace rockfold {

/// Magnitudes over this are mistakes in any SI unit, and their products would overflow.
constexpr Real largest_number = 1e30;
/// Coordinates over this are mistakes: at 1e9 m a double resolves 1e-7 m.
constexpr Real largest_coordinate = 1e9;

struct Range {
  Real low = -largest_number;
  Real high = largest_number;
  bool low_open = false;          ///< low itself is out
  bool high_open = false;         ///< high itself is out
  std::string unit = {};          ///< in brackets behind the range: unit and hint
  Real largest = largest_number;  ///< bound on the magnitude, told only where it is passed

  bool holds(Real x) const;
  /// "must be > 0 (m)", "must be 0 to 90 (deg)", "must be a number (N)".
  std::string text() const;
  /// Why x is refused, with what would be right.
  std::string refusal(Real x) const;
};

inline Range any_number(std::string unit) {
  return {.unit = std::move(unit)};
}
inline Range positive(std::string unit) {
  return {.low = 0, .low_open = true, .unit = std::move(unit)};
}
inline Range not_negative(std::string unit) {
  return {.low = 0, .unit = std::move(unit)};
}
inline Range between(Real low, Real high, std::string unit) {
  return {.low = low, .high = high, .unit = std::move(unit)};
}
inline Range coordinate() {
  return {.unit = "m", .largest = largest_coordinate};
}
/// Lengths > 0.
inline Range length() {
  return {.low = 0, .low_open = true, .unit = "m", .largest = largest_coordinate};
}

struct IntegerRange {
  Index low = 0;
  Index high = std::numeric_limits<Index>::max();

  bool holds(std::int64_t n) const { return n >= low && n <= high; }
  /// "must be an integer >= 1", "must be an integer, 0 to 2".
  std::string text() const;
};

}  // namespace rockfold
