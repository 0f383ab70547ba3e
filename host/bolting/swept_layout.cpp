#include "host/bolting/swept_layout.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "host/shapes/section_frame.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using Point = std::array<Real, 2>;

void add_segment(SweptLayout& layout, const Vec3& start, const Vec3& end) {
  const Vec3 leg = end - start;
  if (norm(leg) == 0) return;
  const SectionFrame frame = section_frame(leg);
  const Real v0 =
      layout.segments.empty() ? 0 : layout.segments.back().v0 + layout.segments.back().length;
  const Vec3 along = normalized(leg);
  SweptSegment segment{start, along, frame.right, frame.up, v0, norm(leg), along, along};
  if (!layout.segments.empty()) {
    segment.start_plane = normalized(layout.segments.back().along + along);
    layout.segments.back().end_plane = segment.start_plane;
  }
  layout.segments.push_back(segment);
}

Real signed_area(const std::vector<Point>& section) {
  Real area = 0;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const auto &a = section[i], &b = section[(i + 1) % section.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

Real edge_length(const std::vector<Point>& section, std::size_t i) {
  const auto &a = section[i], &b = section[(i + 1) % section.size()];
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

/// How far the crown lies along the edges from corner 0, in their own order: the middle of the highest edge, or the
/// highest corner.
Real crown_at(const std::vector<Point>& section) {
  Real top = section[0][1], low = top;
  for (const auto& p : section) top = std::max(top, p[1]), low = std::min(low, p[1]);
  const Real level = 1e-9 * (top - low);
  Real at = 0, corner = 0;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Real length = edge_length(section, i);
    const bool here = section[i][1] >= top - level;
    if (here && section[(i + 1) % section.size()][1] >= top - level) return at + length / 2;
    if (here) corner = at;
    at += length;
  }
  return corner;
}

/// The edges' places on the sheet: clockwise from the crown.
void lay_edges(SweptLayout& layout) {
  const auto& section = layout.section;
  for (std::size_t i = 0; i < section.size(); ++i) layout.perimeter += edge_length(section, i);
  const Real half = layout.perimeter / 2, crown = crown_at(section);
  layout.counter_clockwise = signed_area(section) > 0;
  const Real sense = layout.counter_clockwise ? -1 : 1;
  Real at = 0;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const Real length = edge_length(section, i);
    Real middle = sense * (at + length / 2 - crown);
    while (middle > half) middle -= layout.perimeter;
    while (middle < -half) middle += layout.perimeter;
    layout.edge_u.push_back({middle - length / 2, middle + length / 2});
    at += length;
  }
}

struct Lay {
  SweptLayout operator()(const TunnelShape& tunnel) const {
    SweptLayout layout;
    layout.section = tunnel.section;
    for (std::size_t i = 1; i < tunnel.path.size(); ++i)
      add_segment(layout, tunnel.path[i - 1], tunnel.path[i]);
    return layout;
  }
  SweptLayout operator()(const CylinderShape& cylinder) const {
    SweptLayout layout;
    for (Index i = 0; i < cylinder.sides; ++i) {
      const Real angle = 2 * std::numbers::pi * i / cylinder.sides;
      layout.section.push_back(
          {cylinder.radius * std::cos(angle), cylinder.radius * std::sin(angle)});
    }
    add_segment(layout, cylinder.axis[0], cylinder.axis[1]);
    return layout;
  }
  SweptLayout operator()(const PrismShape& prism) const {
    SweptLayout layout;
    add_segment(layout, prism.base[0], prism.base[0] + prism.extrude);
    const SweptSegment& segment = layout.segments.front();
    for (const Vec3& p : prism.base) {
      const Vec3 offset = p - prism.base[0];
      layout.section.push_back({dot(offset, segment.right), dot(offset, segment.up)});
    }
    return layout;
  }
  template <class Other>
  SweptLayout operator()(const Other&) const {
    return {};
  }
};

}  // namespace

SweptLayout swept_layout(const Shape& shape) {
  SweptLayout layout = std::visit(Lay{}, shape);
  if (!layout.segments.empty()) lay_edges(layout);
  return layout;
}

}  // namespace rockfold
