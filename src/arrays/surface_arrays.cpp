#include "src/arrays/surface_arrays.hpp"

#include <algorithm>
#include <array>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// A side of a face's polygon.
struct Side {
  std::array<Index, 2> ends;  // vertices, ascending
  Index corner, face, part;
  bool operator<(const Side& o) const { return ends != o.ends ? ends < o.ends : corner < o.corner; }
};

std::vector<Side> sides_of(const SurfaceArrays& s) {
  std::vector<Side> sides;
  for (Index p = 0; p < s.part_count(); ++p)
    for (Index f = s.part_face_begin[p]; f < s.part_face_begin[p + 1]; ++f)
      for (Index c = s.corner_begin[f]; c < s.corner_begin[f + 1]; ++c) {
        const Index next = c + 1 < s.corner_begin[f + 1] ? c + 1 : s.corner_begin[f];
        const Index a = s.corner_vertex[c], b = s.corner_vertex[next];
        sides.push_back({{std::min(a, b), std::max(a, b)}, c, f, p});
      }
  std::sort(sides.begin(), sides.end());
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

}  // namespace

void find_edges(SurfaceArrays& s) {
  const std::vector<Side> sides = sides_of(s);
  std::vector<std::array<Index, 5>> edges;  // part, ends, faces
  s.corner_side.resize(s.corner_vertex.size());
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    for (end = i; end < sides.size() && sides[end].ends == sides[i].ends; ++end)
      s.corner_side[sides[end].corner] = sides[i].corner;
    if (end - i != 2) continue;  // alone beside a virtual face, or where more than two faces meet
    const Side &one = sides[i], &two = sides[i + 1];
    if (!is_convex_over(s, one, two) || !is_convex_over(s, two, one)) continue;
    edges.push_back({one.part, one.ends[0], one.ends[1], one.face, two.face});
    if (two.part != one.part)
      edges.push_back({two.part, one.ends[0], one.ends[1], one.face, two.face});
  }
  std::sort(edges.begin(), edges.end());
  s.part_edge_begin.assign(s.part_count() + 1, 0);
  s.edge_vertex.clear();
  s.edge_face.clear();
  for (const auto& e : edges) {
    ++s.part_edge_begin[e[0] + 1];
    s.edge_vertex.insert(s.edge_vertex.end(), {e[1], e[2]});
    s.edge_face.insert(s.edge_face.end(), {e[3], e[4]});
  }
  for (Index p = 0; p < s.part_count(); ++p) s.part_edge_begin[p + 1] += s.part_edge_begin[p];
}

}  // namespace rockfold
