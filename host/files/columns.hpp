// Columns of tables in text: the fields of a line, what a heading calls them, and their units.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/files/faults.hpp"

namespace rockfold {

struct Field {
  std::string text;
  int column = 0;  ///< in the line, from 1
};

/// What stands between the fields of a line: ';', ',', a tab, or ' ' for blanks.
char separator_of(std::string_view line);

/// The fields of a line, without quotes and blanks around them; none after a fault, which is added. Blanks part words: fields
/// are then neither empty nor quoted.
std::vector<Field> split_fields(std::string_view line, char separator, int number, Faults& faults);

/// "dipdir" of "Dip dir. (deg)", "hohe" of "Höhe [m]": lower case, without accents, signs and what stands in brackets or behind a comma.
std::string bare_name(std::string_view heading);

/// What the numbers of a column are in, and where the file says so.
struct ColumnUnit {
  std::string text = {};     ///< lower case, as of unit_in(); "": nothing says a unit
  std::string said_in = {};  ///< the heading, or the field below it
  int line = 0, column = 0;
};

/// "m/s2" of "Acc. (m/s²)", "%" of "Persistence [%]", "usft" of "North, US ft", "g" of "acc in g": lower case; "" where a heading
/// names none. Behind a bracket or a comma any text is one, behind a blank a unit that is known.
std::string unit_in(std::string_view heading);
ColumnUnit unit_of_heading(const Field& heading, int line);

/// A text that is a unit and nothing else, as unit_in() has it: of "(deg)", "[m]", "m/s^2"; none of other texts.
std::optional<std::string> unit_alone(std::string_view text);

/// One `unit` in `wanted` ("m", "deg", "s", "m/s2"); 1 of "", none where it is not known. Behind a length the datum of its height may
/// stand ("m AHD"), and in its place the name of an axis ("Easting (X)").
std::optional<Real> unit_factor(const std::string& unit, std::string_view wanted);
/// Why a unit is refused: "the unit of 'North (furlong)' is not known: lengths are in m, mm, …".
std::string unknown_unit(std::string_view said_in, std::string_view wanted);
/// The factor; 1 after a fault, which is added.
Real unit_factor(const ColumnUnit& unit, std::string_view wanted, Faults& faults);

/// Whether these fields stand below a heading and say nothing but units: "(deg)", "(m)", "".
bool are_units(const std::vector<Field>& fields);

/// How surely a heading names an axis: "x"; "Easting" or "Rechtswert"; "E".
enum class NameKind { axis, word, letter };
constexpr NameKind name_kinds[] = {NameKind::axis, NameKind::word, NameKind::letter};

/// The axis that a bare name means, 0 x (east), 1 y (north), 2 z (up); none where it means no axis in that way.
std::optional<std::size_t> axis_called(std::string_view bare, NameKind kind);

/// Whether a bare name is that of a latitude or longitude.
bool is_geographic(std::string_view bare);

/// What to do about columns of latitudes and longitudes.
constexpr const char* geographic_advice =
    "latitude and longitude are degrees, coordinates are metres: reproject the table to a metric "
    "grid, as UTM (cs2cs, QGIS), and give Easting and Northing";

/// A number whose thousands are parted by commas, apostrophes or blanks, as in "4,123,456.78" or "2'600'000"; none of other
/// texts. Without `sure`, that of "412,345" too, whose comma may be that of decimals.
std::optional<Real> grouped_number(std::string_view text, bool sure = true);

}  // namespace rockfold
