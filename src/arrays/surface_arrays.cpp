#include "src/arrays/surface_arrays.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// A side of a face's polygon.
struct Side {
  std::array<Index, 2> ends;  // vertices, ascending
  Index corner, face, part;
  bool operator<(const Side& o) const { return ends != o.ends ? ends < o.ends : corner < o.corner; }
};

/// Of the faces from face_begin[p] on for each part p.
std::vector<Side> sides_of(const SurfaceArrays& s, const std::vector<Index>& face_begin) {
  std::vector<Side> sides;
  for (Index p = 0; p + 1 < static_cast<Index>(face_begin.size()); ++p)
    for (Index f = face_begin[p]; f < face_begin[p + 1]; ++f)
      for (Index c = s.corner_begin[f]; c < s.corner_begin[f + 1]; ++c) {
        const Index next = c + 1 < s.corner_begin[f + 1] ? c + 1 : s.corner_begin[f];
        const Index a = s.corner_vertex[c], b = s.corner_vertex[next];
        sides.push_back({{std::min(a, b), std::max(a, b)}, c, f, p});
      }
  return sides;
}

/// Twice the area vector of a polygon.
Vec3 area_vector(const SurfaceArrays& s, Index f) {
  const Index begin = s.corner_begin[f];
  const Vec3 o = s.vertex[s.corner_vertex[begin]];
  Vec3 sum{};
  for (Index c = begin + 1; c + 1 < s.corner_begin[f + 1]; ++c)
    sum += cross(s.vertex[s.corner_vertex[c]] - o, s.vertex[s.corner_vertex[c + 1]] - o);
  return sum;
}

/// Whether the surface bends outward over a side between two faces: far corners of one lie below the plane of the other.
bool is_convex_over(const SurfaceArrays& s, const Side& one, const Side& two) {
  const Vec3 n = normalized(area_vector(s, one.face));
  const Vec3 o = s.vertex[one.ends[0]];
  Real lowest = 0, highest = 0;
  for (Index c = s.corner_begin[two.face]; c < s.corner_begin[two.face + 1]; ++c) {
    const Real h = dot(n, s.vertex[s.corner_vertex[c]] - o);
    lowest = std::min(lowest, h);
    highest = std::max(highest, h);
  }
  return -lowest > highest && -lowest > s.tolerance;
}

/// Where two faces meet that are no hull faces; of both parts.
void find_between_faces(SurfaceArrays& s, std::vector<PartEdge>& edges) {
  std::vector<Side> sides = sides_of(s, s.part_face_begin);
  std::sort(sides.begin(), sides.end());
  const auto add = [&](Index part, const Side& one, const Side& two) {
    if (!s.has_hull(part)) edges.push_back({part, one.ends, {one.face, two.face}});
  };
  s.corner_side.assign(s.corner_vertex.size(), none);
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    for (end = i; end < sides.size() && sides[end].ends == sides[i].ends; ++end)
      s.corner_side[sides[end].corner] = sides[i].corner;
    if (end - i != 2) continue;  // alone beside a virtual face, or where more than two faces meet
    const Side &one = sides[i], &two = sides[i + 1];
    if (!is_convex_over(s, one, two) || !is_convex_over(s, two, one)) continue;
    add(one.part, one, two);
    if (two.part != one.part) add(two.part, one, two);
  }
}

/// Where two hull faces of a part meet.
void find_on_hulls(const SurfaceArrays& s, std::vector<PartEdge>& edges) {
  std::vector<std::uint8_t> far(s.face_count(), 0);
  for (const Index f : s.part_far_face) far[f] = 1;
  std::vector<Side> sides = sides_of(s, s.part_hull_begin);
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.part, a.ends, a.corner) < std::tie(b.part, b.ends, b.corner);
  });
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &one = sides[i], &two = sides[i + 1];
    if (one.part != two.part || one.ends != two.ends) continue;
    const std::uint8_t both = far[one.face] & far[two.face];
    edges.push_back({one.part, one.ends, {one.face, two.face}, both});
  }
}

}  // namespace

void add_hull_face(const std::vector<Index>& corners, SurfaceArrays& s) {
  s.corner_vertex.insert(s.corner_vertex.end(), corners.begin(), corners.end());
  s.corner_begin.push_back(static_cast<Index>(s.corner_vertex.size()));
  s.face_joint.push_back(none);
  s.face_material.push_back(none);
}

void find_edges(SurfaceArrays& s, const std::vector<PartEdge>& more) {
  std::vector<PartEdge> edges = more;
  find_between_faces(s, edges);
  find_on_hulls(s, edges);
  std::sort(edges.begin(), edges.end());
  s.part_edge_begin.assign(s.part_count() + 1, 0);
  s.edge_vertex.clear();
  s.edge_face.clear();
  s.edge_far.clear();
  for (const PartEdge& e : edges) {
    ++s.part_edge_begin[e.part + 1];
    s.edge_vertex.insert(s.edge_vertex.end(), e.vertex.begin(), e.vertex.end());
    s.edge_face.insert(s.edge_face.end(), e.face.begin(), e.face.end());
    s.edge_far.push_back(e.far);
  }
  for (Index p = 0; p < s.part_count(); ++p) s.part_edge_begin[p + 1] += s.part_edge_begin[p];
}

}  // namespace rockfold
