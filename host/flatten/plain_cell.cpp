#include "host/flatten/plain_cell.hpp"

#include <cmath>
#include <numbers>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// A convex polygon is at least as wide as its area over its circumference, which is at most that of the circle around it.
bool is_narrow(const CellView& cell, const ConvexCell::Face& face, Real area, Real diameter,
               Real tolerance) {
  for (std::int32_t k = 0; k < face.count; ++k) {
    const Vec3& a = cell.vertices[cell.corners[face.begin + k].vertex].x;
    const Vec3& b =
        cell.vertices[cell.corners[face.begin + (k + 1 < face.count ? k + 1 : 0)].vertex].x;
    if (dot(b - a, b - a) < 4 * tolerance * tolerance) return true;
  }
  return area < 2 * tolerance * std::numbers::pi * diameter;
}

// Whether two faces may be shown as one: one of them lies on the other's plane, to the tolerance.
bool nearly_coplanar(const CellView& cell, std::size_t f, std::size_t g, const PlaneTable& planes) {
  const HalfSpaceId a = cell.faces[f].inside, b = cell.faces[g].inside;
  const Real cosine = dot(planes.normal(plane_of(a)), planes.normal(plane_of(b)));
  if ((is_above(a) == is_above(b)) != (cosine > 0)) return false;
  const auto lies_on = [&](const ConvexCell::Face& face, Index plane) {
    for (std::int32_t k = 0; k < face.count; ++k) {
      const Vertex& v = cell.vertices[cell.corners[face.begin + k].vertex];
      if (!(std::abs(planes.distance(v, plane)) < planes.width_tolerance())) return false;
    }
    return true;
  };
  return lies_on(cell.faces[f], plane_of(b)) || lies_on(cell.faces[g], plane_of(a));
}

}  // namespace

bool is_plain_cell(const Complex& complex, Index cells, const std::vector<BoundaryArea>& areas,
                   CellFaces& workspace) {
  if (cells != 1 || areas.empty()) return false;
  const CellView cell = complex.cells[areas.front().cell];
  auto& [origin, area] = workspace;
  origin.assign(cell.faces.size(), none);
  area.assign(cell.faces.size(), 0);
  for (const BoundaryArea& a : areas) {
    if (a.origin == none) return false;
    if (origin[a.face] != none && origin[a.face] != a.origin) return false;
    origin[a.face] = a.origin;
    area[a.face] += a.area;
  }
  const Real diameter = 2 * bounding_ball(cell).radius,
             tolerance = complex.planes.width_tolerance();
  for (std::size_t f = 0; f < origin.size(); ++f) {
    if (origin[f] == none || is_narrow(cell, cell.faces[f], area[f], diameter, tolerance))
      return false;
    for (std::size_t g = 0; g < f; ++g) {
      const bool one = origin[f] == origin[g] ||
                       complex.origins[origin[f]].is_one_face_with(complex.origins[origin[g]]);
      if (one && nearly_coplanar(cell, f, g, complex.planes)) return false;
    }
  }
  return true;
}

}  // namespace rockfold
