#include "host/measure/sections.hpp"

#include <algorithm>
#include <cmath>

#include "host/cut/complex.hpp"
#include "host/parallel.hpp"
#include "src/base/sum.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real aside = 0.618e-6;  // of the model's size
constexpr Index chunk = 4096;     // cells

/// Where the edge from a to b meets the plane x[axis] = at.
Vec3 meeting(const Vec3& a, const Vec3& b, int axis, Real at) {
  Vec3 x = a + ((at - a[axis]) / (b[axis] - a[axis])) * (b - a);
  x[axis] = at;
  return x;
}

/// The one or two points where a convex loop crosses the plane: [0] going up, [1] going down. Whether it does.
template <class At>
bool crossing_points(std::size_t n, At at_corner, int axis, Real at, Vec3 point[2]) {
  bool found = false;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = at_corner(i), &b = at_corner(i + 1 < n ? i + 1 : 0);
    if ((a[axis] >= at) == (b[axis] >= at)) continue;
    point[a[axis] >= at ? 1 : 0] = meeting(a, b, axis, at);
    found = true;
  }
  return found;
}

bool crosses(const CellView& cell, int axis, Real at) {
  const bool first = cell.vertices[0].x[axis] >= at;
  return std::any_of(cell.vertices.begin(), cell.vertices.end(),
                     [&](const Vertex& v) { return (v.x[axis] >= at) != first; });
}

/// Faces turn the same way seen from outside, so their crossings run around the section in one sense.
Real section_area(const CellView& cell, int axis, Real at) {
  if (!crosses(cell, axis, at)) return 0;
  Vec3 local{};
  bool first = true;
  Real twice = 0;
  for (const auto& face : cell.faces) {
    const auto corner = [&](std::size_t i) -> const Vec3& {
      return cell.vertices[cell.corners[face.begin + i].vertex].x;
    };
    Vec3 p[2];
    if (!crossing_points(static_cast<std::size_t>(face.count), corner, axis, at, p)) continue;
    if (first) local = p[0];
    first = false;
    twice += cross(p[0] - local, p[1] - local)[axis];
  }
  return std::abs(twice) / 2;
}

Real trace_length(const Complex& complex, const Fragment& f, int axis, Real at) {
  Vec3 p[2];
  if (f.polygon != none) {
    const Polygon& polygon = complex.polygons[f.polygon];
    const auto corner = [&](std::size_t i) -> const Vec3& { return polygon.corner[i].x; };
    return crossing_points(polygon.corner.size(), corner, axis, at, p) ? norm(p[1] - p[0]) : 0;
  }
  const CellView cell = complex.cells[f.cell[0]];
  const auto& face = cell.faces[f.face[0]];
  const auto corner = [&](std::size_t i) -> const Vec3& {
    return cell.vertices[cell.corners[face.begin + i].vertex].x;
  };
  return crossing_points(static_cast<std::size_t>(face.count), corner, axis, at, p)
             ? norm(p[1] - p[0])
             : 0;
}

void add_areas(const Complex& complex, const std::array<Real, 3>& at,
               std::array<SectionMeasure, 3>& out) {
  const Index chunks = (complex.cells.size() + chunk - 1) / chunk;
  std::vector<std::array<Real, 3>> part(chunks, std::array<Real, 3>{});
  parallel_for(chunks, 1, [&](std::int64_t k) {
    const auto begin = static_cast<Index>(k * chunk);
    for (Index c = begin; c < std::min(begin + chunk, complex.cells.size()); ++c)
      for (int d = 0; d < 3; ++d) part[k][d] += section_area(complex.cells[c], d, at[d]);
  });
  for (int d = 0; d < 3; ++d) {
    Sum sum;
    for (const auto& areas : part) sum += areas[d];
    out[d].area = sum.value();
  }
}

void add_traces(const Complex& complex, const std::array<Real, 3>& at,
                std::array<SectionMeasure, 3>& out) {
  const auto instance = joint_instances(complex);
  std::array<std::vector<JointInstance>, 3> seen;
  for (std::size_t i = 0; i < complex.fragments.size(); ++i) {
    if (instance[i].origin == none) continue;
    for (int d = 0; d < 3; ++d) {
      const Real length = trace_length(complex, complex.fragments[i], d, at[d]);
      if (length == 0) continue;
      out[d].trace_length[instance[i].origin] += length;
      if (seen[d].empty() || seen[d].back() != instance[i]) seen[d].push_back(instance[i]);
    }
  }
  for (int d = 0; d < 3; ++d) {
    std::sort(seen[d].begin(), seen[d].end());
    seen[d].erase(std::unique(seen[d].begin(), seen[d].end()), seen[d].end());
    for (const JointInstance& joint : seen[d]) ++out[d].trace_count[joint.origin];
  }
}

}  // namespace

std::vector<JointInstance> joint_instances(const Complex& complex) {
  std::vector<JointInstance> of(complex.fragments.size());
  for (std::size_t i = 0; i < of.size(); ++i) {
    const Fragment& f = complex.fragments[i];
    if (f.joint == none || complex.origins[f.joint].kind != FaceOrigin::Kind::joint) continue;
    const Index plane = plane_of(complex.cells[f.cell[0]].faces[f.face[0]].inside);
    of[i] = {f.joint, f.instance != none ? std::int64_t{f.instance} : -1 - std::int64_t{plane}};
  }
  return of;
}

std::array<SectionMeasure, 3> measure_sections(const Complex& complex, const Vec3& centre) {
  std::array<SectionMeasure, 3> out;
  std::array<Real, 3> at{};
  for (int d = 0; d < 3; ++d) {
    at[d] = centre[d] - complex.planes.centre()[d] + aside * complex.planes.model_size();
    out[d].axis = d;
    out[d].position = centre[d];
    out[d].trace_length.assign(complex.origins.size(), 0);
    out[d].trace_count.assign(complex.origins.size(), 0);
  }
  add_areas(complex, at, out);
  add_traces(complex, at, out);
  return out;
}

}  // namespace rockfold
