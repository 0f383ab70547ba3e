#include "src/model/text/numbers/decimal_comma.hpp"

#include <algorithm>

namespace rockfold {

namespace {

constexpr std::string_view digits = "0123456789";

/// How many digits the text begins with.
std::size_t digits_before_other(std::string_view text) {
  return std::min(text.find_first_not_of(digits), text.size());
}

/// Of the number with a comma that the text begins with; 0 = it does not.
std::size_t length_with_comma(std::string_view text) {
  const std::size_t sign = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t comma = sign + digits_before_other(text.substr(sign));
  if (comma == sign || comma >= text.size() || text[comma] != ',') return 0;
  const std::size_t decimals = digits_before_other(text.substr(comma + 1));
  return decimals == 0 ? 0 : comma + 1 + decimals;
}

}  // namespace

bool has_decimal_comma(std::string_view word) {
  return !word.empty() && length_with_comma(word) == word.size();
}

std::string_view decimal_comma_number(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const std::size_t length = length_with_comma(text);
  const bool goes_on = length < text.size() && (text[length] == ',' || text[length] == '.');
  if (goes_on) return {};  // "1,2,3" is a list, "1,234.5" has a point
  return text.substr(0, length);
}

std::string decimal_comma_hint(std::string_view word) {
  if (!has_decimal_comma(word)) return "";
  std::string right(word);
  right[right.find(',')] = '.';
  return "; decimals stand behind a point: " + right + ", not " + std::string(word) +
         " (a decimal comma)";
}

std::string_view decimal_comma_value(std::string_view line) {
  for (std::size_t at = line.find('='); at != std::string_view::npos; at = line.find('=', at + 1)) {
    const auto begin = std::min(line.find_first_not_of(" \t", at + 1), line.size());
    const auto value = line.substr(begin);
    if (const auto length = length_with_comma(value)) return value.substr(0, length);
  }
  return {};
}

}  // namespace rockfold
