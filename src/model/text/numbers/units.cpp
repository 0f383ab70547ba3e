#include "src/model/text/numbers/units.hpp"

#include <charconv>
#include <numbers>

namespace rockfold {

namespace {

/// One `name` is `factor` times the SI unit that a key takes.
struct Unit {
  std::string_view wanted, name;
  Real factor;
};

constexpr Real g = 9.81;  // m/s2, the default gravity: a unit weight of 26.487 kN/m3 is 2700 kg/m3
constexpr Real foot = 0.3048, inch = 0.0254, pound = 0.45359237;  // exact, 1959
constexpr Real survey_foot = 1200.0 / 3937;                       // of surveys in the USA, 1893
constexpr Real pound_force = pound * 9.80665, psi = pound_force / (inch * inch);

constexpr Unit units[] = {
    {"Pa", "Pa", 1},
    {"Pa", "kPa", 1e3},
    {"Pa", "MPa", 1e6},
    {"Pa", "GPa", 1e9},
    {"Pa", "kN/m2", 1e3},
    {"Pa", "MN/m2", 1e6},
    {"Pa", "N/mm2", 1e6},
    {"Pa", "bar", 1e5},
    {"Pa", "psi", psi},
    {"Pa", "ksi", 1e3 * psi},
    {"Pa", "psf", psi / 144},
    {"kg/m3", "kg/m3", 1},
    {"kg/m3", "t/m3", 1e3},
    {"kg/m3", "g/cm3", 1e3},
    {"kg/m3", "kN/m3", 1e3 / g},
    {"kg/m3", "MN/m3", 1e6 / g},
    {"kg/m3", "N/m3", 1 / g},
    {"kg/m3", "lb/ft3", pound / (foot * foot * foot)},
    {"kg/m3", "pcf", pound / (foot * foot * foot)},
    {"m", "m", 1},
    {"m", "mm", 1e-3},
    {"m", "cm", 1e-2},
    {"m", "km", 1e3},
    {"m", "ft", foot},
    {"m", "usft", survey_foot},
    {"m", "yd", 3 * foot},
    {"m", "in", inch},
    {"deg", "deg", 1},
    {"deg", "°", 1},
    {"deg", "rad", 180 / std::numbers::pi},
    {"deg", "gon", 0.9},
    {"deg", "grad", 0.9},
    {"N", "N", 1},
    {"N", "kN", 1e3},
    {"N", "MN", 1e6},
    {"N", "GN", 1e9},
    {"N", "lbf", pound_force},
    {"N", "kip", 1e3 * pound_force},
    {"Pa/m", "Pa/m", 1},
    {"Pa/m", "kPa/m", 1e3},
    {"Pa/m", "MPa/m", 1e6},
    {"Pa/m", "GPa/m", 1e9},
    {"Pa/m", "MPa/mm", 1e9},
    {"Pa/m", "GPa/mm", 1e12},
    {"N/m", "N/m", 1},
    {"N/m", "kN/m", 1e3},
    {"N/m", "MN/m", 1e6},
    {"N/m", "kN/mm", 1e6},
    {"s", "s", 1},
    {"s", "ms", 1e-3},
    {"s", "min", 60},
    {"s", "h", 3600},
    {"m/s", "m/s", 1},
    {"m/s", "cm/s", 1e-2},
    {"m/s", "mm/s", 1e-3},
    {"m/s2", "m/s2", 1},
    {"m/s2", "cm/s2", 1e-2},
    {"m/s2", "g", g},
    {"m3", "m3", 1},
    {"m3", "l", 1e-3},
    {"m3", "ft3", foot* foot* foot},
    {"kg/m", "kg/m", 1},
    {"bytes", "kB", 1e3},
    {"bytes", "MB", 1e6},
    {"bytes", "GB", 1e9},
    {"bytes", "TB", 1e12},
    {"bytes", "KiB", 1024},
    {"bytes", "MiB", 1048576},
    {"bytes", "GiB", 1073741824},
};

/// Without the hints behind it: "deg clockwise from north" is deg.
std::string_view plain(std::string_view wanted) {
  return wanted.substr(0, wanted.find_first_of(" ,;"));
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Real> number_with_unit(std::string_view text, std::string_view wanted) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  Real number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc{}) return {};
  const auto name = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  for (const Unit& unit : units)
    if (unit.wanted == plain(wanted) && unit.name == name) return number * unit.factor;
  return {};
}

std::string units_of(std::string_view wanted) {
  std::string list;
  for (const Unit& unit : units)
    if (unit.wanted == plain(wanted)) list += (list.empty() ? "" : ", ") + std::string(unit.name);
  return list;
}

std::string other_units(std::string_view wanted) {
  const std::string list = units_of(wanted);
  return list.empty() ? "" : ", or text with a unit: " + list;
}

}  // namespace rockfold
