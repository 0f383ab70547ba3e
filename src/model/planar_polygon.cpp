#include "src/model/planar_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Point2 = std::array<Real, 2>;

/// Relative to the polygon's size; ten times the tolerance by which the cutter takes planes for one.
constexpr Real tolerance = 1e-9;
constexpr std::size_t most_points = 10'000;  // bounds the search for crossing edges to a second

Real largest_distance(const std::vector<Vec3>& points) {
  Real size = 0;
  for (const auto& p : points) size = std::max(size, norm(p - points[0]));
  return size;
}

std::string number(std::size_t i) {
  return std::to_string(i + 1);
}

std::string equal_points(std::size_t i, std::size_t j) {
  return "points " + number(i) + " and " + number(j) + " are equal";
}

std::string equal_neighbours(const std::vector<Vec3>& points, Real size) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t j = (i + 1) % points.size();
    if (norm(points[j] - points[i]) > tolerance * size) continue;
    return equal_points(i, j) + (j == 0 ? "; the last edge closes by itself" : "");
  }
  return "";
}

/// Coordinates far from the origin are themselves rounded by more than 1e-9 of a small polygon's
/// size.
std::string off_plane(const std::vector<Vec3>& points, const Vec3& normal, Real size) {
  Real farthest = 0;
  for (const auto& p : points) farthest = std::max(farthest, norm(p));
  const Real off = tolerance * size + 4 * std::numeric_limits<Real>::epsilon() * farthest;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::abs(dot(normal, points[i] - points[0])) > off)
      return "point " + number(i) + " is not in one plane with the others";
  return "";
}

/// Coordinates in the polygon's plane, about its first point.
std::vector<Point2> flattened(const std::vector<Vec3>& points, const Vec3& normal) {
  Vec3 axis{};
  const Vec3 n{std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])};
  axis[std::min_element(n.begin(), n.end()) - n.begin()] = 1;
  const Vec3 u = normalized(cross(axis, normal)), v = cross(normal, u);
  std::vector<Point2> flat;
  flat.reserve(points.size());
  for (const auto& p : points) flat.push_back({dot(u, p - points[0]), dot(v, p - points[0])});
  return flat;
}

Point2 operator-(const Point2& a, const Point2& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
Real dot(const Point2& a, const Point2& b) {
  return a[0] * b[0] + a[1] * b[1];
}
Real cross(const Point2& a, const Point2& b) {
  return a[0] * b[1] - a[1] * b[0];
}
Real norm(const Point2& a) {
  return std::hypot(a[0], a[1]);
}

/// Sine of the angle by which the polygon turns behind its edge i.
Real turn(const std::vector<Point2>& flat, std::size_t i) {
  const std::size_t j = (i + 1) % flat.size(), k = (i + 2) % flat.size();
  const Point2 in = flat[j] - flat[i], out = flat[k] - flat[j];
  return cross(in, out) / (norm(in) * norm(out));
}

std::string collinear_neighbours(const std::vector<Point2>& flat) {
  for (std::size_t i = 0; i < flat.size(); ++i)
    if (!(std::abs(turn(flat, i)) > tolerance))
      return "points " + number(i) + ", " + number((i + 1) % flat.size()) + " and " +
             number((i + 2) % flat.size()) + " are collinear; leave one out";
  return "";
}

/// The edges of a polygon in its plane.
class Edges {
 public:
  Edges(const std::vector<Point2>& points, Real near) : points_(points), near_(near) {}

  /// Two edges that are no neighbours and cross or touch.
  std::optional<std::array<std::size_t, 2>> meeting() const {
    std::vector<std::size_t> by_begin(points_.size());
    std::iota(by_begin.begin(), by_begin.end(), 0);
    std::stable_sort(by_begin.begin(), by_begin.end(),
                     [&](std::size_t i, std::size_t j) { return low(i, 0) < low(j, 0); });
    for (std::size_t a = 0; a < by_begin.size(); ++a)
      for (std::size_t b = a + 1; b < by_begin.size(); ++b) {
        const std::size_t i = std::min(by_begin[a], by_begin[b]);
        const std::size_t j = std::max(by_begin[a], by_begin[b]);
        if (low(by_begin[b], 0) > high(by_begin[a], 0) + near_) break;
        const bool neighbours = j == i + 1 || (i == 0 && j + 1 == points_.size());
        if (!neighbours && meet(i, j)) return std::array{i, j};
      }
    return {};
  }

  std::size_t end(std::size_t i) const { return (i + 1) % points_.size(); }
  bool same(std::size_t i, std::size_t j) const { return norm(points_[i] - points_[j]) <= near_; }

 private:
  Real low(std::size_t i, int d) const { return std::min(points_[i][d], points_[end(i)][d]); }
  Real high(std::size_t i, int d) const { return std::max(points_[i][d], points_[end(i)][d]); }

  Real distance(std::size_t point, std::size_t edge) const {
    const Point2 along = points_[end(edge)] - points_[edge], to = points_[point] - points_[edge];
    const Real t = std::clamp(dot(along, to) / dot(along, along), 0.0, 1.0);
    return norm(to - Point2{t * along[0], t * along[1]});
  }

  bool apart(std::size_t edge, std::size_t a, std::size_t b) const {
    const Point2 along = points_[end(edge)] - points_[edge];
    return (cross(along, points_[a] - points_[edge]) > 0) !=
           (cross(along, points_[b] - points_[edge]) > 0);
  }

  /// A sign of `apart` that rounding spoils belongs to a point near the edge's line: it is near the
  /// edge itself, or the other edge's signs agree.
  bool meet(std::size_t i, std::size_t j) const {
    if (low(i, 1) > high(j, 1) + near_ || low(j, 1) > high(i, 1) + near_) return false;
    if (distance(i, j) <= near_ || distance(end(i), j) <= near_ || distance(j, i) <= near_ ||
        distance(end(j), i) <= near_)
      return true;
    return apart(i, j, end(j)) && apart(j, i, end(i));
  }

  const std::vector<Point2>& points_;
  Real near_;
};

std::string crossing_edges(const std::vector<Point2>& flat, Real size) {
  const Edges edges(flat, tolerance * size);
  const auto pair = edges.meeting();
  if (!pair) return "";
  const auto [i, j] = *pair;
  for (const std::size_t p : {i, edges.end(i)})
    for (const std::size_t q : {j, edges.end(j)})
      if (p != q && edges.same(p, q)) return equal_points(std::min(p, q), std::max(p, q));
  const auto name = [&](std::size_t edge) {
    return "from point " + number(edge) + " to " + number(edges.end(edge));
  };
  return "the edges cross or touch: the one " + name(i) + " and the one " + name(j);
}

}  // namespace

/// About the first point so that nothing cancels far from the origin.
Vec3 doubled_area(const std::vector<Vec3>& points) {
  Vec3 area{};
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    area += cross(points[i] - points[0], points[i + 1] - points[0]);
  return area;
}

std::string polygon_problem(const std::vector<Vec3>& points) {
  if (points.size() < 3 || points.size() > most_points)
    return "has " + std::to_string(points.size()) + " points, must have 3 to " +
           std::to_string(most_points);
  const Real size = largest_distance(points);
  if (size == 0) return "all points are equal";
  if (auto problem = equal_neighbours(points, size); !problem.empty()) return problem;
  const Vec3 area = doubled_area(points);
  if (!(norm(area) > tolerance * size * size))
    return "encloses no area: its points are collinear or its edges cross";
  const Vec3 normal = normalized(area);
  if (auto problem = off_plane(points, normal, size); !problem.empty()) return problem;
  const auto flat = flattened(points, normal);
  if (auto problem = collinear_neighbours(flat); !problem.empty()) return problem;
  return crossing_edges(flat, size);
}

std::string projected_polygon_problem(const std::vector<Vec3>& points, const Vec3& normal) {
  std::vector<Vec3> flat;
  flat.reserve(points.size());
  for (const auto& p : points)
    flat.push_back((p - points[0]) - dot(normal, p - points[0]) * normal);
  const Real size = largest_distance(points);
  if (size > 0 && largest_distance(flat) <= tolerance * size)
    return "has no area: its points lie on a line along the joint's normal";
  const bool flat_area = norm(doubled_area(flat)) > tolerance * size * size;
  if (!flat_area && norm(doubled_area(points)) > tolerance * size * size)
    return "has no area on the joint's plane: it is perpendicular to it, or its edges cross there";
  return polygon_problem(flat);
}

bool is_convex(const std::vector<Vec3>& points) {
  const auto flat = flattened(points, normalized(doubled_area(points)));
  for (std::size_t i = 0; i < flat.size(); ++i)
    if (turn(flat, i) < 0) return false;  // counter-clockwise about its own normal
  return true;
}

bool leaves_plane(const std::vector<Vec3>& points, const Vec3& direction) {
  const Real length = norm(direction);
  return std::abs(dot(normalized(doubled_area(points)), direction)) > tolerance * length;
}

}  // namespace rockfold
