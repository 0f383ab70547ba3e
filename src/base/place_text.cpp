#include "src/base/place_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace rockfold {

namespace {

/// Without zeros behind the last decimal, and without the sign of zero.
std::string trimmed(std::string number) {
  if (number.find('.') != std::string::npos) {
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
  }
  return number == "-0" ? "0" : number;
}

}  // namespace

std::string place_text(const Vec3& place) {
  Real largest = 0;
  for (const Real x : place) largest = std::max(largest, std::abs(x));
  const bool small = largest > 0 && largest < 1;
  const int decimals =
      small ? std::min(3 - static_cast<int>(std::floor(std::log10(largest))), 15) : 3;
  std::string text;
  for (const Real x : place) {
    char number[64];  // 1e30 at most has 31 digits before the point; what is larger is cut
    std::snprintf(number, sizeof number, "%.*f", decimals, x);
    text += (text.empty() ? "(" : ", ") + trimmed(number);
  }
  return text + ")";
}

std::string given_place_text(const Vec3& place) {
  // Fixed notation: the shortest digits that read back, and no exponent.
  char text[3][400];
  std::string all = "(";
  for (int d = 0; d < 3; ++d) {
    const auto end =
        std::to_chars(text[d], text[d] + sizeof text[d], place[d] + 0.0, std::chars_format::fixed);
    all += std::string(d == 0 ? "" : ", ") + std::string(text[d], end.ptr);
  }
  return all + ")";
}

}  // namespace rockfold
