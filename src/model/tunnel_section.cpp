#include "src/model/tunnel_section.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace rockfold {

namespace {

struct SineCosine {
  Real sine, cosine;
};

/// Of the angle π·m/n, 0 ≤ m ≤ n. Reduced to one octant, so that mirror-image angles have
/// mirror-image values.
SineCosine of_turn(std::int64_t m, std::int64_t n) {
  if (2 * m > n) {
    const auto [s, c] = of_turn(n - m, n);
    return {s, -c};
  }
  if (4 * m > n) {
    const auto [s, c] = of_turn(n - 2 * m, 2 * n);  // π/2 less the angle
    return {c, s};
  }
  const Real angle = std::numbers::pi * static_cast<Real>(m) / static_cast<Real>(n);
  return {std::sin(angle), std::cos(angle)};
}

/// From the right half of a section, bottom to top, the whole of it; a point with x = 0 can only be
/// the last one.
Section mirrored(Section right) {
  const bool crown = right.back()[0] == 0;
  for (std::size_t i = right.size() - (crown ? 1 : 0); i-- > 0;)
    right.push_back({-right[i][0], right[i][1]});
  return right;
}

/// Adds the right half of the roof without its springing point.
void add_half_roof(Section& right, Real width, Real spring, Index sides) {
  const Real radius = width / 2;
  for (Index k = 1; 2 * k <= sides; ++k) {
    const auto [sine, cosine] = of_turn(k, sides);
    right.push_back({2 * k == sides ? 0.0 : radius * cosine, spring + radius * sine});
  }
}

}  // namespace

Section circle_section(Real radius, Index sides) {
  Section right;
  for (Index k = 0; 2 * k < sides; ++k) {  // angles from the bottom, in half steps
    const std::int64_t turn = 2 * std::int64_t{k} + 1;
    const auto [sine, cosine] = of_turn(turn, sides);
    right.push_back({turn == sides ? 0.0 : radius * sine, -radius * cosine});
  }
  return mirrored(right);
}

Section rectangle_section(Real width, Real height) {
  return mirrored({{width / 2, 0}, {width / 2, height}});
}

Section d_shape_section(Real width, Real height, Index sides) {
  const Real spring = std::max(height - width / 2, 0.0);
  Section right{{width / 2, 0}};
  if (spring > 0) right.push_back({width / 2, spring});
  add_half_roof(right, width, spring, sides);
  return mirrored(right);
}

Section horseshoe_section(Real width, Real height, Index sides) {
  const Real depth = std::max(height - width / 2, 0.0);  // of the floor under the springing line
  const Real angle = std::asin(std::min(depth / width, 1.0));
  const Real chord = std::numbers::pi * width / 2 / sides;
  const auto chords = std::max<std::int64_t>(1, std::llround(angle * width / chord));
  Section right;
  for (std::int64_t k = 0; depth > 0 && k < chords; ++k) {
    const Real at = angle * static_cast<Real>(chords - k) / static_cast<Real>(chords);
    right.push_back({width * std::cos(at) - width / 2, k == 0 ? 0 : depth - width * std::sin(at)});
  }
  right.push_back({width / 2, depth});
  add_half_roof(right, width, depth, sides);
  return mirrored(right);
}

Real horseshoe_height_limit(Real width) {
  return (1 + std::numbers::sqrt3) / 2 * width;
}

}  // namespace rockfold
