#include "src/io/exports/surfaces.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace rockfold {

namespace {

using Ring = std::vector<Index>;
using Edge = std::array<Index, 2>;

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

/// Polygons of face f, joined across each inner edge where the union is convex.
std::vector<Ring> joined_where_convex(std::vector<Ring> rings, const BlockArrays& blocks, Index f) {
  std::map<Edge, std::size_t> ring_of;  // by directed edge
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t k = 0; k < rings[r].size(); ++k)
      ring_of[{rings[r][k], rings[r][(k + 1) % rings[r].size()]}] = r;
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

}  // namespace

PolygonMesh simple_polygons(const BlockArrays& blocks, const PolygonMesh& faces) {
  PolygonMesh out;
  Index p = 0;
  for (Index f = 0; f < static_cast<Index>(blocks.face_area.size()); ++f) {
    const bool simple = blocks.loop_begin[f + 1] - blocks.loop_begin[f] == 1;
    std::vector<Ring> rings;
    for (; p < faces.size() && faces.polygon_face[p] == f; ++p)
      if (!simple) rings.emplace_back(faces.polygon(p).begin(), faces.polygon(p).end());
    if (simple) out.add(face_loop(blocks, blocks.loop_begin[f]), f);
    for (const Ring& ring : joined_where_convex(std::move(rings), blocks, f)) out.add(ring, f);
  }
  return out;
}

}  // namespace rockfold
