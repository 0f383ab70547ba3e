#include "host/flatten/block_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>

#include "host/cut/union_find.hpp"
#include "host/flatten/vertex_merge.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// One directed edge of an area, split at the vertices that lie on it.
struct DirectedEdge {
  Index from, to;  // vertices
  Index area;
  Index group;  // plane, side and origin
  Index face = none;
  bool operator<(const DirectedEdge& o) const {
    return std::tie(group, from, to, area) < std::tie(o.group, o.from, o.to, o.area);
  }
};

// Where the surface of a block does not close.
struct NotClosed : std::logic_error {
  NotClosed(const char* what, const Vertex& at) : std::logic_error(what), x(at.x) {}
  Vec3 x;  // m, relative to the centre
};

class SurfaceMerger {
 public:
  SurfaceMerger(const Complex& complex, const std::vector<BoundaryArea>& areas)
      : complex_(complex), areas_(areas), area_parts_(static_cast<Index>(areas.size())) {}

  BlockSurface run() {
    number_groups();
    collect_edges();
    cancel_inner_edges();
    number_faces();
    chain_loops();
    pair_edges();
    count_and_simplify();
    return std::move(surface_);
  }

 private:
  struct Loop {
    std::vector<Index> vertex;  // corner k is vertex[k]; edge k runs to corner k + 1
    Index face;
  };
  struct EdgeUse {
    Index loop, corner;
  };

  HalfSpaceId inside(const BoundaryArea& a) const {
    return complex_.cells[a.cell].faces[a.face].inside;
  }

  Vec3 outward(Index face) const {
    const HalfSpaceId h = surface_.faces[face].inside;
    const Vec3& n = complex_.planes.normal(plane_of(h));
    return is_above(h) ? -n : n;
  }

  // The polygon of an area, counter-clockwise seen from outside.
  Polygon polygon(const BoundaryArea& a) const {
    Polygon p = a.fragment != none ? complex_.polygon_of(complex_.fragments[a.fragment])
                                   : complex_.polygon_of(complex_.free_parts[a.free_part]);
    if (!is_above(inside(a))) return p;
    std::reverse(p.corner.begin(), p.corner.end());
    // Edge i of the reversed loop runs from old corner n−1−i to old corner n−2−i: the old edge n−2−i.
    std::reverse(p.edge.begin(), p.edge.end());
    std::rotate(p.edge.begin(), p.edge.begin() + 1, p.edge.end());
    return p;
  }

  void number_groups() {
    std::map<std::pair<HalfSpaceId, Index>, Index> number;
    for (const BoundaryArea& a : areas_) number.try_emplace({inside(a), a.origin}, 0);
    Index n = 0;
    for (auto& [key, id] : number) id = n++;
    for (const BoundaryArea& a : areas_) group_.push_back(number[{inside(a), a.origin}]);
  }

  void collect_edges() {
    struct Side {
      Index from, to;
      Index plane, across;
      Index area;
    };
    std::vector<Side> sides;
    VertexMerger merger(complex_.planes);
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      const Polygon p = polygon(areas_[i]);
      std::vector<Index> id;
      for (const Vertex& v : p.corner) id.push_back(merger.add(v));
      for (std::size_t k = 0; k < id.size(); ++k)
        sides.push_back(
            {id[k], id[(k + 1) % id.size()], p.plane, plane_of(p.edge[k]), static_cast<Index>(i)});
    }
    vertices_ = merger.take();
    const VertexFinder finder(complex_.planes, vertices_);
    for (const Side& s : sides) {
      Index from = s.from;
      for (const Index on : finder.between(s.from, s.to, s.plane, s.across)) {
        edges_.push_back({from, on, s.area, group_[s.area]});
        from = on;
      }
      edges_.push_back({from, s.to, s.area, group_[s.area]});
    }
    std::erase_if(edges_, [](const DirectedEdge& e) { return e.from == e.to; });
  }

  // Edges between two areas of one group vanish and join the areas.
  void cancel_inner_edges() {
    std::sort(edges_.begin(), edges_.end());
    std::vector<DirectedEdge> outer;
    for (const DirectedEdge& e : edges_) {
      const auto twin =
          std::lower_bound(edges_.begin(), edges_.end(), DirectedEdge{e.to, e.from, none, e.group});
      if (twin != edges_.end() && twin->group == e.group && twin->from == e.to &&
          twin->to == e.from)
        area_parts_.join(e.area, twin->area);
      else
        outer.push_back(e);
    }
    edges_ = std::move(outer);
  }

  void number_faces() {
    std::map<std::pair<Index, Index>, Index> number;  // group, smallest area → face
    for (Index i = 0; i < static_cast<Index>(areas_.size()); ++i)
      number.try_emplace({group_[i], area_parts_.find(i)}, 0);
    Index n = 0;
    for (auto& [key, id] : number) id = n++;
    surface_.faces.resize(n);
    for (Index i = 0; i < static_cast<Index>(areas_.size()); ++i) {
      const Index f = number[{group_[i], area_parts_.find(i)}];
      const BoundaryArea& a = areas_[i];
      surface_.face_of_area.push_back(f);
      surface_.faces[f].inside = inside(a);
      surface_.faces[f].origin = a.origin;
      surface_.faces[f].area += a.fragment != none ? complex_.fragments[a.fragment].area
                                                   : complex_.free_parts[a.free_part].area;
    }
    for (DirectedEdge& e : edges_) e.face = surface_.face_of_area[e.area];
    std::sort(edges_.begin(), edges_.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
      return std::tie(a.face, a.from, a.to) < std::tie(b.face, b.from, b.to);
    });
  }

  // Follows the edges of each face; where several leave a vertex, the one that bounds the same corner of the face: the
  // first clockwise from the edge that came in.
  void chain_loops() {
    std::vector<bool> used(edges_.size(), false);
    for (std::size_t start = 0; start < edges_.size(); ++start) {
      if (used[start]) continue;
      Loop loop{{}, edges_[start].face};
      std::size_t e = start;
      do {
        used[e] = true;
        loop.vertex.push_back(edges_[e].from);
        e = next_edge(e);
      } while (e != start && !used[e]);
      if (e != start) throw NotClosed("the edges of a face do not close", vertices_[edges_[e].to]);
      loops_.push_back(std::move(loop));
    }
    // The outer loop first: the one of largest area.
    std::stable_sort(loops_.begin(), loops_.end(), [&](const Loop& a, const Loop& b) {
      return a.face != b.face ? a.face < b.face : loop_area(a) > loop_area(b);
    });
  }

  std::size_t next_edge(std::size_t e) const {
    const Index face = edges_[e].face, at = edges_[e].to;
    auto it = std::lower_bound(edges_.begin(), edges_.end(), std::pair{face, at},
                               [](const DirectedEdge& d, const std::pair<Index, Index>& key) {
                                 return std::pair{d.face, d.from} < key;
                               });
    if (it == edges_.end() || it->face != face || it->from != at)
      throw NotClosed("the edges of a face end", vertices_[at]);
    auto best = it;
    Real best_angle = 7;
    for (; it != edges_.end() && it->face == face && it->from == at; ++it) {
      const Real angle = clockwise_angle(edges_[e].from, at, it->to, outward(face));
      if (angle < best_angle) best_angle = angle, best = it;
    }
    return static_cast<std::size_t>(best - edges_.begin());
  }

  // From the direction at→from turning clockwise (seen against n) to at→to, in (0, 2π].
  Real clockwise_angle(Index from, Index at, Index to, const Vec3& n) const {
    const Vec3 a = vertices_[from].x - vertices_[at].x, b = vertices_[to].x - vertices_[at].x;
    const Real angle = std::atan2(dot(n, cross(b, a)), dot(a, b));
    return angle > 1e-12 ? angle : angle + 6.283185307179586;
  }

  Real loop_area(const Loop& loop) const {
    const Vec3 n = outward(loop.face);
    const Vec3 o = vertices_[loop.vertex.front()].x;
    Real area = 0;
    for (std::size_t k = 1; k + 1 < loop.vertex.size(); ++k)
      area += dot(n, cross(vertices_[loop.vertex[k]].x - o, vertices_[loop.vertex[k + 1]].x - o));
    return area / 2;
  }

  // Pairs the two uses of each edge. Where four or more faces meet along an edge, those that enclose rock belong together.
  void pair_edges() {
    struct Use {
      std::pair<Index, Index> ends;
      EdgeUse use;
    };
    std::vector<Use> uses;
    uses.reserve(edges_.size());
    for (std::size_t l = 0; l < loops_.size(); ++l)
      for (std::size_t k = 0; k < loops_[l].vertex.size(); ++k) {
        const Index a = loops_[l].vertex[k],
                    b = loops_[l].vertex[(k + 1) % loops_[l].vertex.size()];
        uses.push_back({std::minmax(a, b), {static_cast<Index>(l), static_cast<Index>(k)}});
      }
    std::stable_sort(uses.begin(), uses.end(),
                     [](const Use& x, const Use& y) { return x.ends < y.ends; });
    std::vector<EdgeUse> list;
    for (auto begin = uses.begin(); begin != uses.end();) {
      const auto ends = begin->ends;
      list.clear();
      for (; begin != uses.end() && begin->ends == ends; ++begin) list.push_back(begin->use);
      if (list.size() % 2 != 0)
        throw NotClosed("an edge has an odd number of faces", vertices_[ends.first]);
      if (list.size() > 2) sort_around(ends.first, ends.second, list);
      for (std::size_t i = 0; i < list.size(); i += 2) pairs_.emplace_back(list[i], list[i + 1]);
    }
  }

  // Orders the uses by angle about the edge so that 0–1, 2–3, … enclose rock.
  void sort_around(Index a, Index b, std::vector<EdgeUse>& list) const {
    const Vec3 axis = normalized(vertices_[b].x - vertices_[a].x);
    struct Placed {
      Real angle;
      bool rock_follows;  // turning counter-clockwise about the axis enters rock
      EdgeUse use;
    };
    std::vector<Placed> placed;
    Vec3 zero{};
    for (const EdgeUse& u : list) {
      const Vec3 n = outward(loops_[u.loop].face);
      const bool along = loops_[u.loop].vertex[u.corner] == a;
      const Vec3 into_face = cross(n, along ? axis : -axis);
      if (placed.empty()) zero = into_face;
      const Real angle = std::atan2(dot(axis, cross(zero, into_face)), dot(zero, into_face));
      placed.push_back({angle < -1e-12 ? angle + 6.283185307179586 : angle,
                        dot(cross(axis, into_face), n) < 0, u});
    }
    std::sort(placed.begin(), placed.end(), [](const Placed& x, const Placed& y) {
      return x.angle != y.angle ? x.angle < y.angle : x.rock_follows < y.rock_follows;
    });
    if (!placed.front().rock_follows) std::rotate(placed.begin(), placed.begin() + 1, placed.end());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = placed[i].use;
  }

  struct CornerNumbers {
    std::vector<Index> begin;  // first corner of each loop
    Index of(Index loop, Index corner, Index size) const { return begin[loop] + corner % size; }
  };

  void count_and_simplify() {
    CornerNumbers number;
    Index corners = 0;
    for (const Loop& l : loops_) {
      number.begin.push_back(corners);
      corners += static_cast<Index>(l.vertex.size());
    }
    // Corners of different faces that an edge joins at either end are one vertex of the surface.
    UnionFind vertex_parts(corners), shells(static_cast<Index>(surface_.faces.size()));
    for (const auto& [one, two] : pairs_) {
      const Loop &l1 = loops_[one.loop], &l2 = loops_[two.loop];
      const auto n1 = static_cast<Index>(l1.vertex.size()),
                 n2 = static_cast<Index>(l2.vertex.size());
      const Index a1 = number.of(one.loop, one.corner, n1),
                  b1 = number.of(one.loop, one.corner + 1, n1);
      const Index a2 = number.of(two.loop, two.corner, n2),
                  b2 = number.of(two.loop, two.corner + 1, n2);
      vertex_parts.join(a1, b2);
      vertex_parts.join(b1, a2);
      shells.join(l1.face, l2.face);
      surface_.convex = surface_.convex && is_convex(one, two);
    }
    const std::vector<Index> vertex_of = vertex_parts.components();
    const Index vertex_count =
        corners == 0 ? 0 : 1 + *std::max_element(vertex_of.begin(), vertex_of.end());
    const auto shell_of = shells.components();
    surface_.shell_count = 1 + *std::max_element(shell_of.begin(), shell_of.end());
    const auto euler = static_cast<Index>(vertex_count) - static_cast<Index>(pairs_.size()) +
                       2 * static_cast<Index>(surface_.faces.size()) -
                       static_cast<Index>(loops_.size());
    surface_.genus = surface_.shell_count - euler / 2;
    surface_.convex = surface_.convex && surface_.shell_count == 1 && surface_.genus == 0;
    const std::vector<bool> straight = straight_vertices(vertex_of, vertex_count);
    surface_.edge_count = static_cast<Index>(pairs_.size()) -
                          static_cast<Index>(std::count(straight.begin(), straight.end(), true));
    write(vertex_of, straight);
  }

  bool is_convex(const EdgeUse& one, const EdgeUse& two) const {
    const Loop &l1 = loops_[one.loop], &l2 = loops_[two.loop];
    const HalfSpaceId h1 = surface_.faces[l1.face].inside, h2 = surface_.faces[l2.face].inside;
    if (h1 == h2) return true;
    if (plane_of(h1) == plane_of(h2)) return false;
    const Vec3 e = vertices_[l1.vertex[(one.corner + 1) % l1.vertex.size()]].x -
                   vertices_[l1.vertex[one.corner]].x;
    return dot(cross(outward(l1.face), outward(l2.face)), e) > 0;
  }

  // Vertices in the middle of a straight edge between the same two faces are none.
  std::vector<bool> straight_vertices(const std::vector<Index>& vertex_of, Index count) const {
    std::vector<Index> corners(count, 0);
    std::vector<bool> straight(count, true);
    Index c = 0;
    for (const Loop& l : loops_) {
      const std::size_t n = l.vertex.size();
      for (std::size_t k = 0; k < n; ++k, ++c) {
        const Vec3 a = vertices_[l.vertex[k]].x - vertices_[l.vertex[(k + n - 1) % n]].x;
        const Vec3 b = vertices_[l.vertex[(k + 1) % n]].x - vertices_[l.vertex[k]].x;
        ++corners[vertex_of[c]];
        if (norm(cross(a, b)) > 1e-7 * norm(a) * norm(b)) straight[vertex_of[c]] = false;
      }
    }
    for (Index v = 0; v < count; ++v) straight[v] = straight[v] && corners[v] == 2;
    return straight;
  }

  void write(const std::vector<Index>& vertex_of, const std::vector<bool>& straight) {
    // Vertex of the surface → vertex of the block. Where two sheets of a surface touch, one point is two vertices.
    std::unordered_map<Index, Index> number;
    Index c = 0, face = 0;
    for (const Loop& l : loops_) {
      while (face < l.face)
        surface_.loop_begin.push_back(static_cast<Index>(surface_.corner_begin.size()) - 1), ++face;
      for (const Index v : l.vertex) {
        const Index of_surface = vertex_of[c++];
        if (straight[of_surface]) continue;
        const auto [it, fresh] =
            number.try_emplace(of_surface, static_cast<Index>(surface_.vertices.size()));
        if (fresh) surface_.vertices.push_back(vertices_[v].x);
        surface_.corner_vertex.push_back(it->second);
      }
      surface_.corner_begin.push_back(static_cast<Index>(surface_.corner_vertex.size()));
    }
    surface_.loop_begin.push_back(static_cast<Index>(surface_.corner_begin.size()) - 1);
  }

  const Complex& complex_;
  const std::vector<BoundaryArea>& areas_;
  UnionFind area_parts_;
  std::vector<Index> group_;  // of each area
  std::vector<Vertex> vertices_;
  std::vector<DirectedEdge> edges_;
  std::vector<Loop> loops_;
  std::vector<std::pair<EdgeUse, EdgeUse>> pairs_;
  BlockSurface surface_;
};

}  // namespace

BlockSurface make_block_surface(const Complex& complex, const std::vector<BoundaryArea>& areas) {
  try {
    return SurfaceMerger(complex, areas).run();
  } catch (const NotClosed& error) {
    const Vec3 x = error.x + complex.planes.centre();
    throw Error(
        ErrorKind::analysis,
        fmt::format(
            "the surface of a block does not close at ({:.9g}, {:.9g}, {:.9g}): {}; planes that "
            "nearly coincide there are neither one plane nor clearly two",
            x[0], x[1], x[2], error.what()));
  }
}

}  // namespace rockfold
