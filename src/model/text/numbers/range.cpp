#include "src/model/text/numbers/range.hpp"

#include <cmath>

#include "src/model/text/value.hpp"

namespace rockfold {

namespace {

/// As a person would write it: 90, not 90.0.
std::string bound(Real x) {
  std::string text = number_text(x);
  if (text.size() > 2 && text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

/// "" if there are none.
std::string limits(const Range& range) {
  const bool below = range.low > -largest_number;
  const bool above = range.high < largest_number;
  if (below && above && !range.low_open && !range.high_open)
    return bound(range.low) + " to " + bound(range.high);
  std::string text;
  if (below) text = (range.low_open ? "> " : ">= ") + bound(range.low);
  if (above)
    text +=
        (below ? " and " : "") + std::string(range.high_open ? "< " : "<= ") + bound(range.high);
  return text;
}

std::string in_brackets(const std::string& unit) {
  return unit.empty() ? "" : " (" + unit + ")";
}

}  // namespace

bool Range::holds(Real x) const {  // false for NaN
  return std::abs(x) <= largest && (low_open ? x > low : x >= low) &&
         (high_open ? x < high : x <= high);
}

std::string Range::text() const {
  const auto range = limits(*this);
  return "must be " + (range.empty() ? "a number" : range) + in_brackets(unit);
}

std::string Range::refusal(Real x) const {
  const auto range = limits(*this);
  if (!std::isfinite(x))
    return "must be a finite number" + (range.empty() ? "" : ", " + range) + in_brackets(unit);
  if (std::abs(x) > largest)
    return "must be at most " + bound(largest) + " in size" + in_brackets(unit);
  return text();
}

std::string IntegerRange::text() const {
  if (high == std::numeric_limits<Index>::max())
    return "must be an integer >= " + std::to_string(low);
  return "must be an integer, " + std::to_string(low) + " to " + std::to_string(high);
}

}  // namespace rockfold
