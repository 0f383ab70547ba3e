#include "host/flatten/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "host/flatten/winding_outline_exact.hpp"

namespace rockfold {
namespace {

using Plan = WindingOutline::Plan;
using Point = Plan::Point;
using Triangle = std::array<Index, 3>;

/// Points in the coordinate plane across the normal's largest component, as seen from its tip.
/// Coordinates are taken as they are: nothing is rounded.
class Projection {
 public:
  explicit Projection(const Vec3& normal) {
    int d = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(normal[k]) > std::abs(normal[d])) d = k;
    u_ = (d + 1) % 3, v_ = (d + 2) % 3;
    if (normal[d] < 0) std::swap(u_, v_);
  }
  Point operator()(const Vec3& x) const { return {x[u_], x[v_]}; }

 private:
  int u_, v_;
};

struct Corner {
  Point at;
  Index point;
  std::size_t loop, number;
};

/// The different places where corners of loops lie, by x and y.
struct Places {
  std::vector<std::pair<Point, Index>> place;  ///< and its own number
  std::vector<Corner> corner;                  ///< by place, then by point
  std::vector<Index> corner_begin{0};          ///< [places + 1] into corner
  std::vector<std::vector<Index>> of_corner;   ///< [loops][corners] its place

  Index first_point(Index p) const { return corner[corner_begin[p]].point; }
  bool several_points(Index p) const {
    return first_point(p) != corner[corner_begin[p + 1] - 1].point;
  }
  Index place_after(const Corner& c) const {
    const auto& loop = of_corner[c.loop];
    return loop[c.number + 1 < loop.size() ? c.number + 1 : 0];
  }
};

Places places_of(std::span<const Loop> loops, const std::vector<Vec3>& points,
                 const Projection& plane) {
  Places places;
  auto& corner = places.corner;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    places.of_corner.emplace_back(loops[l].size());
    for (std::size_t i = 0; i < loops[l].size(); ++i)
      corner.push_back({plane(points[loops[l][i]]), loops[l][i], l, i});
  }
  std::sort(corner.begin(), corner.end(), [](const Corner& a, const Corner& b) {
    return a.at != b.at ? a.at < b.at : a.point < b.point;
  });
  for (std::size_t c = 0; c < corner.size(); ++c) {
    const auto number = static_cast<Index>(places.place.size());
    if (c > 0 && corner[c].at != corner[c - 1].at)
      places.corner_begin.push_back(static_cast<Index>(c));
    if (c == 0 || corner[c].at != corner[c - 1].at) places.place.emplace_back(corner[c].at, number);
    places.of_corner[corner[c].loop][corner[c].number] =
        static_cast<Index>(places.place.size()) - 1;
  }
  places.corner_begin.push_back(static_cast<Index>(corner.size()));
  return places;
}

/// The edges that the loops pass; those that they pass as often each way are left out.
EdgeCount edges_of(const Places& places) {
  EdgeCount edges;
  for (const Corner& c : places.corner)
    edges.add(places.of_corner[c.loop][c.number], places.place_after(c), 1);
  return edges;
}

/// Of the points at `place` that whose loop leaves it most nearly towards `other`.
Index point_towards(const Places& places, Index place, Index other) {
  const auto direction = [&](Index to) {
    return places.place[to].first - places.place[place].first;
  };
  const auto wanted = direction(other);
  Index best = places.first_point(place);
  Real best_cosine = -2;
  for (Index c = places.corner_begin[place]; c < places.corner_begin[place + 1]; ++c) {
    const auto leaves = direction(places.place_after(places.corner[c]));
    const Real cosine =
        leaves * wanted / std::sqrt(leaves.squared_length() * wanted.squared_length());
    if (cosine > best_cosine) best_cosine = cosine, best = places.corner[c].point;
  }
  return best;
}

/// Triangles of places as triangles of points. Where several points lie in one place, the triangles around it form fans,
/// from the edge on which a loop leaves it to the next on which one comes: each fan is of the point of that loop, so that
/// surfaces that meet themselves in a vertex stay closed.
std::vector<Triangle> triangles_of_points(const std::vector<Triangle>& triangles,
                                          const Places& places) {
  std::vector<Triangle> out = triangles;
  std::map<std::array<Index, 2>, std::array<std::size_t, 2>> leaving;  // place, next → triangle, k
  std::set<std::array<Index, 2>> arriving;                             // place, the one before
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Index place = triangles[t][k];
      out[t][k] = places.first_point(place);
      if (!places.several_points(place)) continue;
      leaving[{place, triangles[t][(k + 1) % 3]}] = {t, k};
      arriving.insert({place, triangles[t][(k + 2) % 3]});
    }
  for (const auto& [edge, first] : leaving) {
    if (arriving.count(edge)) continue;
    const Index point = point_towards(places, edge[0], edge[1]);
    for (auto at = leaving.find(edge); at != leaving.end();) {
      const auto [t, k] = at->second;
      out[t][k] = point;
      at = leaving.find({edge[0], triangles[t][(k + 2) % 3]});
    }
  }
  return out;
}

bool all_finite(std::span<const Loop> loops, const std::vector<Vec3>& points) {
  for (const Loop& loop : loops)
    for (const Index p : loop)
      for (const Real x : points[p])
        if (!std::isfinite(x)) return false;
  return true;
}

}  // namespace

std::vector<std::array<Index, 3>> triangulate(std::span<const Loop> loops,
                                              const std::vector<Vec3>& points, const Vec3& normal) {
  if (!all_finite(loops, points)) return {};
  const Places places = places_of(loops, points, Projection(normal));
  Plan plan;
  plan.insert(places.place.begin(), places.place.end());
  if (plan.dimension() < 2) return {};
  std::vector<Plan::Vertex_handle> vertex(places.place.size());
  for (const auto v : plan.finite_vertex_handles()) vertex[v->info()] = v;

  // A vertex on the wrong side of an edge by rounding is the end of two edges that cross it.
  WindingOutline outline(plan, 2 * places.place.size());
  const EdgeCount edges = edges_of(places);
  for (const auto& [edge, passes] : edges.passes())
    outline.draw(vertex[edge[0]], vertex[edge[1]], passes);
  const auto triangles = triangles_above(
      plan, [&](int here, auto face, int k) { return outline.across(here, face, k); });
  return triangles_of_points(triangles, places);
}

}  // namespace rockfold
