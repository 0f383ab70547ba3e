// The rock between a ground surface and a base elevation.
#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include "host/refuse.hpp"
#include "host/shapes/families_exact.hpp"
#include "host/shapes/triangles_inside_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = OutlineTriangulation<Kernel>;

constexpr Index bottom_face = 4, top_face = 5;  // face_names: xmin xmax ymin ymax zmin top

struct Edge {
  Index from, to;  // the ground lies to the left
};

struct Rectangle {
  Vec3 min, max;

  /// Which of its sides xmin, xmax, ymin, ymax is the nearest.
  Index nearest_side(const Vec3& p) const {
    const std::array<Real, 4> distance{p[0] - min[0], max[0] - p[0], p[1] - min[1], max[1] - p[1]};
    return static_cast<Index>(std::min_element(distance.begin(), distance.end()) -
                              distance.begin());
  }
};

std::string text(const Vec3& p) {
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", p[0], p[1], p[2]);
}

void check_ground(const TriangleSurface& ground, Real base, const Place& place) {
  const auto plan = [](const Vec3& p) { return Kernel::Point_2(p[0], p[1]); };
  for (const auto& t : ground.triangles) {
    const Vec3 &a = ground.vertices[t[0]], &b = ground.vertices[t[1]], &c = ground.vertices[t[2]];
    if (CGAL::orientation(plan(a), plan(b), plan(c)) != CGAL::LEFT_TURN)
      refuse(place, place.key,
             "the ground stands upright or overhangs at " + text(a) +
                 "; terrain needs one elevation at each place");
    for (const Vec3& p : {a, b, c})
      if (!(p[2] > base))
        refuse(place, place.key,
               fmt::format("the ground at {} is not above the base elevation {:.9g} m", text(p),
                           base));
  }
}

// The edges that one triangle alone has.
std::vector<Edge> boundary_edges(const TriangleSurface& ground, const Place& place) {
  struct Use {
    std::uint64_t edge;  // smaller vertex · 2³² + larger
    bool ascending;
  };
  std::vector<Use> uses;
  uses.reserve(3 * ground.triangles.size());
  for (const auto& t : ground.triangles)
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::uint64_t>(t[k]),
                 b = static_cast<std::uint64_t>(t[(k + 1) % 3]);
      uses.push_back({std::min(a, b) << 32 | std::max(a, b), a < b});
    }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.ascending < b.ascending;
  });
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i + 1;
    while (end < uses.size() && uses[end].edge == uses[i].edge) ++end;
    const auto low = static_cast<Index>(uses[i].edge >> 32);
    const auto high = static_cast<Index>(uses[i].edge & 0xffffffffu);
    if (end - i > 2 || (end - i == 2 && uses[i].ascending == uses[i + 1].ascending))
      refuse(place, place.key,
             "triangles of the ground lie on each other at " + text(ground.vertices[low]));
    if (end - i == 1) edges.push_back(uses[i].ascending ? Edge{low, high} : Edge{high, low});
    i = end;
  }
  return edges;
}

// Appends the polygons of a terrain's surface.
class TerrainSurface {
 public:
  TerrainSurface(const TriangleSurface& ground, Real base, ClosedSurface& surface)
      : base_(base), surface_(surface), below_(ground.vertices.size(), none) {
    surface_.vertices = ground.vertices;
    surface_.corner.reserve(3 * ground.triangles.size());
    surface_.polygon_begin.reserve(ground.triangles.size() + 1);
    surface_.face.reserve(ground.triangles.size());
    for (const auto& t : ground.triangles) add({t[0], t[1], t[2]}, top_face);
  }

  void add_wall(const Edge& edge, Index face) {
    add({below(edge.from), below(edge.to), edge.to, edge.from}, face);
  }

  /// A polygon of the bottom under corners that run counter-clockwise seen from above.
  void add_bottom(std::vector<Index> corners) {
    for (Index& v : corners) v = below(v);
    std::reverse(corners.begin(), corners.end());
    add(corners, bottom_face);
  }

 private:
  // The vertex at the base elevation under one of the ground.
  Index below(Index v) {
    if (below_[v] == none) {
      below_[v] = static_cast<Index>(surface_.vertices.size());
      const Vec3& p = surface_.vertices[v];
      surface_.vertices.push_back({p[0], p[1], base_});
    }
    return below_[v];
  }

  template <class Corners = std::initializer_list<Index>>
  void add(const Corners& corners, Index face) {
    surface_.corner.insert(surface_.corner.end(), corners.begin(), corners.end());
    surface_.polygon_begin.push_back(static_cast<Index>(surface_.corner.size()));
    surface_.face.push_back(face);
  }

  Real base_;
  ClosedSurface& surface_;
  std::vector<Index> below_;
};

// The four vertices of the ground's outline if it is its bounding rectangle, counter-clockwise; else none.
std::vector<Index> rectangle_corners(const std::vector<Vec3>& p, const std::vector<Edge>& boundary,
                                     const Rectangle& box) {
  std::array<Index, 4> corners{none, none, none, none};
  std::array<int, 4> starts{};
  const auto is_corner = [&](Index v, int k) {
    return p[v][0] == (k == 1 || k == 2 ? box.max : box.min)[0] &&
           p[v][1] == (k >= 2 ? box.max : box.min)[1];
  };
  for (const auto& [a, b] : boundary) {
    const bool on_side = (p[a][1] == box.min[1] && p[b][1] == box.min[1]) ||
                         (p[a][0] == box.max[0] && p[b][0] == box.max[0]) ||
                         (p[a][1] == box.max[1] && p[b][1] == box.max[1]) ||
                         (p[a][0] == box.min[0] && p[b][0] == box.min[0]);
    if (!on_side) return {};
    for (int k = 0; k < 4; ++k)
      if (is_corner(a, k)) corners[k] = a, ++starts[k];
  }
  for (int k = 0; k < 4; ++k)
    if (corners[k] == none || starts[k] != 1) return {};
  return {corners.begin(), corners.end()};
}

std::vector<std::array<Index, 3>> triangulated(const std::vector<Vec3>& vertices,
                                               const std::vector<Edge>& boundary,
                                               const Place& place) {
  Triangulation plan;
  try {
    const auto handle = [&](Index v) {
      const auto h = plan.insert(Kernel::Point_2(vertices[v][0], vertices[v][1]));
      h->info() = v;
      return h;
    };
    for (const Edge& e : boundary) {
      const auto from = handle(e.from), to = handle(e.to);
      plan.insert_constraint(from, to);
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    refuse(place, place.key, "the outline of the ground crosses itself");
  }
  return triangles_inside(plan);
}

}  // namespace

ShapeGeometry terrain_geometry(const TerrainShape& terrain, const Place& place) {
  if (!terrain.ground || terrain.ground->triangles.empty())
    refuse(place, place.key, "the ground of " + terrain.file + " has no triangles");
  const TriangleSurface& ground = *terrain.ground;
  check_ground(ground, terrain.base, place);
  const std::vector<Edge> boundary = boundary_edges(ground, place);
  ShapeGeometry geometry;
  TerrainSurface surface(ground, terrain.base, geometry.surface);

  Rectangle box{ground.vertices[boundary.front().from], ground.vertices[boundary.front().from]};
  for (const Edge& e : boundary)
    for (int d = 0; d < 2; ++d) {
      box.min[d] = std::min(box.min[d], ground.vertices[e.from][d]);
      box.max[d] = std::max(box.max[d], ground.vertices[e.from][d]);
    }
  for (const Edge& e : boundary)
    surface.add_wall(e, box.nearest_side(0.5 * (ground.vertices[e.from] + ground.vertices[e.to])));
  if (auto corners = rectangle_corners(ground.vertices, boundary, box); !corners.empty())
    surface.add_bottom(std::move(corners));
  else
    for (const auto& t : triangulated(ground.vertices, boundary, place))
      surface.add_bottom({t.begin(), t.end()});
  geometry.corners = bounding_corners(geometry.surface.vertices);
  return geometry;
}

}  // namespace rockfold
