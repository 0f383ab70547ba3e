#include "tests/joints/intensity.hpp"

#include <algorithm>
#include <cmath>

#include "host/joints/area_in_box.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

namespace {

// Twice the area, along the normal.
Vec3 twice_area(const std::vector<Vec3>& polygon) {
  Vec3 sum{};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum;
}

Vec3 centre_of_area(const std::vector<Vec3>& polygon) {
  const Vec3 whole = twice_area(polygon);
  Vec3 sum{};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 u = polygon[i - 1] - polygon[0], v = polygon[i] - polygon[0];
    sum += (dot(cross(u, v), whole) / dot(whole, whole) / 3) * (u + v);
  }
  return polygon[0] + sum;
}

// A through-going joint's plane as a square that reaches beyond everything nearer than `size` to `centre`.
std::vector<Vec3> polygon_of(const FlatJoint& joint, const Vec3& centre, Real size) {
  if (!joint.polygon.empty()) return joint.polygon;
  const Real off = joint.offset - dot(joint.normal, centre);
  if (std::abs(off) > size) return {};
  const PlaneFrame frame = plane_frame(joint.normal);
  const Vec3 foot = centre + off * joint.normal;
  const Vec3 a = (2 * size) * frame.down, b = (2 * size) * frame.strike;
  return {foot + a + b, foot - a + b, foot - a - b, foot + a - b};
}

int facing_axis(const Vec3& normal) {
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[axis])) axis = d;
  return axis;
}

// Of a point on the plane; a point on the outline belongs to one of the two sides.
bool polygon_holds(const FlatJoint& joint, const Vec3& x) {
  const int i = (facing_axis(joint.normal) + 1) % 3, j = (facing_axis(joint.normal) + 2) % 3;
  bool inside = false;
  for (std::size_t k = 0; k < joint.polygon.size(); ++k) {
    const Vec3 &a = joint.polygon[k], &b = joint.polygon[(k + 1) % joint.polygon.size()];
    if ((a[j] > x[j]) == (b[j] > x[j])) continue;
    if (x[i] < a[i] + (x[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i])) inside = !inside;
  }
  return inside;
}

bool crosses(const FlatJoint& joint, const Vec3& from, const Vec3& to) {
  const Real a = dot(joint.normal, from) - joint.offset, b = dot(joint.normal, to) - joint.offset;
  if ((a > 0) == (b > 0)) return false;
  return joint.polygon.empty() || polygon_holds(joint, from + (a / (a - b)) * (to - from));
}

// One interval of a trace: positions along the line where the joint meets the rectangle's plane.
struct TraceSum {
  Real midpoints = 0, length = 0;
};

// The rectangle's plane as coordinates s, t (0 to 1 on it) and the distance off it.
struct RectangleFrame {
  Vec3 corner, s, t, normal;
  explicit RectangleFrame(const SamplingRectangle& r)
      : corner(r.corner),
        s((1 / dot(r.u, r.u)) * r.u),
        t((1 / dot(r.v, r.v)) * r.v),
        normal(normalized(cross(r.u, r.v))) {}
  Vec3 operator()(const Vec3& x) const {
    return {dot(s, x - corner), dot(t, x - corner), dot(normal, x - corner)};
  }
};

// Adds the trace from a to b, in the rectangle's coordinates (Liang and Barsky, 1984).
void add_trace(const Vec3& a, const Vec3& b, Real length, bool endless, TraceSum& sum) {
  Real from = 0, to = 1;
  bool midpoint = true;
  for (int d = 0; d < 2; ++d) {
    const Real step = b[d] - a[d];
    if (step != 0) {
      const Real at_0 = -a[d] / step, at_1 = (1 - a[d]) / step;
      from = std::max(from, std::min(at_0, at_1));
      to = std::min(to, std::max(at_0, at_1));
    } else if (a[d] < 0 || a[d] >= 1) {
      return;
    }
    const Real middle = 0.5 * (a[d] + b[d]);
    midpoint = midpoint && middle >= 0 && middle < 1;
  }
  if (from < to) sum.length += (to - from) * length;
  if (endless ? from < to : midpoint) sum.midpoints += 1;
}

void add_traces(const FlatJoint& joint, const SamplingRectangle& rectangle,
                const RectangleFrame& frame, TraceSum& sum) {
  const Real size = norm(rectangle.u) + norm(rectangle.v);
  const auto polygon =
      polygon_of(joint, rectangle.corner + 0.5 * (rectangle.u + rectangle.v), size);
  const Vec3 along = cross(joint.normal, frame.normal);
  std::vector<std::pair<Real, Vec3>> ends;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const Real from = frame(a)[2], to = frame(b)[2];
    if ((from > 0) == (to > 0)) continue;
    const Vec3 x = a + (from / (from - to)) * (b - a);
    ends.emplace_back(dot(along, x), x);
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2) {
    const Vec3 &a = ends[k].second, &b = ends[k + 1].second;
    add_trace(frame(a), frame(b), norm(b - a), joint.polygon.empty(), sum);
  }
}

bool holds(const Extent& box, const Vec3& x) {
  for (int d = 0; d < 3; ++d)
    if (!(x[d] >= box.min[d] && x[d] < box.max[d])) return false;
  return true;
}

}  // namespace

std::vector<FlatJoint> flat_joints(const PlacedJoints& placed) {
  std::vector<FlatJoint> flat;
  flat.reserve(placed.joints.size());
  for (const PlacedJoint& joint : placed.joints) {
    const ExactVec3& n = joint.plane.n;
    // Scaled by the largest component first, so that normals of any length neither overflow nor vanish.
    const Exact largest = std::max({Exact(abs(n[0])), Exact(abs(n[1])), Exact(abs(n[2]))});
    Vec3 m;
    for (int d = 0; d < 3; ++d) m[d] = CGAL::to_double(Exact(n[d] / largest));
    const Real length = norm(m);
    flat.push_back({(1 / length) * m, CGAL::to_double(Exact(joint.plane.d / largest)) / length,
                    joint.polygon});
  }
  return flat;
}

Index crossings(const std::vector<FlatJoint>& joints, const Vec3& from, const Vec3& to) {
  return static_cast<Index>(std::count_if(
      joints.begin(), joints.end(), [&](const FlatJoint& j) { return crosses(j, from, to); }));
}

Intensities measure_intensities(const std::vector<FlatJoint>& joints, const Extent& box,
                                const std::array<Vec3, 2>& line,
                                const SamplingRectangle& rectangle) {
  const Vec3 edges = box.max - box.min, middle = 0.5 * (box.min + box.max);
  const Real volume = edges[0] * edges[1] * edges[2];
  const RectangleFrame frame(rectangle);
  Real area = 0, centres = 0;
  TraceSum traces;
  for (const FlatJoint& joint : joints) {
    const Real inside = area_in_box(polygon_of(joint, middle, diagonal(box)), box);
    area += inside;
    const bool counts =
        joint.polygon.empty() ? inside > 0 : holds(box, centre_of_area(joint.polygon));
    if (counts) centres += 1;
    add_traces(joint, rectangle, frame, traces);
  }
  const Real window = norm(cross(rectangle.u, rectangle.v));
  return {crossings(joints, line[0], line[1]) / norm(line[1] - line[0]), traces.midpoints / window,
          traces.length / window, centres / volume, area / volume};
}

}  // namespace rockfold::test
