#include "host/keyblock/theory/tunnel_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

Real turn(const Point2& a, const Point2& b) {
  return a[0] * b[1] - a[1] * b[0];
}
Point2 minus(const Point2& a, const Point2& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
Real length(const Point2& a) {
  return std::hypot(a[0], a[1]);
}

bool holds(std::span<const Vec3> normals, const Vec3& u) {
  return std::all_of(normals.begin(), normals.end(),
                     [&](const Vec3& n) { return dot(n, u) <= direction_tolerance; });
}

/// Where the ray from `p` along `d` first meets an edge of the section: how far, and which.
struct Hit {
  Real way = std::numeric_limits<Real>::infinity();
  std::size_t edge = 0;
};
Hit first_hit(const std::vector<Point2>& section, const Point2& p, const Point2& d) {
  Hit first;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Point2 a = minus(section[i], p), b = minus(section[(i + 1) % section.size()], p);
    const Real ta = turn(d, a), tb = turn(d, b);
    if ((ta > 0) == (tb > 0)) continue;
    const Real share = ta / (ta - tb);
    const Point2 x{a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
    const Real way = (x[0] * d[0] + x[1] * d[1]) / (d[0] * d[0] + d[1] * d[1]);
    if (way > 0 && way < first.way) first = {way, i};
  }
  return first;
}

bool is_inside(const std::vector<Point2>& convex, const Point2& p) {
  for (std::size_t i = 0; i < convex.size(); ++i)
    if (turn(minus(convex[(i + 1) % convex.size()], convex[i]), minus(p, convex[i])) < 0)
      return false;
  return true;
}

}  // namespace

Point2 TunnelFrame::flat(const Vec3& x) const {
  return {dot(x, right), dot(x, up)};
}

Vec3 TunnelFrame::lifted(const Point2& q) const {
  return q[0] * right + q[1] * up;
}

TunnelFrame tunnel_frame(Real trend, Real plunge, std::vector<Point2> section) {
  constexpr Real degree = std::numbers::pi / 180;
  const Real t = trend * degree, p = plunge * degree;
  TunnelFrame frame;
  frame.axis = {std::cos(p) * std::sin(t), std::cos(p) * std::cos(t), -std::sin(p)};
  frame.right = {std::cos(t), -std::sin(t), 0};
  frame.up = cross(frame.right, frame.axis);
  frame.section = std::move(section);
  return frame;
}

bool is_convex(const std::vector<Point2>& section) {
  Real size = 0;
  for (const Point2& q : section) size = std::max(size, length(minus(q, section.front())));
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Point2 &a = section[i], &b = section[(i + 1) % section.size()],
                 &c = section[(i + 2) % section.size()];
    if (turn(minus(b, a), minus(c, b)) < -1e-9 * size * size) return false;
  }
  return true;
}

std::optional<TunnelPyramid> TunnelPyramid::make(const TunnelFrame& frame,
                                                 std::span<const Vec3> normals) {
  if (holds(normals, frame.axis) || holds(normals, -frame.axis)) return {};
  const RemovableSpace space = removable_space(normals);
  if (space.edges.size() < 3) return {};
  TunnelPyramid pyramid(frame, normals);
  if (!pyramid.find_sides(space.edges)) return {};
  const auto& section = frame.section;
  pyramid.limits_ = {std::numeric_limits<Real>::infinity(), -std::numeric_limits<Real>::infinity()};
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Real first = turn(pyramid.sides_[0], section[i]),
               last = turn(pyramid.sides_[1], section[i]);
    if (first < pyramid.limits_[0]) {
      pyramid.limits_[0] = first;
      pyramid.touch_[0] = i;
    }
    if (last > pyramid.limits_[1]) {
      pyramid.limits_[1] = last;
      pyramid.touch_[1] = i;
    }
  }
  // sides[0] × p = limits[0], sides[1] × p = limits[1].
  const auto& [s, t] = pyramid.sides_;
  const Real opening = turn(s, t);
  for (std::size_t d = 0; d < 2; ++d)
    pyramid.apex_[d] = (pyramid.limits_[0] * t[d] - pyramid.limits_[1] * s[d]) / opening;
  return pyramid;
}

/// False where the edges seen along the axis fill no proper angle.
bool TunnelPyramid::find_sides(std::span<const Vec3> edges) {
  std::vector<Point2> seen;
  for (const Vec3& e : edges) {
    const Point2 q = frame_->flat(e);
    const Real size = length(q);
    if (size <= direction_tolerance) return false;
    seen.push_back({q[0] / size, q[1] / size});
  }
  // The first side has all others on its left.
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (std::all_of(seen.begin(), seen.end(),
                    [&](const Point2& q) { return turn(seen[i], q) >= -direction_tolerance; })) {
      sides_[0] = seen[i];
      break;
    }
  sides_[1] = *std::max_element(seen.begin(), seen.end(), [&](const Point2& a, const Point2& b) {
    const auto angle = [&](const Point2& q) {
      return std::atan2(turn(sides_[0], q), sides_[0][0] * q[0] + sides_[0][1] * q[1]);
    };
    return angle(a) < angle(b);
  });
  if (turn(sides_[0], sides_[1]) <= direction_tolerance) return false;
  for (const Point2& q : seen)
    if (turn(sides_[0], q) > direction_tolerance && turn(q, sides_[1]) > direction_tolerance)
      inner_.push_back(q);
  std::sort(inner_.begin(), inner_.end(),
            [](const Point2& a, const Point2& b) { return turn(a, b) > 0; });
  return true;
}

/// The part of the line along the axis over q (from the apex) that lies in the pyramid.
TunnelPyramid::Fibre TunnelPyramid::fibre(const Point2& q) const {
  const Vec3 x = frame_->lifted(q);
  Fibre fibre{0, 0, 0};
  Real high = std::numeric_limits<Real>::infinity(), low = -high;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    const Real rate = dot(normals_[i], frame_->axis);
    if (std::abs(rate) <= direction_tolerance) continue;
    const Real end = -dot(normals_[i], x) / rate;
    if (rate > 0 && end < high) high = end, fibre.high = i;
    if (rate < 0 && end > low) low = end, fibre.low = i;
  }
  fibre.length = std::max(0.0, high - low);
  return fibre;
}

/// Apex, u, v with u and v on the section, counter-clockwise; no edge of the pyramid between.
void TunnelPyramid::add_triangle(TheoryShape& shape, const Point2& u, const Point2& v) const {
  const Real area = turn(u, v) / 2;
  const Fibre middle = fibre({(u[0] + v[0]) / 2, (u[1] + v[1]) / 2});
  const Real sum = fibre(u).length + fibre(v).length;
  shape.volume += area * sum / 3;
  shape.free_area += length(minus(v, u)) * sum / 2;
  for (const std::size_t face : {middle.high, middle.low})
    shape.joint_area[face] += area / std::abs(dot(normals_[face], frame_->axis));
}

/// `chain`: the section from the first side to the last, as the apex sees it.
TheoryShape TunnelPyramid::measure(const Point2& apex, const std::vector<Point2>& chain) const {
  TheoryShape shape;
  shape.joint_area.assign(normals_.size(), 0);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    Point2 u = minus(chain[i], apex);
    const Point2 end = minus(chain[i + 1], apex);
    const bool forward = turn(u, end) > 0;  // an inward corner of the section may turn back
    for (std::size_t k = 0; k < inner_.size(); ++k) {
      const Point2& ray = inner_[forward ? k : inner_.size() - 1 - k];
      const Real before = turn(ray, u), behind = turn(ray, end);
      if ((before > 0) == (behind > 0) || before == 0) continue;
      const Real share = before / (before - behind);
      const Point2 cut{u[0] + share * (end[0] - u[0]), u[1] + share * (end[1] - u[1])};
      add_triangle(shape, u, cut);
      u = cut;
    }
    add_triangle(shape, u, end);
  }
  // Faces along the axis are seen as the angle's sides.
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    if (std::abs(dot(normals_[i], frame_->axis)) > direction_tolerance) continue;
    const Point2 first = minus(chain.front(), apex), last = minus(chain.back(), apex);
    const auto off = [&](const Point2& q) {
      return std::abs(dot(normals_[i], frame_->lifted(q))) / length(q);
    };
    const Point2& along = off(first) < off(last) ? first : last;
    shape.joint_area[i] = length(along) * fibre(along).length / 2;
  }
  return shape;
}

TheoryShape TunnelPyramid::maximum_block() const {
  const auto& section = frame_->section;
  std::vector<Point2> chain;  // the section is counter-clockwise: backwards from first to last side
  for (std::size_t i = touch_[0];; i = (i + section.size() - 1) % section.size()) {
    chain.push_back(section[i]);
    if (i == touch_[1]) break;
  }
  return measure(apex_, chain);
}

std::optional<TheoryShape> TunnelPyramid::block_at(const Point2& apex) const {
  const auto& section = frame_->section;
  if (turn(sides_[0], apex) < limits_[0] || turn(sides_[1], apex) > limits_[1]) return {};
  if (is_inside(section, apex)) return {};
  const Hit first = first_hit(section, apex, sides_[0]), last = first_hit(section, apex, sides_[1]);
  if (std::isinf(first.way) || std::isinf(last.way)) return {};
  const auto point = [&](std::size_t side, const Hit& hit) -> Point2 {
    return {apex[0] + hit.way * sides_[side][0], apex[1] + hit.way * sides_[side][1]};
  };
  std::vector<Point2> chain{point(0, first)};
  for (std::size_t i = first.edge; i != last.edge; i = (i + section.size() - 1) % section.size())
    chain.push_back(section[i]);
  chain.push_back(point(1, last));
  TheoryShape shape = measure(apex, chain);
  if (!(shape.volume > 0)) return {};
  return shape;
}

}  // namespace rockfold
