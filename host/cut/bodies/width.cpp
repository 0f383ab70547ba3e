#include "host/cut/bodies/width.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real parallel_sine = 1e-8;  // decision 5, rule 4

// m: the largest distance of n corners from the plane of the edge from corner k on. Far ones first: from `enough` on none counts.
template <class Corner>
Real extent_from_edge(std::size_t n, const Corner& corner, std::size_t k, Index own, Index other,
                      const PlaneTable& planes, Real enough) {
  const Vec3 &a = corner(k), &b = corner(k + 1 < n ? k + 1 : 0);
  const Vec3& normal = planes.normal(own);
  Vec3 across = planes.normal(other);
  Real offset = planes.offset(other);
  if (norm(cross(normal, across)) < parallel_sine) {
    across = cross(normal, b - a);
    const Real length = norm(across);
    if (!(length > 0)) return std::numeric_limits<Real>::infinity();
    across = (1 / length) * across;
    offset = dot(across, a);
  }
  Real most = 0;
  for (std::size_t i = 0; i < n && most < enough; ++i)
    most = std::max(most, std::abs(dot(across, corner((k + n / 2 + i) % n)) - offset));
  return most;
}

template <class Corner, class OtherPlane>
Real least_extent(std::size_t n, Index own, const Corner& corner, const OtherPlane& other,
                  const PlaneTable& planes, Real enough) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t k = 0; k < n; ++k)
    least = std::min(least, extent_from_edge(n, corner, k, own, other(k), planes, enough));
  return std::isfinite(least) ? least : 0;
}

}  // namespace

CellWidth cell_width(const CellView& cell, const PlaneTable& planes) {
  CellWidth least{std::numeric_limits<Real>::infinity(), 0};
  for (std::size_t f = 0; f < cell.faces.size(); ++f) {
    const Index plane = plane_of(cell.faces[f].inside);
    Real most = 0;
    for (const Vertex& v : cell.vertices)
      most = std::max(most, std::abs(planes.distance(v, plane)));
    if (most < least.width) least = {most, f};
  }
  return least;
}

// A convex body lies between two planes as far apart as it is wide, so that V ≤ width · A/2. Of needles, doubles give volumes of
// their length cubed times ε, and areas likewise.
CellMeasure measure_cell(const CellView& cell, const PlaneTable& planes) {
  constexpr Real rounding = 100 * std::numeric_limits<Real>::epsilon();
  const Real tolerance = planes.width_tolerance();
  const RoundedMeasure rounded = measure_in_doubles(cell);
  const Real length = 2 * bounding_ball(cell).radius;
  const Real volume = rounded.moments.volume - rounding * length * length * length;
  const Real area = rounded.area + rounding * length * length;
  const bool wide = 2 * volume > doubt_factor * tolerance * area;
  const Real width = wide ? std::numeric_limits<Real>::infinity() : cell_width(cell, planes).width;
  const bool in_doubles = width < tolerance || !rounded.loses_digits;
  return {in_doubles ? rounded.moments : cell_moments(cell, planes), width};
}

Real polygon_width(const Polygon& polygon, const PlaneTable& planes, Real enough) {
  return least_extent(
      polygon.corner.size(), polygon.plane,
      [&](std::size_t k) -> const Vec3& { return polygon.corner[k].x; },
      [&](std::size_t k) { return plane_of(polygon.edge[k]); }, planes, enough);
}

Real face_width(const CellView& cell, const ConvexCell::Face& face, const PlaneTable& planes,
                Real enough) {
  const auto* corner = &cell.corners[face.begin];
  return least_extent(
      static_cast<std::size_t>(face.count), plane_of(face.inside),
      [&](std::size_t k) -> const Vec3& { return cell.vertices[corner[k].vertex].x; },
      [&](std::size_t k) { return plane_of(corner[k].neighbour); }, planes, enough);
}

}  // namespace rockfold
