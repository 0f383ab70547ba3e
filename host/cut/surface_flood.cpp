#include "host/cut/surface_flood.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "host/cut/contacts.hpp"
#include "host/cut/patch_finder.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// A part of a body's surface between two cells.
struct Wall {
  Index body, inner, outer;  // cells on its two sides
  Real width;
};

// An area that two cells share.
struct Link {
  Index cell[2];
  Real width;  // m, of a strip of the same area and circumference
};

struct PlaneLinks {
  std::vector<Link> links;
  std::vector<Wall> walls;
};

bool is_surface(const Body& body) {
  return body.inside.empty();
}

// Where the rules of intent hold a vertex to be on a plane that it misses, neighbours of it may share an area so narrow
// that its place says nothing: a vertex is off by the tolerance, and where planes meet at small angles by more along them.
constexpr Real narrow = 1e-7;  // of the model's size

Real width_of(const Polygon& polygon) {
  Real around = 0;
  for (std::size_t k = 0; k < polygon.corner.size(); ++k)
    around += norm(polygon.corner[(k + 1) % polygon.corner.size()].x - polygon.corner[k].x);
  return around > 0 ? 2 * polygon_moments(polygon).area / around : 0;
}

// The bodies whose facets cover most of an area.
void add_walls(const Complex& complex, const PatchFinder& finder, const SharedArea& shared,
               const Polygon& polygon, Real width, PolygonClipper& clipper,
               std::vector<Wall>& walls) {
  Box box;
  for (const Vertex& v : polygon.corner) box.add(v.x);
  std::vector<Index> near;
  finder.near(box, complex.planes.tolerance(), near);
  std::vector<std::pair<std::array<Index, 2>, Real>> covered;  // body and inner side, area
  for (const Index f : near) {
    const Facet& facet = complex.facets[f];
    if (!is_surface(complex.bodies[facet.body])) continue;
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
    if (area > half) walls.push_back({key[0], shared.cell[key[1]], shared.cell[1 - key[1]], width});
}

// A walk over all cells, each from an earlier one through the widest area that leads on.
struct Walk {
  std::vector<Index> cell, from;  // from[i] leads to cell[i]; of the first: itself
};

Walk widest_walk(const std::vector<Link>& links, Index cell_count) {
  std::vector<std::int64_t> begin(static_cast<std::size_t>(cell_count) + 1, 0);
  for (const Link& l : links) ++begin[l.cell[0] + 1], ++begin[l.cell[1] + 1];
  for (Index c = 0; c < cell_count; ++c) begin[c + 1] += begin[c];
  std::vector<Index> of_cell(begin.back());
  std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t i = 0; i < links.size(); ++i)
    for (const Index c : links[i].cell) of_cell[next[c]++] = static_cast<Index>(i);

  Walk walk;
  std::vector<bool> seen(static_cast<std::size_t>(cell_count), false);
  struct Step {
    Real width;
    Index link, to;
    bool operator<(const Step& o) const {
      return width != o.width ? width < o.width : link > o.link;
    }
  };
  std::priority_queue<Step> open;
  const auto visit = [&](Index cell, Index from) {
    seen[cell] = true;
    walk.cell.push_back(cell);
    walk.from.push_back(from);
    for (auto i = begin[cell]; i < begin[cell + 1]; ++i) {
      const Link& l = links[of_cell[i]];
      const Index to = l.cell[0] == cell ? l.cell[1] : l.cell[0];
      if (!seen[to]) open.push({l.width, of_cell[i], to});
    }
  };
  visit(0, 0);
  while (!open.empty()) {
    const Step step = open.top();
    open.pop();
    const Link& l = links[step.link];
    if (!seen[step.to]) visit(step.to, l.cell[0] == step.to ? l.cell[1] : l.cell[0]);
  }
  return walk;
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
      : complex_(complex), cells_(cells), walls_(complex.bodies.size()) {
    for (const PlaneLinks& p : planes) {
      links_.insert(links_.end(), p.links.begin(), p.links.end());
      for (const Wall& w : p.walls) walls_[w.body].push_back(w);
    }
    walk_ = widest_walk(links_, cells.size());
  }

  // Each wall that the walk passes leads from outside to inside or back; the widest wall tells which is which. All areas
  // that are wide enough to tell must agree.
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
    std::vector<bool> is_inner(static_cast<std::size_t>(cells_.size()), false);
    for (std::size_t i = 1; i < walk_.cell.size(); ++i) {
      const Index to = walk_.cell[i], from = walk_.from[i];
      is_inner[to] = is_inner[from] != is_wall(walls, from, to);
    }
    const auto widest = std::max_element(
        walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.width < b.width; });
    if (!is_inner[widest->inner]) is_inner.flip();
    const Real telling = narrow * complex_.planes.model_size();
    for (const Wall& w : walls)
      if (w.width > telling && (!is_inner[w.inner] || is_inner[w.outer])) leak(body, w.inner);
    for (const Link& l : links_)
      if (l.width > telling && is_inner[l.cell[0]] != is_inner[l.cell[1]] &&
          !is_wall(walls, l.cell[0], l.cell[1]))
        leak(body, l.cell[1]);
    for (Index c = 0; c < cells_.size(); ++c)
      if (is_inner[c]) found.push_back(c);
    return found;
  }

 private:
  static bool is_wall(const std::vector<Wall>& walls, Index a, Index b) {
    const auto before = [](const Wall& x, const Wall& y) {
      return std::tie(x.inner, x.outer) < std::tie(y.inner, y.outer);
    };
    return std::binary_search(walls.begin(), walls.end(), Wall{none, a, b, 0}, before) ||
           std::binary_search(walls.begin(), walls.end(), Wall{none, b, a, 0}, before);
  }

  [[noreturn]] void leak(Index body, Index cell) const {
    throw LeakingSurface{body, bounding_ball(cells_[cell]).centre + complex_.planes.centre()};
  }

  const Complex& complex_;
  const CellStore& cells_;
  std::vector<Link> links_;
  Walk walk_;
  std::vector<std::vector<Wall>> walls_;  // [bodies]
};

}  // namespace

std::vector<std::vector<Index>> cells_inside_surfaces(const Complex& complex,
                                                      const CellStore& cells) {
  std::vector<std::vector<Index>> result(complex.bodies.size());
  if (std::none_of(complex.bodies.begin(), complex.bodies.end(), is_surface)) return result;
  std::vector<PlaneLinks> planes(complex.planes.size());
  for_each_plane(complex.planes, cells, [&](Index plane, PlaneContacts& contacts) {
    PolygonClipper clipper(complex.planes);
    const auto facets = complex.facets_by_plane.on(plane);
    const PatchFinder finder(facets, complex.planes.normal(plane),
                             [&](Index f) { return complex.facets[f].patch.box; });
    for (SharedArea& shared : contacts.shared) {
      const CellView below = cells[shared.cell[0]];
      const Polygon polygon = shared.polygon.empty()
                                  ? face_polygon(below, below.faces[shared.face[0]])
                                  : std::move(shared.polygon);
      const Real width = width_of(polygon);
      planes[plane].links.push_back({{shared.cell[0], shared.cell[1]}, width});
      if (!facets.empty())
        add_walls(complex, finder, shared, polygon, width, clipper, planes[plane].walls);
    }
  });
  Flood flood(complex, cells, planes);
  for (std::size_t b = 0; b < complex.bodies.size(); ++b)
    if (is_surface(complex.bodies[b])) result[b] = flood.inside(static_cast<Index>(b));
  return result;
}

}  // namespace rockfold
