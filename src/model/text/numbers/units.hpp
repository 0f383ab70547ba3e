// Numbers with a unit, as text: "25 MPa".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "src/base/types.hpp"

namespace rockfold {

/// A number with a unit in the unit that a key takes: `wanted` as of a Range, "Pa", "deg clockwise from north", …
/// "30 kN/m3" for a density is a unit weight, at 9.81 m/s2. None for what is not such a text.
std::optional<Real> number_with_unit(std::string_view text, std::string_view wanted);

/// "m, mm, cm, …": the units in which such a number may be given; "" where there are none.
std::string units_of(std::string_view wanted);

/// ", or text with one of the units Pa, kPa, …" for messages; "" where the wanted unit has no others.
std::string other_units(std::string_view wanted);

}  // namespace rockfold
