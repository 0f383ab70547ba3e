#include "src/printed/format.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr Real degrees = 180 / std::numbers::pi;
const std::string no_number = "–";

}  // namespace

ScaledUnit unit_for(Real size, const std::string& unit) {
  constexpr std::array<std::pair<Real, const char*>, 6> prefixes{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}}};
  size = std::abs(size);
  if (unit == "m" && size > 0 && size < 0.02) return {1e-3, "mm"};
  const bool prefixed =
      unit == "N" || unit == "Pa" || unit == "J" || unit == "Pa/m" || unit == "N/m";
  if (!prefixed || !(size > 0)) return {1, unit};
  for (const auto& [factor, prefix] : prefixes)
    if (size >= 0.9999 * factor) return {factor, prefix + unit};
  return {1, unit};
}

std::string digits(Real x, int count) {
  if (!std::isfinite(x)) return no_number;
  if (x == 0) return "0";
  const Real size = std::abs(x);
  if (size < 1e-4 || size >= 1e7) return fmt::format("{:.{}e}", x, count - 2);
  if (size >= std::pow(10, count - 1)) return fmt::format("{:.0f}", x);
  std::string text = fmt::format("{:.{}g}", x, count);
  return text == "-0" ? "0" : text;
}

std::string digits(const Json& number, int count, Real factor) {
  return number.is_number() ? digits(number.get<Real>() / factor, count) : no_number;
}

std::string quantity(const Json& number, const std::string& unit, int count) {
  if (!number.is_number()) return no_number;
  const auto [factor, name] = unit_for(number.get<Real>(), unit);
  return digits(number.get<Real>() / factor, count) + (name.empty() ? "" : " " + name);
}

std::string vector_text(const Json& numbers, int count) {
  std::string text;
  for (const Json& number : numbers) text += (text.empty() ? "" : ", ") + digits(number, count);
  return text;
}

std::string joined(const Json& names) {
  std::string text;
  for (const Json& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text;
}

std::string trend_text(const Json& direction) {
  const Real x = direction.at(0), y = direction.at(1), z = direction.at(2);
  if (x == 0 && y == 0 && z == 0) return no_number;
  const Real plunge = std::atan2(-z, std::hypot(x, y)) * degrees;
  if (std::abs(plunge) > 89.5) return plunge > 0 ? "down" : "up";
  const auto trend = static_cast<int>(std::lround(std::atan2(x, y) * degrees + 360)) % 360;
  return fmt::format("{:03}/{:02.0f}{}", trend, std::abs(plunge), plunge < -0.5 ? " up" : "");
}

}  // namespace rockfold
