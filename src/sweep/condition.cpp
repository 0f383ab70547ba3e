#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "src/sweep/sweep_spec.hpp"

namespace rockfold::sweep {

namespace {

constexpr std::pair<const char*, Condition::Operator> operators[] = {
    {">=", Condition::Operator::at_least}, {"<=", Condition::Operator::at_most},
    {"==", Condition::Operator::equal},    {"!=", Condition::Operator::other},
    {">", Condition::Operator::more},      {"<", Condition::Operator::less}};

std::string trimmed(std::string text) {
  const auto blank = [](unsigned char c) { return std::isspace(c) == 0; };
  text.erase(text.begin(), std::find_if(text.begin(), text.end(), blank));
  text.erase(std::find_if(text.rbegin(), text.rend(), blank).base(), text.end());
  return text;
}

/// The parts of `text` between whole words `word`.
std::vector<std::string> split(const std::string& text, const std::string& word) {
  std::vector<std::string> parts;
  const std::string mark = " " + word + " ";
  std::size_t begin = 0, at = 0;
  while ((at = text.find(mark, begin)) != std::string::npos) {
    parts.push_back(text.substr(begin, at - begin));
    begin = at + mark.size();
  }
  parts.push_back(text.substr(begin));
  return parts;
}

Condition::Comparison parse_comparison(const std::string& text) {
  const auto at = text.find_first_of("<>=!");
  const auto expected = "must be 'NAME > NUMBER' (or >=, <, <=, ==, !=), joined by 'and', 'or'";
  if (at == std::string::npos)
    throw std::invalid_argument(fmt::format("found '{}', {}", trimmed(text), expected));
  for (const auto& [sign, op] : operators) {
    if (text.compare(at, std::string(sign).size(), sign) != 0) continue;
    const std::string name = trimmed(text.substr(0, at)),
                      number = trimmed(text.substr(at + std::string(sign).size()));
    Real value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (name.empty() || error != std::errc{} || end != number.data() + number.size() ||
        !std::isfinite(value))
      break;
    return {name, op, value};
  }
  throw std::invalid_argument(fmt::format("found '{}', {}", trimmed(text), expected));
}

}  // namespace

Condition parse_condition(const std::string& text) {
  Condition condition;
  for (const std::string& all : split(text, "or")) {
    auto& comparisons = condition.any_of_all.emplace_back();
    for (const std::string& one : split(all, "and")) comparisons.push_back(parse_comparison(one));
  }
  return condition;
}

}  // namespace rockfold::sweep
