#include "tests/cut/oracles/exact_volume.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>

#include <boost/multiprecision/cpp_int.hpp>

namespace rockfold::test {

namespace {

// Lengths in units of 1e-25 m: below the last digit of every double over 1e-8 m. Three factors of up to 1e32 and their sums fit.
using Fixed = boost::multiprecision::int512_t;
using Point = std::array<Fixed, 3>;
constexpr int places = 25;

Fixed power_of_ten(int n) {
  Fixed p = 1;
  for (int i = 0; i < n; ++i) p *= 10;
  return p;
}

Fixed fixed(Real x) {
  char text[40];
  const char* const end =
      std::to_chars(text, text + sizeof text, x, std::chars_format::scientific).ptr;
  long long digits = 0;
  int point = 0, exponent = 0;
  bool fraction = false;
  for (const char* c = text; c != end; ++c) {
    if (*c == 'e') {
      exponent = std::atoi(std::string(c + 1, end).c_str());
      break;
    }
    if (*c == '.') fraction = true;
    if (*c < '0' || *c > '9') continue;
    digits = 10 * digits + (*c - '0');
    point += fraction;
  }
  const int shift = places + exponent - point;
  Fixed value = digits;
  if (shift >= 0)
    value *= power_of_ten(shift);
  else
    value /= power_of_ten(std::min(-shift, 30));
  return x < 0 ? Fixed(-value) : value;
}

Point point(const Vec3& x) {
  return {fixed(x[0]), fixed(x[1]), fixed(x[2])};
}

long double cubic_metres(const Fixed& value, int divisor) {
  long double scale = 1;
  for (int i = 0; i < 3 * places; ++i) scale *= 10;
  return value.convert_to<long double>() / divisor / scale;
}

std::vector<Point> points(const TriangleSurface& surface) {
  std::vector<Point> all;
  for (const Vec3& x : surface.vertices) all.push_back(point(x));
  return all;
}

}  // namespace

long double volume_below(const TriangleSurface& ground, Real base) {
  const std::vector<Point> p = points(ground);
  const Fixed below = 3 * fixed(base);
  Fixed six_times = 0;
  for (const auto& t : ground.triangles) {
    const Point &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
    const Fixed twice_the_plan = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    six_times += twice_the_plan * (a[2] + b[2] + c[2] - below);
  }
  return cubic_metres(six_times, 6);
}

long double signed_volume(const TriangleSurface& surface) {
  std::vector<Point> p = points(surface);
  const Point origin = p.front();
  for (Point& x : p)
    for (int d = 0; d < 3; ++d) x[d] -= origin[d];
  Fixed six_times = 0;
  for (const auto& t : surface.triangles) {
    const Point &a = p[t[0]], &b = p[t[1]], &c = p[t[2]];
    six_times += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                 a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return cubic_metres(six_times, 6);
}

long double volume_of_boxes(const std::vector<Solid>& solids) {
  struct Box {
    Point min, max;
    bool add;
  };
  std::vector<Box> boxes;
  std::array<std::vector<Fixed>, 3> cuts;
  for (const Solid& s : solids) {
    const auto& b = std::get<BoxShape>(s.shape);
    boxes.push_back({point(b.min), point(b.max), s.add});
    for (int d = 0; d < 3; ++d) {
      cuts[d].push_back(boxes.back().min[d]);
      cuts[d].push_back(boxes.back().max[d]);
    }
  }
  for (auto& c : cuts) std::sort(c.begin(), c.end());
  Fixed volume = 0;
  for (std::size_t i = 0; i + 1 < cuts[0].size(); ++i)
    for (std::size_t j = 0; j + 1 < cuts[1].size(); ++j)
      for (std::size_t k = 0; k + 1 < cuts[2].size(); ++k) {
        const std::array<std::size_t, 3> at{i, j, k};
        bool rock = false;
        for (const Box& b : boxes) {
          bool inside = true;
          for (int d = 0; d < 3; ++d)
            inside = inside && b.min[d] <= cuts[d][at[d]] && cuts[d][at[d] + 1] <= b.max[d];
          if (inside) rock = b.add;
        }
        if (rock)
          volume += (cuts[0][i + 1] - cuts[0][i]) * (cuts[1][j + 1] - cuts[1][j]) *
                    (cuts[2][k + 1] - cuts[2][k]);
      }
  return cubic_metres(volume, 1);
}

}  // namespace rockfold::test
