#include "src/io/exports/surfaces.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "src/io/triangulate.hpp"

namespace rockfold {

namespace {

using Ring = std::vector<Index>;
using Edge = std::array<Index, 2>;

std::vector<Loop> loops_of(const BlockArrays& blocks, Index f) {
  std::vector<Loop> loops;
  for (Index l = blocks.loop_begin[f]; l < blocks.loop_begin[f + 1]; ++l)
    loops.emplace_back(blocks.corner_vertex.begin() + blocks.corner_begin[l],
                       blocks.corner_vertex.begin() + blocks.corner_begin[l + 1]);
  return loops;
}

/// Ring a, which has the edge u → v, and ring b, which has v → u, as one.
Ring joined(const Ring& a, const Ring& b, Index u, Index v) {
  const auto after = [](const Ring& ring, Index corner, Ring& out) {
    const auto at = std::find(ring.begin(), ring.end(), corner) - ring.begin();
    for (std::size_t k = 0; k + 1 < ring.size(); ++k) out.push_back(ring[(at + k) % ring.size()]);
  };
  Ring out;
  after(a, v, out);  // v … before u
  after(b, u, out);  // u … before v
  return out;
}

/// The triangles of a face, joined across each inner edge where the union is convex.
std::vector<Ring> convex_polygons(const BlockArrays& blocks, Index f) {
  std::vector<Ring> rings;
  std::map<Edge, std::size_t> ring_of;  // by directed edge
  for (const auto& t : face_triangles(blocks, f)) {
    for (int k = 0; k < 3; ++k) ring_of[{t[k], t[(k + 1) % 3]}] = rings.size();
    rings.emplace_back(t.begin(), t.end());
  }
  for (const auto& [edge, unused] : std::map<Edge, std::size_t>(ring_of)) {
    const auto here = ring_of.find(edge), there = ring_of.find({edge[1], edge[0]});
    if (edge[0] > edge[1] || here == ring_of.end() || there == ring_of.end()) continue;
    const std::size_t a = here->second, b = there->second;
    if (a == b) continue;
    Ring both = joined(rings[a], rings[b], edge[0], edge[1]);
    Ring sorted = both;
    std::sort(sorted.begin(), sorted.end());
    const bool simple = std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
    if (!simple || !is_convex(both, blocks.vertex, blocks.face_normal[f])) continue;
    ring_of.erase(here);
    ring_of.erase(there);
    rings[a] = std::move(both);
    rings[b].clear();
    for (std::size_t k = 0; k < rings[a].size(); ++k)
      ring_of[{rings[a][k], rings[a][(k + 1) % rings[a].size()]}] = a;
  }
  std::erase_if(rings, [](const Ring& ring) { return ring.empty(); });
  return rings;
}

void add_polygon(SimplePolygons& out, Loop corners, Index f) {
  out.polygon_vertex.insert(out.polygon_vertex.end(), corners.begin(), corners.end());
  out.polygon_begin.push_back(static_cast<Index>(out.polygon_vertex.size()));
  out.polygon_face.push_back(f);
}

}  // namespace

std::vector<std::array<Index, 3>> face_triangles(const BlockArrays& blocks, Index f) {
  return triangulate(loops_of(blocks, f), blocks.vertex, blocks.face_normal[f]);
}

SimplePolygons simple_polygons(const BlockArrays& blocks) {
  SimplePolygons out;
  out.polygon_begin.push_back(0);
  for (Index f = 0; f < static_cast<Index>(blocks.face_area.size()); ++f) {
    const Index l = blocks.loop_begin[f];
    if (blocks.loop_begin[f + 1] == l + 1) {
      const auto first = blocks.corner_vertex.begin();
      add_polygon(out, {first + blocks.corner_begin[l], first + blocks.corner_begin[l + 1]}, f);
    } else {
      for (const Ring& ring : convex_polygons(blocks, f)) add_polygon(out, ring, f);
    }
  }
  return out;
}

}  // namespace rockfold
