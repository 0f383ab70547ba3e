#include "host/measure/sections.hpp"

#include <algorithm>
#include <cmath>

#include "host/cut/cells/complex.hpp"
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

/// The axes whose section the cell crosses, as bits.
std::uint8_t crossed_axes(const CellView& cell, const std::array<Real, 3>& at) {
  std::uint8_t above = 0, below = 0;
  for (const Vertex& v : cell.vertices)
    for (unsigned d = 0; d < 3; ++d) (v.x[d] >= at[d] ? above : below) |= 1U << d;
  return above & below;
}

/// Faces turn the same way seen from outside, so their crossings run around the section in one sense.
Real section_area(const CellView& cell, int axis, Real at) {
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

/// Returns [cells] crossed_axes.
std::vector<std::uint8_t> add_areas(const Complex& complex, const std::array<Real, 3>& at,
                                    std::array<SectionMeasure, 3>& out) {
  const Index chunks = (complex.cells.size() + chunk - 1) / chunk;
  std::vector<std::uint8_t> crossed(complex.cells.size());
  std::vector<std::array<Sum, 3>> part(chunks);
  parallel_for(chunks, 1, [&](std::int64_t k) {
    const auto begin = static_cast<Index>(k * chunk);
    for (Index c = begin; c < std::min(begin + chunk, complex.cells.size()); ++c) {
      const CellView cell = complex.cells[c];
      crossed[c] = crossed_axes(cell, at);
      for (int d = 0; d < 3; ++d)
        if ((crossed[c] >> d & 1) != 0) part[k][d] += section_area(cell, d, at[d]);
    }
  });
  for (int d = 0; d < 3; ++d) {
    Sum sum;
    for (const auto& areas : part) sum += areas[d].value();
    out[d].area = sum.value();
  }
  return crossed;
}

/// A fragment leaves a trace only where its cell is crossed.
void add_traces(const Complex& complex, const std::array<Real, 3>& at,
                const std::vector<std::uint8_t>& crossed, std::array<SectionMeasure, 3>& out) {
  std::array<std::vector<JointInstance>, 3> seen;
  std::vector<std::array<Sum, 3>> sums(complex.origins.size());
  for (const Fragment& f : complex.fragments) {
    if (f.joint == none || crossed[f.cell[0]] == 0) continue;
    const JointInstance joint = joint_instance(complex, f);
    if (joint.origin == none) continue;
    for (int d = 0; d < 3; ++d) {
      const Real length =
          (crossed[f.cell[0]] >> d & 1) != 0 ? trace_length(complex, f, d, at[d]) : 0;
      if (length == 0) continue;
      sums[joint.origin][d] += length;
      seen[d].push_back(joint);
    }
  }
  for (int d = 0; d < 3; ++d) {
    for (std::size_t o = 0; o < sums.size(); ++o) out[d].trace_length[o] = sums[o][d].value();
    keep_distinct(seen[d]);
    for (const JointInstance& joint : seen[d]) ++out[d].trace_count[joint.origin];
  }
}

}  // namespace

JointInstance joint_instance(const Complex& complex, const Fragment& f) {
  if (f.joint == none || complex.origins[f.joint].kind != FaceOrigin::Kind::joint) return {};
  if (f.instance != none) return {f.joint, f.instance};
  const Index plane = plane_of(complex.cells[f.cell[0]].faces[f.face[0]].inside);
  return {f.joint, -1 - std::int64_t{plane}};
}

void keep_distinct(std::vector<JointInstance>& joints) {
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
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
  const auto crossed = add_areas(complex, at, out);
  add_traces(complex, at, crossed, out);
  return out;
}

}  // namespace rockfold
