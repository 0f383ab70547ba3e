// Numbers written with a comma, as half of the world writes them.
#pragma once

#include <string>
#include <string_view>

namespace rockfold {

/// Whether the word is a number with a comma for its point: "2,5", "-0,75".
bool has_decimal_comma(std::string_view word);

/// The number with a comma that a text with a unit begins with: "26,5" of "26,5 kN/m3"; the whole of "2,5"; "" if there is none.
std::string_view decimal_comma_number(std::string_view text);

/// "; decimals stand behind a point: 2.5, not 2,5 (a decimal comma)" of such a word; else "".
std::string decimal_comma_hint(std::string_view word);

/// The first word behind an '=' of the line that is such a number; "" if there is none.
std::string_view decimal_comma_value(std::string_view line);

}  // namespace rockfold
