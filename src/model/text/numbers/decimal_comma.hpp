// Numbers written with a comma, as half of the world writes them.
#pragma once

#include <string>
#include <string_view>

namespace rockfold {

/// Whether the word is a number with a comma for its point: "2,5", "-0,75".
bool has_decimal_comma(std::string_view word);

/// "; decimals stand behind a point: 2.5, not 2,5 (a decimal comma)" of such a word; else "".
std::string decimal_comma_hint(std::string_view word);

/// The first word behind an '=' of the line that is such a number; "" if there is none.
std::string_view decimal_comma_value(std::string_view line);

}  // namespace rockfold
