#include "host/keyblock/face_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

std::vector<Vec3> loop_corners(const BlockArrays& blocks, Index loop) {
  std::vector<Vec3> corners;
  for (Index c = blocks.corner_begin[at(loop)]; c < blocks.corner_begin[at(loop) + 1]; ++c)
    corners.push_back(blocks.vertex[at(blocks.corner_vertex[at(c)])]);
  return corners;
}

/// Calls f(a, b, c) for triangles whose signed sum is the face: fans of all loops from one corner.
template <class Function>
void for_each_triangle(const BlockArrays& blocks, Index face, Function f) {
  const Index begin = blocks.loop_begin[at(face)], end = blocks.loop_begin[at(face) + 1];
  if (begin == end) return;
  const Vec3 apex = blocks.vertex[at(blocks.corner_vertex[at(blocks.corner_begin[at(begin)])])];
  const auto corner = [&](Index c) -> const Vec3& {
    return blocks.vertex[at(blocks.corner_vertex[at(c)])];
  };
  for (Index loop = begin; loop < end; ++loop) {
    const Index first = blocks.corner_begin[at(loop)], last = blocks.corner_begin[at(loop) + 1] - 1;
    for (Index c = first; c < last; ++c) f(apex, corner(c), corner(c + 1));
    f(apex, corner(last), corner(first));
  }
}

/// Adds the integrals of a linear p over a triangle, with the sign of its area against `normal`.
void add_triangle(PressureForce& sum, const Vec3& normal, const std::array<Vec3, 3>& x,
                  const std::array<Real, 3>& p) {
  const Real area = 0.5 * dot(normal, cross(x[1] - x[0], x[2] - x[0]));
  const Real total = p[0] + p[1] + p[2];
  sum.force += area * total / 3;
  for (std::size_t i = 0; i < 3; ++i) sum.first_moment += (area * (total + p[i]) / 12) * x[i];
}

/// The part of the triangle where p ≥ 0, as a polygon of 0, 3 or 4 corners.
struct WetPolygon {
  std::array<Vec3, 4> x{};
  std::array<Real, 4> p{};
  std::size_t size = 0;
};
WetPolygon wet_part(const std::array<Vec3, 3>& x, const std::array<Real, 3>& p) {
  WetPolygon wet;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (p[i] >= 0) {
      wet.x[wet.size] = x[i];
      wet.p[wet.size++] = p[i];
    }
    if ((p[i] >= 0) == (p[j] >= 0)) continue;
    const Real share = p[i] / (p[i] - p[j]);
    wet.x[wet.size] = x[i] + share * (x[j] - x[i]);
    wet.p[wet.size++] = 0;
  }
  return wet;
}

/// Adds the integrals of max(0, p) over a convex polygon, with the sign of its area against `normal`.
void add_polygon(PressureForce& sum, const std::vector<Vec3>& corners, const Vec3& normal,
                 const LinearPressure& pressure) {
  const auto p = [&](std::size_t i) { return pressure.unclipped(corners[i]); };
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const WetPolygon wet =
        wet_part({corners[0], corners[k - 1], corners[k]}, {p(0), p(k - 1), p(k)});
    for (std::size_t i = 2; i < wet.size; ++i)
      add_triangle(sum, normal, {wet.x[0], wet.x[i - 1], wet.x[i]},
                   {wet.p[0], wet.p[i - 1], wet.p[i]});
  }
}

/// What of a convex polygon lies in a box.
std::vector<Vec3> part_in_box(std::vector<Vec3> corners, const BoxRegion& box, Real slack) {
  for (std::size_t d = 0; d < 3; ++d)
    for (const Real sign : {1.0, -1.0}) {
      const Real limit = sign > 0 ? box.max[d] : -box.min[d];
      std::vector<Vec3> kept;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const Real over_a = sign * a[d] - limit, over_b = sign * b[d] - limit;
        if (over_a <= slack) kept.push_back(a);
        if ((over_a > slack && over_b < -slack) || (over_a < -slack && over_b > slack))
          kept.push_back(a + over_a / (over_a - over_b) * (b - a));
      }
      corners = std::move(kept);
    }
  return corners;
}

using Point = std::array<Real, 2>;

/// Coordinates in a plane, from its first point.
struct PlaneFrame2 {
  Vec3 origin, e, f;

  PlaneFrame2(const Vec3& normal, const Vec3& point) : origin(point), e{}, f{} {
    Vec3 axis{};
    std::size_t smallest = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (std::abs(normal[d]) < std::abs(normal[smallest])) smallest = d;
    axis[smallest] = 1;
    e = normalized(cross(axis, normal));
    f = cross(normal, e);
  }
  Point flat(const Vec3& x) const { return {dot(x - origin, e), dot(x - origin, f)}; }
  Vec3 back(const Point& q) const { return origin + q[0] * e + q[1] * f; }
};

Real turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Real distance_to_segment(const Point& q, const Point& a, const Point& b) {
  const Real dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
  Real t = length > 0 ? ((q[0] - a[0]) * dx + (q[1] - a[1]) * dy) / length : 0;
  t = std::clamp(t, 0.0, 1.0);
  return std::hypot(q[0] - a[0] - t * dx, q[1] - a[1] - t * dy);
}

/// In the polygon or within `tolerance` of its boundary.
bool is_in(const std::vector<Point>& polygon, const Point& q, Real tolerance) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (distance_to_segment(q, a, b) <= tolerance) return true;
    if ((a[1] > q[1]) != (b[1] > q[1]) &&
        q[0] < a[0] + (q[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      inside = !inside;
  }
  return inside;
}

std::vector<Point> flat_points(const PlaneFrame2& frame, const std::vector<Vec3>& points) {
  std::vector<Point> flat;
  for (const Vec3& x : points) flat.push_back(frame.flat(x));
  return flat;
}

Real extent(const std::vector<Point>& points) {
  Real size = 0;
  for (const Point& q : points) size = std::max({size, std::abs(q[0]), std::abs(q[1])});
  return size;
}

}  // namespace

bool has_polygons(const BlockArrays& blocks) {
  return blocks.loop_begin.size() == blocks.face_area.size() + 1 && !blocks.vertex.empty();
}

Real LinearPressure::unclipped(const Vec3& x) const {
  return at_origin + dot(gradient, x);
}

PressureForce pressure_force(const BlockArrays& blocks, Index face,
                             const LinearPressure& pressure) {
  return pressure_force(blocks, face, pressure, nullptr, 0);
}

PressureForce pressure_force(const BlockArrays& blocks, Index face, const LinearPressure& pressure,
                             const BoxRegion* box, Real slack) {
  PressureForce sum;
  const Vec3& normal = blocks.face_normal[at(face)];
  for_each_triangle(blocks, face, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    std::vector<Vec3> part{a, b, c};
    if (box) part = part_in_box(std::move(part), *box, slack);
    add_polygon(sum, part, normal, pressure);
  });
  return sum;
}

PressureForce pressure_on_polygon(const std::vector<Vec3>& corners, const Vec3& normal,
                                  const LinearPressure& pressure) {
  PressureForce sum;
  add_polygon(sum, corners, normal, pressure);
  return sum;
}

Vec3 face_centre(const BlockArrays& blocks, Index face) {
  const PressureForce unit = pressure_force(blocks, face, {.at_origin = 1, .gradient = {}});
  return (1 / unit.force) * unit.first_moment;
}

Mat3 inertia_tensor(const BlockArrays& blocks, Index block) {
  const Vec3& centroid = blocks.centroid[at(block)];
  Mat3 second{};  // Σ of 20/v ∫ y yᵀ dV times v over tetrahedra from the centroid
  for (Index face = blocks.face_begin[at(block)]; face < blocks.face_begin[at(block) + 1]; ++face)
    for_each_triangle(blocks, face, [&](const Vec3& p, const Vec3& q, const Vec3& r) {
      const std::array<Vec3, 4> y{p - centroid, q - centroid, r - centroid,
                                  p + q + r - 3.0 * centroid};
      const Real volume = dot(y[0], cross(y[1], y[2])) / 6;
      for (const Vec3& v : y)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t k = 0; k < 3; ++k) second[i][k] += volume / 20 * v[i] * v[k];
    });
  const Real density = blocks.mass[at(block)] / blocks.volume[at(block)];
  const Real trace = second[0][0] + second[1][1] + second[2][2];
  Mat3 inertia{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      inertia[i][k] = density * ((i == k ? trace : 0) - second[i][k]);
  return inertia;
}

Real winding_number(const BlockArrays& blocks, Index block, const Vec3& point) {
  Real sum = 0;
  for (Index face = blocks.face_begin[at(block)]; face < blocks.face_begin[at(block) + 1]; ++face)
    for_each_triangle(blocks, face, [&](const Vec3& p, const Vec3& q, const Vec3& r) {
      const Vec3 a = p - point, b = q - point, c = r - point;
      const Real la = norm(a), lb = norm(b), lc = norm(c);
      const Real volume = dot(a, cross(b, c));
      // A point in the triangle's plane: the face itself fills nothing, the others do their part.
      if (std::abs(volume) <= 1e-12 * la * lb * lc) return;
      sum +=
          2 * std::atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    });
  return sum / (4 * std::numbers::pi);
}

std::vector<std::vector<Vec3>> face_loops(const BlockArrays& blocks, Index face) {
  std::vector<std::vector<Vec3>> loops;
  for (Index loop = blocks.loop_begin[at(face)]; loop < blocks.loop_begin[at(face) + 1]; ++loop)
    loops.push_back(loop_corners(blocks, loop));
  return loops;
}

std::vector<Vec3> outer_loop(const BlockArrays& blocks, Index face) {
  const Index loop = blocks.loop_begin[at(face)];
  return loop == blocks.loop_begin[at(face) + 1] ? std::vector<Vec3>{} : loop_corners(blocks, loop);
}

std::vector<Vec3> overlap_points(const BlockArrays& blocks, Index face, Index other) {
  const auto mine = outer_loop(blocks, face), theirs = outer_loop(blocks, other);
  if (mine.empty() || theirs.empty()) return {};
  const PlaneFrame2 frame(blocks.face_normal[at(face)], mine.front());
  const auto a = flat_points(frame, mine), b = flat_points(frame, theirs);
  const Real tolerance = 1e-9 * std::max(extent(a), extent(b));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (is_in(b, a[i], tolerance)) points.push_back(mine[i]);
  for (std::size_t j = 0; j < b.size(); ++j)
    if (is_in(a, b[j], tolerance)) points.push_back(theirs[j]);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Point &p = a[i], &q = a[(i + 1) % a.size()], &u = b[j], &v = b[(j + 1) % b.size()];
      const Real before = turn(u, v, p), behind = turn(u, v, q);
      if ((before > 0) == (behind > 0) || (turn(p, q, u) > 0) == (turn(p, q, v) > 0)) continue;
      const Real share = before / (before - behind);
      points.push_back(frame.back({p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])}));
    }
  return points;
}

std::vector<Vec3> hull_in_plane(const Vec3& normal, const std::vector<Vec3>& points) {
  if (points.size() < 3) return {};
  const PlaneFrame2 frame(normal, points.front());
  auto flat = flat_points(frame, points);
  std::sort(flat.begin(), flat.end());
  const Real size = extent(flat);
  // Andrew's monotone chain.
  std::vector<Point> hull;
  const auto add = [&](const Point& q, std::size_t base) {
    while (hull.size() >= base + 2 &&
           turn(hull[hull.size() - 2], hull.back(), q) <=
               1e-9 * size * std::hypot(q[0] - hull.back()[0], q[1] - hull.back()[1]))
      hull.pop_back();
    hull.push_back(q);
  };
  for (const Point& q : flat) add(q, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = flat.size(); i-- > 0;) add(flat[i], lower);
  hull.pop_back();
  if (hull.size() < 3) return {};
  std::vector<Vec3> corners;
  for (const Point& q : hull) corners.push_back(frame.back(q));
  return corners;
}

}  // namespace rockfold
