#include "tests/cut/oracles/lattice_arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>

#include "src/base/vector.hpp"

namespace rockfold::test {

namespace {

using Integer = std::int64_t;

LatticePlane lowest_terms(LatticePlane p) {
  Integer common = 0;
  for (const Integer c : p) common = std::gcd(common, c);
  const auto lead = std::find_if(p.begin(), p.end(), [](Integer c) { return c != 0; });
  if (lead != p.end() && *lead < 0) common = -common;
  for (Integer& c : p) c /= common;
  return p;
}

Integer determinant(const std::array<Integer, 3>& a, const std::array<Integer, 3>& b,
                    const std::array<Integer, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// The meeting point (X, Y, Z, W) in lowest terms with W > 0, or W = 0.
std::array<Integer, 4> meeting_point(const LatticePlane& a, const LatticePlane& b,
                                     const LatticePlane& c) {
  const auto column = [&](int d, int e, int f) {
    return determinant({a[d], a[e], a[f]}, {b[d], b[e], b[f]}, {c[d], c[e], c[f]});
  };
  const Integer w = column(0, 1, 2);
  if (w == 0) return {};
  std::array<Integer, 4> x{column(3, 1, 2), column(0, 3, 2), column(0, 1, 3), w};
  Integer common = 0;
  for (const Integer i : x) common = std::gcd(common, i);
  if (w < 0) common = -common;
  for (Integer& i : x) i /= common;
  return x;
}

signed char sign(Real x) {
  return static_cast<signed char>(x > 0 ? 1 : x < 0 ? -1 : 0);
}

}  // namespace

LatticePlane lattice_plane(const std::array<Integer, 3>& n, const std::array<Integer, 3>& p) {
  return lowest_terms({n[0], n[1], n[2], n[0] * p[0] + n[1] * p[1] + n[2] * p[2]});
}

LatticeArrangement::LatticeArrangement(Integer edge, const std::vector<LatticePlane>& planes) {
  for (int d = 0; d < 3; ++d)
    for (const Integer at : {Integer{0}, edge}) {
      LatticePlane p{};
      p[d] = 1;
      p[3] = at;
      planes_.push_back(lowest_terms(p));
    }
  for (const LatticePlane& p : planes)
    if (std::find(planes_.begin(), planes_.end(), p) == planes_.end()) planes_.push_back(p);

  std::set<std::array<Integer, 4>> points;
  for (std::size_t i = 0; i < planes_.size(); ++i)
    for (std::size_t j = i + 1; j < planes_.size(); ++j)
      for (std::size_t k = j + 1; k < planes_.size(); ++k) {
        const auto x = meeting_point(planes_[i], planes_[j], planes_[k]);
        bool in_box = x[3] != 0;
        for (int d = 0; d < 3 && in_box; ++d) in_box = x[d] >= 0 && x[d] <= edge * x[3];
        if (in_box) points.insert(x);
      }
  for (const auto& x : points) {
    Point point;
    for (int d = 0; d < 3; ++d) point.x[d] = static_cast<Real>(x[d]) / static_cast<Real>(x[3]);
    for (const LatticePlane& p : planes_)
      point.side.push_back(
          sign(static_cast<Real>(p[0] * x[0] + p[1] * x[1] + p[2] * x[2] - p[3] * x[3])));
    points_.push_back(std::move(point));
  }
}

LatticeArrangement::Cell LatticeArrangement::cell(const Vec3& inside) const {
  Cell cell;
  for (const LatticePlane& p : planes_)
    cell.side.push_back(sign(static_cast<Real>(p[0]) * inside[0] +
                             static_cast<Real>(p[1]) * inside[1] +
                             static_cast<Real>(p[2]) * inside[2] - static_cast<Real>(p[3])));
  std::vector<const Point*> corners;
  for (const Point& point : points_) {
    bool in = true;
    for (std::size_t p = 0; p < planes_.size() && in; ++p) in = point.side[p] * cell.side[p] >= 0;
    if (in) corners.push_back(&point);
  }
  cell.vertices = static_cast<Index>(corners.size());
  for (std::size_t p = 0; p < planes_.size(); ++p) {
    std::vector<Vec3> polygon;
    Vec3 middle{};
    for (const Point* c : corners)
      if (c->side[p] == 0) polygon.push_back(c->x), middle += c->x;
    if (polygon.size() < 3) continue;  // corners of a convex cell: three never lie on a line
    ++cell.faces;
    middle = (1.0 / static_cast<Real>(polygon.size())) * middle;
    const Vec3 n = normalized({static_cast<Real>(planes_[p][0]), static_cast<Real>(planes_[p][1]),
                               static_cast<Real>(planes_[p][2])});
    const Vec3 u = polygon[0] - middle, w = cross(n, u);
    std::sort(polygon.begin(), polygon.end(), [&](const Vec3& a, const Vec3& b) {
      return std::atan2(dot(a - middle, w), dot(a - middle, u)) <
             std::atan2(dot(b - middle, w), dot(b - middle, u));
    });
    for (std::size_t k = 0; k < polygon.size(); ++k)
      cell.volume +=
          std::abs(dot(middle - inside,
                       cross(polygon[k] - inside, polygon[(k + 1) % polygon.size()] - inside))) /
          6;
  }
  return cell;
}

}  // namespace rockfold::test
