#include "host/flatten/block_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "host/cut/bodies/union_find.hpp"
#include "host/flatten/near_vertices.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real full_turn = 6.283185307179586;

// One directed edge of an area, between vertices that lie next to each other on its line.
struct DirectedEdge {
  Index from, to;
  Index area;
};

class SurfaceMerger {
 public:
  SurfaceMerger(const Complex& complex, const std::vector<BoundaryArea>& areas)
      : complex_(complex), areas_(areas), tolerance_(complex.planes.width_tolerance()) {}

  BlockSurface run() {
    collect_edges();
    name_strips();
    grow_faces();
    cancel_inner_edges();
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

  HalfSpaceId inside(Index area) const {
    return complex_.cells[areas_[area].cell].faces[areas_[area].face].inside;
  }
  Vec3 outward(HalfSpaceId inside) const {
    const Vec3& n = complex_.planes.normal(plane_of(inside));
    return is_above(inside) ? -n : n;
  }
  Vec3 outward_of_face(Index face) const { return outward(surface_.faces[face].inside); }
  const Vec3& place(Index vertex) const { return vertices_[vertex]; }

  // The corners of an area, counter-clockwise seen from outside.
  std::vector<Vec3> corners(Index area) const {
    const BoundaryArea& a = areas_[area];
    if (a.beam != none) return complex_.beams[a.beam].polygon;
    const Polygon p = a.fragment != none ? complex_.polygon_of(complex_.fragments[a.fragment])
                                         : complex_.polygon_of(complex_.free_parts[a.free_part]);
    std::vector<Vec3> result;
    for (const Vertex& v : p.corner) result.push_back(v.x);
    if (is_above(inside(area))) std::reverse(result.begin(), result.end());
    return result;
  }

  // The areas tile a closed surface: as soon as their edges run through all vertices that lie on them, each is run through as often
  // in the one sense as in the other, and is still where vertices become one. Edges then run through all vertices nearer than
  // the tolerance, so that narrow faces fold up.
  void collect_edges() {
    const Real one_point = complex_.planes.position_tolerance();
    VertexMerger points(one_point);
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      const std::vector<Vec3> corner = corners(static_cast<Index>(i));
      std::vector<Index> loop;
      for (const Vec3& x : corner) loop.push_back(points.add(x));
      for (std::size_t k = 0; k < loop.size(); ++k)
        edges_.push_back({loop[k], loop[(k + 1) % loop.size()], static_cast<Index>(i)});
    }
    split_edges(points.vertices(), one_point);
    join_near(points.vertices());
    split_edges(vertices_, tolerance_);
    cancel([](const DirectedEdge& e) { return e.area; });
  }

  void split_edges(const std::vector<Vec3>& vertices, Real tolerance) {
    const VertexFinder finder(vertices, tolerance);
    std::vector<DirectedEdge> parts;
    parts.reserve(edges_.size());
    for (DirectedEdge e : edges_) {
      if (e.from == e.to) continue;
      std::vector<Index> between = finder.between(std::min(e.from, e.to), std::max(e.from, e.to));
      if (e.from > e.to) std::reverse(between.begin(), between.end());
      for (const Index on : between) {
        parts.push_back({e.from, on, e.area});
        e.from = on;
      }
      parts.push_back(e);
    }
    edges_ = std::move(parts);
  }

  void join_near(const std::vector<Vec3>& points) {
    VertexMerger merger(tolerance_);
    std::vector<Index> vertex;
    for (const Vec3& x : points) vertex.push_back(merger.add(x));
    vertices_ = merger.vertices();
    surface_.vertices_identified = static_cast<Index>(points.size() - vertices_.size());
    for (DirectedEdge& e : edges_) e.from = vertex[e.from], e.to = vertex[e.to];
    std::erase_if(edges_, [](const DirectedEdge& e) { return e.from == e.to; });
  }

  // Takes away edges that something runs along in both senses: strips vanish, and faces become whole.
  template <class Owner>
  void cancel(const Owner& owner) {
    const auto key = [&](const DirectedEdge& e) {
      return std::tuple{owner(e), std::min(e.from, e.to), std::max(e.from, e.to), e.from > e.to,
                        e.area};
    };
    std::sort(edges_.begin(), edges_.end(),
              [&](const DirectedEdge& a, const DirectedEdge& b) { return key(a) < key(b); });
    std::vector<DirectedEdge> left;
    for (auto begin = edges_.begin(); begin != edges_.end();) {
      const auto same = [&](const DirectedEdge& e) {
        return owner(e) == owner(*begin) &&
               std::minmax(e.from, e.to) == std::minmax(begin->from, begin->to);
      };
      const auto end = std::find_if_not(begin, edges_.end(), same);
      const auto turn = std::find_if(begin, end, [](const auto& e) { return e.from > e.to; });
      const auto up = turn - begin, down = end - turn, pairs = std::min(up, down);
      left.insert(left.end(), begin + pairs, turn);
      left.insert(left.end(), turn + pairs, end);
      begin = end;
    }
    edges_ = std::move(left);
  }

  // Glue beside slivers is on the surface where it is narrow, but has no name of its own: that of the area beside it that it
  // goes on with, the most nearly parallel one, if it has not vanished. Those that have only such strips beside them come later.
  void name_strips() {
    for (const BoundaryArea& area : areas_) origin_.push_back(area.origin);
    if (std::find(origin_.begin(), origin_.end(), none) == origin_.end()) return;
    std::map<std::pair<Index, Index>, Index> area_at;
    for (const DirectedEdge& e : edges_) area_at.try_emplace({e.from, e.to}, e.area);
    Index any = none;
    for (const Index origin : origin_)
      if (any == none) any = origin;
    for (bool named = true; named;) {
      const std::vector<Index> before = origin_;
      std::vector<Real> best(areas_.size(), -2);  // cosine
      for (const DirectedEdge& e : edges_) {
        const auto next = area_at.find({e.to, e.from});
        if (before[e.area] != none || next == area_at.end() || before[next->second] == none)
          continue;
        const Real parallel = dot(outward(inside(e.area)), outward(inside(next->second)));
        if (parallel <= best[e.area]) continue;
        best[e.area] = parallel;
        origin_[e.area] = before[next->second];
      }
      named = origin_ != before;
    }
    std::replace(origin_.begin(), origin_.end(), Index{none}, any);
  }

  bool lies_on(Index area, HalfSpaceId plane) const {
    if (inside(area) == plane) return true;
    if (!(dot(outward(inside(area)), outward(plane)) > 0)) return false;
    const Vec3& n = complex_.planes.normal(plane_of(plane));
    const Real offset = complex_.planes.offset(plane_of(plane));
    const auto [first, last] = edges_of_area_[area];
    return std::all_of(edges_.begin() + first, edges_.begin() + last, [&](const DirectedEdge& e) {
      return std::abs(dot(n, place(e.from)) - offset) < tolerance_;
    });
  }

  bool is_one_face(Index one, Index two) const {
    return one == two || complex_.origins[one].is_one_face_with(complex_.origins[two]);
  }

  // A face has the names of the part that has most; of equals the first.
  void take_names(Index origin, Index& of_face) const {
    const auto names = [&](Index o) { return complex_.origins[o].also.size(); };
    if (names(origin) > names(of_face) || (names(origin) == names(of_face) && origin < of_face))
      of_face = origin;
  }

  // Areas of one origin that meet in an edge are one face, as far as they lie on the plane of the largest, to the tolerance.
  void grow_faces() {
    const auto count = static_cast<Index>(areas_.size());
    edges_of_area_.assign(count, {0, 0});
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      auto& [first, last] = edges_of_area_[edges_[i].area];
      if (last == 0) first = static_cast<std::ptrdiff_t>(i);
      last = static_cast<std::ptrdiff_t>(i) + 1;
    }
    std::vector<std::size_t> by_ends(edges_.size());
    std::iota(by_ends.begin(), by_ends.end(), std::size_t{0});
    const auto ends = [&](std::size_t i) { return std::pair{edges_[i].from, edges_[i].to}; };
    std::sort(by_ends.begin(), by_ends.end(), [&](std::size_t a, std::size_t b) {
      return std::pair{ends(a), a} < std::pair{ends(b), b};
    });
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return areas_[a].area > areas_[b].area; });

    face_of_.assign(count, none);
    std::vector<Index> open;
    for (const Index seed : order) {
      if (face_of_[seed] != none || edges_of_area_[seed].second == 0) continue;
      const auto face = static_cast<Index>(surface_.faces.size());
      surface_.faces.push_back({inside(seed), origin_[seed], 0});
      open.assign(1, seed);
      face_of_[seed] = face;
      while (!open.empty()) {
        const Index area = open.back();
        open.pop_back();
        surface_.faces[face].area += areas_[area].area;
        for (auto i = edges_of_area_[area].first; i < edges_of_area_[area].second; ++i) {
          const std::pair back{edges_[i].to, edges_[i].from};
          auto it =
              std::lower_bound(by_ends.begin(), by_ends.end(), back,
                               [&](std::size_t e, const auto& wanted) { return ends(e) < wanted; });
          for (; it != by_ends.end() && ends(*it) == back; ++it) {
            const Index next = edges_[*it].area;
            if (face_of_[next] != none || !is_one_face(origin_[next], origin_[seed]) ||
                !lies_on(next, inside(seed)))
              continue;
            face_of_[next] = face;
            take_names(origin_[next], surface_.faces[face].origin);
            open.push_back(next);
          }
        }
      }
    }
  }

  // Faces in the order of their planes, sides and origins. Those of which nothing is left are none.
  void cancel_inner_edges() {
    cancel([&](const DirectedEdge& e) { return face_of_[e.area]; });
    std::vector<Index> smallest(surface_.faces.size(), none);
    for (const DirectedEdge& e : edges_) {
      Index& area = smallest[face_of_[e.area]];
      area = area == none ? e.area : std::min(area, e.area);
    }
    std::vector<Index> order;
    for (std::size_t f = 0; f < smallest.size(); ++f)
      if (smallest[f] != none) order.push_back(static_cast<Index>(f));
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const auto &x = surface_.faces[a], &y = surface_.faces[b];
      return std::tie(x.inside, x.origin, smallest[a]) < std::tie(y.inside, y.origin, smallest[b]);
    });
    std::vector<Index> number(surface_.faces.size(), none);
    std::vector<BlockSurface::Face> faces;
    for (const Index f : order) {
      number[f] = static_cast<Index>(faces.size());
      faces.push_back(surface_.faces[f]);
    }
    surface_.faces = std::move(faces);
    for (Index& f : face_of_)
      if (f != none) f = number[f];
    surface_.face_of_area = face_of_;
    std::sort(edges_.begin(), edges_.end(), [&](const DirectedEdge& a, const DirectedEdge& b) {
      return std::tuple{face_of_[a.area], a.from, a.to, a.area} <
             std::tuple{face_of_[b.area], b.from, b.to, b.area};
    });
  }

  // Follows the edges of each face, as many of which enter a vertex as leave it; where several leave, the one that bounds the
  // same corner of the face: the first clockwise from the edge that came in.
  void chain_loops() {
    std::vector<bool> used(edges_.size(), false);
    for (std::size_t start = 0; start < edges_.size(); ++start) {
      if (used[start]) continue;
      Loop loop{{}, face_of_[edges_[start].area]};
      for (std::size_t e = start; !used[e]; e = next_edge(e, used, start)) {
        used[e] = true;
        loop.vertex.push_back(edges_[e].from);
      }
      loops_.push_back(std::move(loop));
    }
    // The outer loop first: the one of largest area.
    std::stable_sort(loops_.begin(), loops_.end(), [&](const Loop& a, const Loop& b) {
      return a.face != b.face ? a.face < b.face : loop_area(a) > loop_area(b);
    });
  }

  std::size_t next_edge(std::size_t e, const std::vector<bool>& used, std::size_t start) const {
    const Index face = face_of_[edges_[e].area], at = edges_[e].to;
    auto it = std::lower_bound(edges_.begin(), edges_.end(), std::pair{face, at},
                               [&](const DirectedEdge& d, const std::pair<Index, Index>& key) {
                                 return std::pair{face_of_[d.area], d.from} < key;
                               });
    const Vec3 back = place(edges_[e].from) - place(at);
    std::size_t best = start;
    Real best_angle = full_turn + 1;
    for (; it != edges_.end() && face_of_[it->area] == face && it->from == at; ++it) {
      const auto i = static_cast<std::size_t>(it - edges_.begin());
      if (used[i] && i != start) continue;
      const Real angle = clockwise_angle(back, place(it->to) - place(at), outward_of_face(face));
      if (angle < best_angle) best_angle = angle, best = i;
    }
    return best;
  }

  // From direction a turning clockwise (seen against n) to b, in (0, 2π].
  static Real clockwise_angle(const Vec3& a, const Vec3& b, const Vec3& n) {
    const Real angle = std::atan2(dot(n, cross(b, a)), dot(a, b));
    return angle > 1e-12 ? angle : angle + full_turn;
  }

  Real loop_area(const Loop& loop) const {
    const Vec3 n = outward_of_face(loop.face);
    const Vec3 o = place(loop.vertex.front());
    Real area = 0;
    for (std::size_t k = 1; k + 1 < loop.vertex.size(); ++k)
      area += dot(n, cross(place(loop.vertex[k]) - o, place(loop.vertex[k + 1]) - o));
    return area / 2;
  }

  Index start_of(const EdgeUse& u) const { return loops_[u.loop].vertex[u.corner]; }
  Index end_of(const EdgeUse& u) const {
    const auto& vertex = loops_[u.loop].vertex;
    return vertex[(u.corner + 1) % vertex.size()];
  }

  // Pairs the two uses of each edge. Where four or more faces meet along an edge, those that enclose rock belong together.
  void pair_edges() {
    std::vector<EdgeUse> uses;
    uses.reserve(edges_.size());
    for (std::size_t l = 0; l < loops_.size(); ++l)
      for (std::size_t k = 0; k < loops_[l].vertex.size(); ++k)
        uses.push_back({static_cast<Index>(l), static_cast<Index>(k)});
    const auto ends = [&](const EdgeUse& u) { return std::minmax({start_of(u), end_of(u)}); };
    std::stable_sort(uses.begin(), uses.end(),
                     [&](const EdgeUse& x, const EdgeUse& y) { return ends(x) < ends(y); });
    std::vector<EdgeUse> list;
    for (auto begin = uses.begin(); begin != uses.end();) {
      list.clear();
      const auto of = ends(*begin);
      for (; begin != uses.end() && ends(*begin) == of; ++begin) list.push_back(*begin);
      if (list.size() > 2) {
        sort_around(of.first, list);
        alternate(list);
      }
      for (std::size_t i = 0; i + 1 < list.size(); i += 2)
        pairs_.emplace_back(list[i], list[i + 1]);
      Index balance = 0;
      for (const EdgeUse& u : list) balance += start_of(u) == of.first ? 1 : -1;
      surface_.open_edges += std::abs(balance);
    }
  }

  // Two faces that belong together run through their edge in opposite senses, which angles of folded strips may not tell.
  void alternate(std::vector<EdgeUse>& list) const {
    for (std::size_t i = 0; i + 1 < list.size(); i += 2) {
      const Index start = start_of(list[i]);
      const auto back = std::find_if(list.begin() + static_cast<std::ptrdiff_t>(i) + 1, list.end(),
                                     [&](const EdgeUse& u) { return start_of(u) != start; });
      if (back != list.end())
        std::rotate(list.begin() + static_cast<std::ptrdiff_t>(i) + 1, back, back + 1);
    }
  }

  // Orders the uses by angle about the edge so that 0–1, 2–3, … enclose rock.
  void sort_around(Index a, std::vector<EdgeUse>& list) const {
    const Vec3 along = normalized(place(end_of(list.front())) - place(start_of(list.front())));
    const Vec3 axis = start_of(list.front()) == a ? along : -along;
    struct Placed {
      Real angle;
      bool rock_follows;  // turning counter-clockwise about the axis enters rock
      EdgeUse use;
    };
    std::vector<Placed> placed;
    Vec3 zero{};
    for (const EdgeUse& u : list) {
      const Vec3 n = outward_of_face(loops_[u.loop].face);
      const bool forward = start_of(u) == a;
      const Vec3 into_face = cross(n, forward ? axis : -axis);
      if (placed.empty()) zero = into_face;
      const Real angle = std::atan2(dot(axis, cross(zero, into_face)), dot(zero, into_face));
      placed.push_back(
          {angle < -1e-12 ? angle + full_turn : angle, dot(cross(axis, into_face), n) < 0, u});
    }
    std::sort(placed.begin(), placed.end(), [](const Placed& x, const Placed& y) {
      return x.angle != y.angle ? x.angle < y.angle : x.rock_follows < y.rock_follows;
    });
    if (!placed.front().rock_follows) std::rotate(placed.begin(), placed.begin() + 1, placed.end());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = placed[i].use;
  }

  void count_and_simplify() {
    std::vector<Index> first_corner;  // of each loop
    Index corners = 0;
    for (const Loop& l : loops_) {
      first_corner.push_back(corners);
      corners += static_cast<Index>(l.vertex.size());
    }
    const auto number = [&](const EdgeUse& u, Index shift) {
      return first_corner[u.loop] +
             (u.corner + shift) % static_cast<Index>(loops_[u.loop].vertex.size());
    };
    // Corners of different faces that an edge joins at either end are one vertex of the surface.
    UnionFind vertex_parts(corners), shells(static_cast<Index>(surface_.faces.size()));
    for (const auto& [one, two] : pairs_) {
      const bool opposite = start_of(one) == end_of(two);
      vertex_parts.join(number(one, 0), number(two, opposite ? 1 : 0));
      vertex_parts.join(number(one, 1), number(two, opposite ? 0 : 1));
      shells.join(loops_[one.loop].face, loops_[two.loop].face);
      surface_.convex = surface_.convex && is_convex(one, two);
    }
    const std::vector<Index> vertex_of = vertex_parts.components();
    const Index vertex_count =
        corners == 0 ? 0 : 1 + *std::max_element(vertex_of.begin(), vertex_of.end());
    const auto shell_of = shells.components();
    surface_.shell_count =
        shell_of.empty() ? 1 : 1 + *std::max_element(shell_of.begin(), shell_of.end());
    const auto edges = static_cast<Index>(pairs_.size());
    const Index euler = vertex_count - edges + 2 * static_cast<Index>(surface_.faces.size()) -
                        static_cast<Index>(loops_.size());
    surface_.genus = std::max<Index>(0, surface_.shell_count - euler / 2);
    surface_.convex = surface_.convex && surface_.shell_count == 1 && surface_.genus == 0;
    const std::vector<bool> straight = straight_vertices(vertex_of, vertex_count);
    surface_.edge_count =
        edges - static_cast<Index>(std::count(straight.begin(), straight.end(), true));
    write(vertex_of, straight);
  }

  // A hollow between two faces that is no deeper than the tolerance is none.
  bool is_convex(const EdgeUse& one, const EdgeUse& two) const {
    const Loop &l1 = loops_[one.loop], &l2 = loops_[two.loop];
    const Vec3 n = outward_of_face(l1.face);
    const Vec3 along = place(end_of(one)) - place(start_of(one));
    if (dot(cross(n, outward_of_face(l2.face)), along) > 0) return true;
    const Vec3& o = place(l1.vertex.front());
    if (dot(n, outward_of_face(l2.face)) < 0) return false;
    return std::all_of(l2.vertex.begin(), l2.vertex.end(),
                       [&](Index v) { return dot(n, place(v) - o) < tolerance_; });
  }

  // Vertices in the middle of a straight edge between the same two faces are none.
  std::vector<bool> straight_vertices(const std::vector<Index>& vertex_of, Index count) const {
    std::vector<Index> corners(count, 0);
    std::vector<bool> straight(count, true);
    Index c = 0;
    for (const Loop& l : loops_) {
      const std::size_t n = l.vertex.size();
      for (std::size_t k = 0; k < n; ++k, ++c) {
        const Vec3 a = place(l.vertex[k]) - place(l.vertex[(k + n - 1) % n]);
        const Vec3 b = place(l.vertex[(k + 1) % n]) - place(l.vertex[k]);
        ++corners[vertex_of[c]];
        if (norm(cross(a, b)) > tolerance_ * norm(a + b) || !(dot(a, b) > 0))
          straight[vertex_of[c]] = false;
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
        if (fresh) surface_.vertices.push_back(place(v));
        surface_.corner_vertex.push_back(it->second);
      }
      surface_.corner_begin.push_back(static_cast<Index>(surface_.corner_vertex.size()));
    }
    while (face < static_cast<Index>(surface_.faces.size()))
      surface_.loop_begin.push_back(static_cast<Index>(surface_.corner_begin.size()) - 1), ++face;
  }

  const Complex& complex_;
  const std::vector<BoundaryArea>& areas_;
  const Real tolerance_;
  std::vector<Vec3> vertices_;
  std::vector<DirectedEdge> edges_;
  std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>>
      edges_of_area_;                    // while they are sorted so
  std::vector<Index> origin_, face_of_;  // [areas]
  std::vector<Loop> loops_;
  std::vector<std::pair<EdgeUse, EdgeUse>> pairs_;
  BlockSurface surface_;
};

}  // namespace

BlockSurface make_block_surface(const Complex& complex, const std::vector<BoundaryArea>& areas) {
  return SurfaceMerger(complex, areas).run();
}

}  // namespace rockfold
