#include "host/files/compass.hpp"

#include <array>
#include <cmath>
#include <string>

#include "host/files/text.hpp"

namespace rockfold {

namespace {

/// Capitals and digits alone: "N60E" of "n 60° e".
std::string packed(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c >= 'a' && c <= 'z') result += static_cast<char>(c - 'a' + 'A');
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.') result += c;
  }
  return result;
}

/// Whether the text is of these characters alone, blanks and degree signs.
bool is_bearing_text(std::string_view text) {
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool number = (c >= '0' && c <= '9') || c == '.';
    if (!letter && !number && c != ' ' && c != '\xC2' && c != '\xB0') return false;
  }
  return true;
}

}  // namespace

std::optional<Real> quadrant_bearing(std::string_view text) {
  const std::string bare = packed(text);
  if (!is_bearing_text(text) || bare.size() < 3) return {};
  const char from = bare.front(), to = bare.back();
  if ((from != 'N' && from != 'S') || (to != 'E' && to != 'W')) return {};
  const auto angle = parse_number(std::string_view(bare).substr(1, bare.size() - 2));
  if (!angle || !(*angle >= 0 && *angle <= 90)) return {};
  const Real along = from == 'N' ? 0 : 180, turn = (from == 'N') == (to == 'E') ? *angle : -*angle;
  return std::fmod(along + turn + 360, 360);
}

std::optional<Real> compass_point(std::string_view text) {
  constexpr std::array<std::string_view, 16> points = {"N",  "NNE", "NE", "ENE", "E",  "ESE",
                                                       "SE", "SSE", "S",  "SSW", "SW", "WSW",
                                                       "W",  "WNW", "NW", "NNW"};
  if (!is_bearing_text(text)) return {};
  const std::string bare = packed(text);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (bare == points[i]) return 22.5 * static_cast<Real>(i);
  return {};
}

Real turn_between(Real a, Real b) {
  const Real turn = std::fmod(std::abs(a - b), 360);
  return turn > 180 ? 360 - turn : turn;
}

std::optional<SidedDip> sided_dip(std::string_view text) {
  const auto letters = text.find_first_not_of("0123456789. \xC2\xB0");
  if (letters == std::string_view::npos || letters == 0) return {};
  auto number = trimmed(text.substr(0, letters));
  number = number.substr(0, number.find_first_not_of("0123456789."));
  const auto dip = parse_number(number);
  const auto side = compass_point(text.substr(letters));
  if (!dip || !side) return {};
  return SidedDip{*dip, *side};
}

}  // namespace rockfold
