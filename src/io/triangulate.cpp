#include "src/io/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// A corner of the polygon in its plane.
struct Corner {
  Real x = 0, y = 0;
  Index point = none;
};
using Polygon = std::vector<Corner>;

bool same_place(const Corner& a, const Corner& b) {
  return a.x == b.x && a.y == b.y;
}

/// Twice the area of a triangle, positive if counter-clockwise; lengths are over the polygon's
/// size.
Real turn(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
constexpr Real flat = 1e-13;  // of the polygon's size squared: rounding of plane coordinates

Real distance2(const Corner& a, const Corner& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// Corner i's neighbours in a closed polygon.
std::size_t after(std::size_t i, std::size_t n) {
  return i + 1 < n ? i + 1 : 0;
}
std::size_t before(std::size_t i, std::size_t n) {
  return i > 0 ? i - 1 : n - 1;
}

/// Loops in coordinates of their plane: without the normal's largest component, mirrored back if
/// need be.
std::vector<Polygon> project(std::span<const Loop> loops, const std::vector<Vec3>& points,
                             const Vec3& normal) {
  int d = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[d])) d = k;
  const int u = (d + 1) % 3, v = (d + 2) % 3;
  const Vec3 origin = points[loops[0][0]];
  Real size = 0;
  for (const Index p : loops[0])
    size = std::max({size, std::abs(points[p][u] - origin[u]), std::abs(points[p][v] - origin[v])});
  const Real scale = 1 / size, mirrored = normal[d] < 0 ? -scale : scale;
  std::vector<Polygon> polygons(loops.size());
  for (std::size_t l = 0; l < loops.size(); ++l)
    for (const Index p : loops[l])
      polygons[l].push_back(
          {(points[p][u] - origin[u]) * scale, (points[p][v] - origin[v]) * mirrored, p});
  return polygons;
}

/// Whether q lies in the open angle that the polygon's interior fills at corner i.
bool inside_angle(const Polygon& polygon, std::size_t i, const Corner& q) {
  const std::size_t n = polygon.size();
  const Corner &a = polygon[before(i, n)], &b = polygon[i], &c = polygon[after(i, n)];
  const bool left_of_in = turn(a, b, q) > 0, left_of_out = turn(b, c, q) > 0;
  return turn(a, b, c) >= 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

/// Whether segment pq meets edge ab elsewhere than at a common end.
bool blocks(const Corner& p, const Corner& q, const Corner& a, const Corner& b) {
  const auto is_end = [&](const Corner& c) { return same_place(c, p) || same_place(c, q); };
  const Real pa = turn(p, q, a), pb = turn(p, q, b);
  const auto inside = [&](const Corner& c, Real side) {
    return std::abs(side) <= flat && !is_end(c) &&
           (c.x - p.x) * (c.x - q.x) + (c.y - p.y) * (c.y - q.y) < 0;
  };
  if (inside(a, pa) || inside(b, pb)) return true;
  if (is_end(a) || is_end(b)) return false;
  return pa * pb < 0 && turn(a, b, p) * turn(a, b, q) < 0;
}

bool any_edge_blocks(const Polygon& polygon, const Corner& p, const Corner& q) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (blocks(p, q, polygon[i], polygon[after(i, polygon.size())])) return true;
  return false;
}

/// The nearest corner of the polygon that corner h of a hole sees.
std::size_t bridge_end(const Polygon& polygon, std::span<const Polygon> holes, const Corner& h) {
  std::vector<std::size_t> order(polygon.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return distance2(polygon[a], h) < distance2(polygon[b], h);
  });
  for (const std::size_t i : order) {
    if (!same_place(polygon[i], h) && !inside_angle(polygon, i, h)) continue;
    if (any_edge_blocks(polygon, h, polygon[i])) continue;
    if (std::none_of(holes.begin(), holes.end(),
                     [&](const Polygon& hole) { return any_edge_blocks(hole, h, polygon[i]); }))
      return i;
  }
  return order.front();
}

/// Makes a hole part of the boundary through a bridge: … i, h, around the hole, h, i, …
void join_hole(Polygon& polygon, std::span<const Polygon> holes) {
  const Polygon& hole = holes.front();
  const auto h = std::max_element(hole.begin(), hole.end(),
                                  [](const Corner& a, const Corner& b) { return a.x < b.x; });
  const std::size_t i = bridge_end(polygon, holes, *h);
  Polygon inserted(h, hole.end());
  inserted.insert(inserted.end(), hole.begin(), h + 1);
  inserted.push_back(polygon[i]);
  polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, inserted.begin(),
                 inserted.end());
}

/// The same for a hole that touches the boundary: … i, around the hole, i, …  Whether it does.
bool join_touching_hole(Polygon& polygon, const Polygon& hole) {
  const std::size_t n = hole.size();
  for (std::size_t h = 0; h < n; ++h)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (!same_place(hole[h], polygon[i]) || !inside_angle(polygon, i, hole[after(h, n)]))
        continue;
      Polygon inserted(hole.begin() + static_cast<std::ptrdiff_t>(h) + 1, hole.end());
      inserted.insert(inserted.end(), hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(h));
      inserted.push_back(polygon[i]);
      polygon.insert(polygon.begin() + static_cast<std::ptrdiff_t>(i) + 1, inserted.begin(),
                     inserted.end());
      return true;
    }
  return false;
}

/// How strictly a corner is taken for an ear: a later value only if no corner is one by the
/// earlier.
enum class Strictness { closed, open, any };

bool is_ear(const Polygon& polygon, std::size_t i, Strictness strictness) {
  const std::size_t n = polygon.size();
  const Corner &a = polygon[before(i, n)], &b = polygon[i], &c = polygon[after(i, n)];
  if (turn(a, b, c) <= flat) return false;
  if (strictness == Strictness::any) return true;
  const Real margin = strictness == Strictness::closed ? -flat : flat;
  return std::none_of(polygon.begin(), polygon.end(), [&](const Corner& q) {
    return !same_place(q, a) && !same_place(q, b) && !same_place(q, c) && turn(a, b, q) > margin &&
           turn(b, c, q) > margin && turn(c, a, q) > margin;
  });
}

/// The first ear from `start` on, or n.
std::size_t find_ear(const Polygon& polygon, std::size_t start, Strictness strictness) {
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k)
    if (const std::size_t i = (start + k) % n; is_ear(polygon, i, strictness)) return i;
  return n;
}

std::vector<std::array<Index, 3>> clip_ears(Polygon polygon) {
  std::vector<std::array<Index, 3>> triangles;
  std::size_t start = 0;
  while (polygon.size() > 2) {
    const std::size_t n = polygon.size();
    std::size_t ear = n;
    for (const auto strictness : {Strictness::closed, Strictness::open, Strictness::any})
      if (ear == n) ear = find_ear(polygon, start, strictness);
    if (ear == n) break;  // what is left has no area
    triangles.push_back(
        {polygon[before(ear, n)].point, polygon[ear].point, polygon[after(ear, n)].point});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
    start = after(ear, n) % polygon.size();  // not the same corner again: fans make slivers
  }
  return triangles;
}

}  // namespace

bool is_convex(Loop loop, const std::vector<Vec3>& points, const Vec3& normal) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& corner = points[loop[i]];
    const Vec3 in = corner - points[loop[before(i, n)]], out = points[loop[after(i, n)]] - corner;
    const Vec3 turned = cross(in, out);
    if (dot(turned, normal) < -1e-9 * norm(in) * norm(out)) return false;
    if (dot(in, out) < 0 && dot(turned, normal) <= 0) return false;  // turns back on itself
  }
  return true;
}

std::vector<std::array<Index, 3>> triangulate(std::span<const Loop> loops,
                                              const std::vector<Vec3>& points, const Vec3& normal) {
  std::vector<Polygon> polygons = project(loops, points, normal);
  const auto rightmost = [](const Polygon& polygon) {
    return std::max_element(polygon.begin(), polygon.end(),
                            [](const Corner& a, const Corner& b) { return a.x < b.x; })
        ->x;
  };
  // From right to left: then the rightmost corner of each hole sees a corner of what is joined
  // already. Those that touch it come first: no place is left where the boundary meets itself
  // without being joined there.
  Polygon outer = std::move(polygons.front());
  polygons.erase(polygons.begin());
  std::stable_sort(polygons.begin(), polygons.end(),
                   [&](const Polygon& a, const Polygon& b) { return rightmost(a) > rightmost(b); });
  while (!polygons.empty()) {
    const auto touching = std::find_if(polygons.begin(), polygons.end(), [&](const Polygon& hole) {
      return join_touching_hole(outer, hole);
    });
    if (touching == polygons.end()) join_hole(outer, polygons);
    polygons.erase(touching == polygons.end() ? polygons.begin() : touching);
  }
  return clip_ears(std::move(outer));
}

}  // namespace rockfold
