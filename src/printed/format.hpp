// Numbers as an engineer writes them.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "src/base/types.hpp"

namespace rockfold {

using Json = nlohmann::ordered_json;

/// The factor and the name of a unit that suit numbers of this size: 2.5e6 Pa is 1e6 and "MPa".
struct ScaledUnit {
  Real factor = 1;
  std::string name;
};
ScaledUnit unit_for(Real size, const std::string& unit);

/// Four digits, no exponent where it can be read without; "–" of what is no number.
std::string digits(Real x, int count = 4);
/// The same of a number in a document, where null is no number; divided by `factor`.
std::string digits(const Json& number, int count = 4, Real factor = 1);
/// "2.5 MPa".
std::string quantity(const Json& number, const std::string& unit, int count = 4);
/// "1, 2, 3".
std::string vector_text(const Json& numbers, int count = 4);
/// Names joined by ", ".
std::string joined(const Json& names);
/// Trend and plunge of a direction: "120/35 down".
std::string trend_text(const Json& direction);

}  // namespace rockfold
