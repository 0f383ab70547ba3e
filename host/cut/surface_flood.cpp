#include "host/cut/surface_flood.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "host/cut/contacts.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// A part of a body's surface between two cells.
struct Wall {
  Index body, inner, outer;  // cells on its two sides
};

struct PlaneLinks {
  std::vector<std::array<Index, 2>> links;  // cells that share an area
  std::vector<Wall> walls;
};

bool is_surface(const Body& body) {
  return body.inside.empty();
}

// The bodies whose facets cover most of an area.
void add_walls(const Complex& complex, const CellStore& cells, Index plane,
               const SharedArea& shared, PolygonClipper& clipper, std::vector<Wall>& walls) {
  const CellView below = cells[shared.cell[0]];
  const Polygon polygon =
      shared.polygon.empty() ? face_polygon(below, below.faces[shared.face[0]]) : shared.polygon;
  Box box;
  for (const Vertex& v : polygon.corner) box.add(v.x);
  std::vector<std::pair<std::array<Index, 2>, Real>> covered;  // body and inner side, area
  for (const Index f : complex.facets_by_plane.on(plane)) {
    const Facet& facet = complex.facets[f];
    if (!is_surface(complex.bodies[facet.body]) ||
        !facet.patch.box.meets(box, complex.planes.tolerance()))
      continue;
    const std::array<Index, 2> key{facet.body, is_above(facet.inside) ? 1 : 0};
    const Real area = polygon_moments(clipper.intersection(polygon, facet.patch.edges)).area;
    const auto found =
        std::find_if(covered.begin(), covered.end(), [&](const auto& c) { return c.first == key; });
    if (found != covered.end())
      found->second += area;
    else
      covered.emplace_back(key, area);
  }
  const Real half = polygon_moments(polygon).area / 2;
  for (const auto& [key, area] : covered)
    if (area > half) walls.push_back({key[0], shared.cell[key[1]], shared.cell[1 - key[1]]});
}

// Areas shared by cells as a graph: the links of cell c are other[begin[c]] ….
struct Graph {
  std::vector<std::int64_t> begin;
  std::vector<Index> other;
};

Graph make_graph(const std::vector<PlaneLinks>& planes, Index cell_count) {
  Graph graph;
  graph.begin.assign(static_cast<std::size_t>(cell_count) + 1, 0);
  for (const PlaneLinks& p : planes)
    for (const auto& [a, b] : p.links) ++graph.begin[a + 1], ++graph.begin[b + 1];
  for (Index c = 0; c < cell_count; ++c) graph.begin[c + 1] += graph.begin[c];
  graph.other.resize(graph.begin.back());
  std::vector<std::int64_t> next(graph.begin.begin(), graph.begin.end() - 1);
  for (const PlaneLinks& p : planes)
    for (const auto& [a, b] : p.links) graph.other[next[a]++] = b, graph.other[next[b]++] = a;
  return graph;
}

// Where no wall was found the surface holds all cells or none: its winding number about one of them tells.
bool surrounds(const Complex& complex, const Body& body, const Vec3& x) {
  Real angle = 0;
  for (Index f = body.facet_begin; f < body.facet_end; ++f) {
    const Facet& facet = complex.facets[f];
    std::vector<Vec3> corner;
    const auto n = facet.patch.edges.size();
    for (std::size_t k = 0; k < n; ++k)
      corner.push_back(complex.planes
                           .vertex(facet.patch.plane, plane_of(facet.patch.edges[(k + n - 1) % n]),
                                   plane_of(facet.patch.edges[k]))
                           .x -
                       x);
    const Real sense = is_above(facet.inside) ? -1 : 1;
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const Vec3 &a = corner[0], &b = corner[k], &c = corner[k + 1];
      const Real la = norm(a), lb = norm(b), lc = norm(c);
      angle += sense * 2 *
               std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
  }
  return std::abs(angle) > 2 * std::numbers::pi;
}

class Flood {
 public:
  Flood(const Complex& complex, const CellStore& cells, const std::vector<PlaneLinks>& planes)
      : complex_(complex), cells_(cells), graph_(make_graph(planes, cells.size())) {
    state_.assign(static_cast<std::size_t>(cells.size()), 0);
    walls_.resize(complex.bodies.size());
    for (const PlaneLinks& p : planes)
      for (const Wall& w : p.walls) walls_[w.body].push_back(w);
  }

  std::vector<Index> inside(Index body) {
    auto& walls = walls_[body];
    std::vector<Index> found;
    if (walls.empty()) {
      const bool all = surrounds(complex_, complex_.bodies[body], bounding_ball(cells_[0]).centre);
      for (Index c = 0; all && c < cells_.size(); ++c) found.push_back(c);
      return found;
    }
    std::sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) {
      return std::tie(a.inner, a.outer) < std::tie(b.inner, b.outer);
    });
    for (const Wall& w : walls) state_[w.outer] = outer;
    for (const Wall& w : walls) {
      if (state_[w.inner] == outer) leak(body, w.inner);
      if (state_[w.inner] == 0) found.push_back(w.inner);
      state_[w.inner] = inner;
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Index c = found[i];
      for (auto l = graph_.begin[c]; l < graph_.begin[c + 1]; ++l) {
        const Index next = graph_.other[l];
        if (state_[next] == inner || is_wall(walls, c, next)) continue;
        if (state_[next] == outer) leak(body, next);
        state_[next] = inner;
        found.push_back(next);
      }
    }
    for (const Wall& w : walls) state_[w.outer] = 0;
    for (const Index c : found) state_[c] = 0;
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static constexpr std::int8_t inner = 1, outer = 2;

  static bool is_wall(const std::vector<Wall>& walls, Index from, Index to) {
    return std::binary_search(walls.begin(), walls.end(), Wall{none, from, to},
                              [](const Wall& a, const Wall& b) {
                                return std::tie(a.inner, a.outer) < std::tie(b.inner, b.outer);
                              });
  }

  [[noreturn]] void leak(Index body, Index cell) const {
    const Vec3 x = bounding_ball(cells_[cell]).centre + complex_.planes.centre();
    const Index origin = complex_.facets[complex_.bodies[body].facet_begin].origin;
    throw Error(ErrorKind::analysis,
                fmt::format("the surface of {} does not separate inside from outside near ({:.6g}, "
                            "{:.6g}, {:.6g}); its triangles nearly coincide there",
                            origin == none ? "a merge region" : complex_.origins[origin].name, x[0],
                            x[1], x[2]));
  }

  const Complex& complex_;
  const CellStore& cells_;
  Graph graph_;
  std::vector<std::vector<Wall>> walls_;  // [bodies]
  std::vector<std::int8_t> state_;
};

}  // namespace

std::vector<std::vector<Index>> cells_inside_surfaces(const Complex& complex,
                                                      const CellStore& cells) {
  std::vector<std::vector<Index>> result(complex.bodies.size());
  if (std::none_of(complex.bodies.begin(), complex.bodies.end(), is_surface)) return result;
  std::vector<PlaneLinks> planes(complex.planes.size());
  for_each_plane(complex.planes, cells, [&](Index plane, PlaneContacts& contacts) {
    PolygonClipper clipper(complex.planes);
    for (const SharedArea& shared : contacts.shared) {
      planes[plane].links.push_back({shared.cell[0], shared.cell[1]});
      add_walls(complex, cells, plane, shared, clipper, planes[plane].walls);
    }
  });
  Flood flood(complex, cells, planes);
  for (std::size_t b = 0; b < complex.bodies.size(); ++b)
    if (is_surface(complex.bodies[b])) result[b] = flood.inside(static_cast<Index>(b));
  return result;
}

}  // namespace rockfold
