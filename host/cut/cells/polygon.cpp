#include "host/cut/cells/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/vector.hpp"

namespace rockfold {

Polygon face_polygon(const CellView& cell, const ConvexCell::Face& face) {
  Polygon polygon;
  polygon.plane = plane_of(face.inside);
  const auto n = face.count;
  polygon.corner.reserve(n);
  polygon.edge.reserve(n);
  for (std::int32_t k = 0; k < n; ++k) {
    // Above its plane a cell's outward normal points down: the loop seen from above is the reversed one, where the edge
    // after corner j is the one before it in the face's own sense.
    const std::int32_t i = is_above(face.inside) ? n - 1 - k : k;
    const std::int32_t e = is_above(face.inside) ? (i + n - 1) % n : i;
    polygon.corner.push_back(cell.vertices[cell.corners[face.begin + i].vertex]);
    polygon.edge.push_back(cell.corners[face.begin + e].neighbour);
  }
  return polygon;
}

Real face_area(const CellView& cell, const ConvexCell::Face& face) {
  const auto* corner = &cell.corners[face.begin];
  const Vec3& o = cell.vertices[corner[0].vertex].x;
  Real area2 = 0;
  for (std::int32_t k = 1; k + 1 < face.count; ++k)
    area2 += norm(
        cross(cell.vertices[corner[k].vertex].x - o, cell.vertices[corner[k + 1].vertex].x - o));
  return area2 / 2;
}

PolygonMoments polygon_moments(const Polygon& polygon) {
  PolygonMoments m;
  if (polygon.empty()) return m;
  const Vec3 o = polygon.corner.front().x;
  Vec3 first{};
  for (std::size_t k = 1; k + 1 < polygon.corner.size(); ++k) {
    const Vec3 a = polygon.corner[k].x - o, b = polygon.corner[k + 1].x - o;
    const Real area = norm(cross(a, b)) / 2;
    m.area += area;
    first += (area / 3) * (a + b);
  }
  m.centroid = m.area > 0 ? o + (1 / m.area) * first : o;
  return m;
}

Real width_in_plane(std::span<const Vec3> corner, const Vec3& normal) {
  const std::size_t n = corner.size();
  if (n < 3) return 0;
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 along = corner[(k + 1) % n] - corner[k];
    const Vec3 across = cross(normal, along);
    const Real length = norm(across);
    if (!(length > 0)) continue;
    Real most = 0;
    for (const Vec3& x : corner) most = std::max(most, std::abs(dot(across, x - corner[k])));
    least = std::min(least, most / length);
  }
  return std::isfinite(least) ? least : 0;
}

void PolygonClipper::write_part(const Polygon& polygon, HalfSpaceId h, Polygon& part) const {
  part.plane = polygon.plane;
  part.corner.clear();
  part.edge.clear();
  const int wanted = is_above(h) ? 1 : -1;
  const std::size_t n = polygon.corner.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = k + 1 == n ? 0 : k + 1;
    const int su = side_[k] * wanted, sv = side_[next] * wanted;
    const auto cut = [&] {
      return planes_.vertex(polygon.plane, plane_of(polygon.edge[k]), plane_of(h));
    };
    if (su > 0 || (su == 0 && sv > 0)) {
      part.corner.push_back(polygon.corner[k]);
      if (su == 0) part.corner.back().note(plane_of(h));
      part.edge.push_back(polygon.edge[k]);
      if (sv < 0) {
        part.corner.push_back(cut());
        part.edge.push_back(h);
      }
    } else if (su == 0) {
      part.corner.push_back(polygon.corner[k]);
      part.corner.back().note(plane_of(h));
      part.edge.push_back(h);
    } else if (sv > 0) {
      part.corner.push_back(cut());
      part.edge.push_back(polygon.edge[k]);
    }
  }
}

PolygonClipper::Extent PolygonClipper::classify(const Polygon& polygon, HalfSpaceId h) {
  side_.resize(polygon.corner.size());
  bool above = false, below = false;
  for (std::size_t k = 0; k < polygon.corner.size(); ++k) {
    side_[k] = static_cast<std::int8_t>(planes_.side(polygon.corner[k], plane_of(h)));
    above = above || side_[k] > 0;
    below = below || side_[k] < 0;
  }
  return is_above(h) ? Extent{above, below} : Extent{below, above};
}

void PolygonClipper::split(const Polygon& polygon, HalfSpaceId h, Polygon& inside,
                           Polygon* outside) {
  const Extent extent = classify(polygon, h);
  inside.corner.clear();
  inside.edge.clear();
  inside.plane = polygon.plane;
  if (outside) {
    outside->corner.clear();
    outside->edge.clear();
    outside->plane = polygon.plane;
    if (extent.outside && !extent.inside) *outside = polygon;
    if (extent.outside && extent.inside) write_part(polygon, h ^ 1, *outside);
  }
  if (extent.inside && !extent.outside) inside = polygon;
  if (extent.inside && extent.outside) write_part(polygon, h, inside);
}

PolygonClipper::Share PolygonClipper::share(const Polygon& polygon,
                                            std::span<const HalfSpaceId> inside) {
  bool all = true;
  for (const HalfSpaceId h : inside) {
    bool any_inside = false;
    for (const Vertex& v : polygon.corner) {
      const int side = planes_.side(v, plane_of(h)) * (is_above(h) ? 1 : -1);
      any_inside = any_inside || side > 0;
      all = all && side >= 0;
    }
    if (!any_inside) return Share::nothing;
  }
  return all ? Share::all : Share::some;
}

// Nothing is copied before something is cut off: most pairs of polygons have nothing in common.
Polygon PolygonClipper::intersection(const Polygon& a, std::span<const HalfSpaceId> inside) {
  Polygon result, part;
  const Polygon* now = &a;
  for (const HalfSpaceId h : inside) {
    const Extent extent = classify(*now, h);
    if (!extent.inside) return {};
    if (!extent.outside) continue;
    write_part(*now, h, part);
    std::swap(result, part);
    now = &result;
    if (result.empty()) return {};
  }
  return now == &a ? a : result;
}

void PolygonClipper::subtract(const Polygon& a, std::span<const HalfSpaceId> inside,
                              std::vector<Polygon>& rest) {
  const std::size_t before = rest.size();
  Polygon kept, part;
  const Polygon* now = &a;
  for (const HalfSpaceId h : inside) {
    const Extent extent = classify(*now, h);
    if (extent.inside && !extent.outside) continue;
    if (extent.inside) {
      write_part(*now, h ^ 1, part);
      if (!part.empty()) rest.push_back(part);
      write_part(*now, h, part);
      std::swap(kept, part);
      now = &kept;
    }
    if (!extent.inside || kept.empty()) {  // nothing is taken away: `a` stays whole
      rest.resize(before);
      rest.push_back(a);
      return;
    }
  }
}

}  // namespace rockfold
