#include "host/files/meshes/last_digit.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace rockfold {

namespace {

// Decimals behind the point of the shortest text that reads back as the same number: of 1.25e-3 five.
template <class Number>
int decimals(Number x) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text - 1, x, std::chars_format::scientific).ptr;
  *end = '\0';
  const std::string_view all(text, static_cast<std::size_t>(end - text));
  const auto point = all.find('.'), e = all.find('e');
  const int fraction = point == std::string_view::npos ? 0 : static_cast<int>(e - point) - 1;
  return std::max(0, fraction - std::atoi(text + e + 1));
}

}  // namespace

Real last_digit(const std::vector<Vec3>& points, bool single_precision) {
  if (points.empty()) return 0;
  int most = 0;
  for (const Vec3& point : points)
    for (const Real x : point)
      most = std::max(most, single_precision ? decimals(static_cast<float>(x)) : decimals(x));
  return std::pow(10.0, -most);
}

}  // namespace rockfold
