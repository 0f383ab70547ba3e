// Prisms and pyramids: a base, and lines from its corners that run along one vector or to one point.
#include <string>

#include "host/refuse.hpp"
#include "host/shapes/convex_pieces_exact.hpp"
#include "host/shapes/exact_vector_exact.hpp"
#include "host/shapes/families_exact.hpp"
#include "host/shapes/swept_sides_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

int largest_component(const ExactVec3& a) {
  int k = 0;
  for (int d = 1; d < 3; ++d)
    if (abs(a[d]) > abs(a[k])) k = d;
  return k;
}

std::array<Exact, 2> without(const ExactVec3& a, int k) {
  return {a[(k + 1) % 3], a[(k + 2) % 3]};
}

// The base as the lines through its corners meet a plane: the question on which side of a plane along two lines a third
// one lies is the same there, exactly.
struct Base : SweptPolygon {
  ExactPolygon section;
};

std::vector<ConvexPart> parts_of(const Base& base, const std::vector<FacePlane>& ends,
                                 const std::string& seen, const Place& place) {
  const auto pieces = convex_pieces(base.section);
  if (pieces.empty())
    refuse(place, place.key,
           "the base's edges cross or touch each other" + seen +
               "; a simple polygon, once around an area, would be right");
  std::vector<ConvexPart> parts;
  for (const ConvexPiece& piece : pieces) {
    ConvexPart& part = parts.emplace_back(swept_sides(base, piece));
    part.faces.insert(part.faces.end(), ends.begin(), ends.end());
  }
  return parts;
}

ExactPlane base_plane(const std::vector<Vec3>& base, const Place& place) {
  if (base.size() < 3) refuse(place, place.key, "the base has fewer than 3 points");
  ExactPlane plane = plane_of_polygon(base);
  if (is_zero(plane.n))
    refuse(place, place.key, "the base encloses no area: its points are collinear");
  return plane;
}

}  // namespace

ShapeGeometry prism_geometry(const PrismShape& prism, const Place& place) {
  const ExactPlane bottom = base_plane(prism.base, place);
  const ExactVec3 e = exact(prism.extrude);
  const int along = CGAL::sign(dot(bottom.n, e));
  if (along == 0) refuse(place, place.key, "extrude lies in the base's plane: there is no volume");
  const int k = largest_component(e);
  Base base;
  for (const Vec3& p : prism.base) {
    const ExactVec3 x = exact(p);
    base.corner.push_back(x);
    base.line.push_back(e);
    base.section.push_back(without(x - Exact(x[k] / e[k]) * e, k));
  }
  const auto n = static_cast<Index>(prism.base.size());
  const ExactPlane top{bottom.n, bottom.d + dot(bottom.n, e)};
  ShapeGeometry geometry;
  geometry.parts = parts_of(base, {{bottom, along > 0, n}, {top, along < 0, n + 1}},
                            ", seen along extrude", place);
  geometry.corners = prism.base;
  for (const Vec3& p : prism.base) geometry.corners.push_back(p + prism.extrude);
  return geometry;
}

ShapeGeometry pyramid_geometry(const PyramidShape& pyramid, const Place& place) {
  const ExactPlane bottom = base_plane(pyramid.base, place);
  const ExactVec3 apex = exact(pyramid.apex);
  const int above = side_of(bottom, apex);
  const int k = largest_component(bottom.n);
  Base base;
  for (const Vec3& p : pyramid.base) {
    const ExactVec3 x = exact(p), line = x - apex;
    const Exact fall = dot(bottom.n, line);
    if (above == 0 || CGAL::sign(fall) != -above)
      refuse(place, place.key, "the apex lies in the base's plane: there is no volume");
    base.corner.push_back(x);
    base.line.push_back(line);
    base.section.push_back(without(Exact(1 / fall) * line, k));
  }
  const auto n = static_cast<Index>(pyramid.base.size());
  ShapeGeometry geometry;
  geometry.parts = parts_of(base, {{bottom, above > 0, n}}, ", seen from the apex", place);
  geometry.corners = pyramid.base;
  geometry.corners.push_back(pyramid.apex);
  return geometry;
}

}  // namespace rockfold
