#include "host/shapes/shape_geometry_exact.hpp"

#include <algorithm>

#include "host/cut/convex_cell.hpp"
#include "host/exact/orientation.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real unbounded_reach = 1e12;  // m: coordinates are limited to 1e9 when the model is read

// A solid in the order of face_names(): the exact plane of each face and the side that holds the solid.
std::vector<FacePlane> face_planes(const BoxShape& box) {
  std::vector<FacePlane> faces;
  for (int d = 0; d < 3; ++d) {
    Vec3 n{};
    n[d] = 1;
    faces.push_back({plane_through(n, box.min), true});
    faces.push_back({plane_through(n, box.max), false});
  }
  return faces;
}

std::vector<FacePlane> face_planes(const HalfspacesShape& shape) {
  std::vector<FacePlane> faces;
  for (const HalfSpace& h : shape.planes)
    faces.push_back({plane_through(normal_of(h.plane.orientation), h.plane.point), h.keep_above});
  return faces;
}

bool above(const ExactPlane& plane, const ExactVec3& x) {
  return dot(plane.n, x) > plane.d;
}

std::vector<FacePlane> face_planes(const PrismShape& prism) {
  const std::size_t n = prism.base.size();
  const ExactVec3 e = exact(prism.extrude);
  const auto shifted = [](const ExactVec3& a, const ExactVec3& b) {
    return ExactVec3{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  };
  const auto difference = [](const ExactVec3& a, const ExactVec3& b) {
    return ExactVec3{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  // The corner that makes the largest triangle with corner 0 defines the base plane best.
  std::size_t widest = 1;
  Real largest = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Real area = norm(cross(prism.base[i] - prism.base[0], prism.base[i + 1] - prism.base[0]));
    if (area > largest) largest = area, widest = i;
  }
  ExactVec3 middle{0, 0, 0};
  for (const Vec3& p : prism.base) middle = shifted(middle, exact(p));
  for (int d = 0; d < 3; ++d) middle[d] = middle[d] / Exact(static_cast<int>(n)) + e[d] / 2;

  std::vector<FacePlane> faces;
  for (std::size_t i = 0; i < n; ++i) {
    const ExactVec3 a = exact(prism.base[i]), b = exact(prism.base[(i + 1) % n]);
    faces.push_back({plane_along(a, difference(b, a), e), false});
  }
  const ExactVec3 o = exact(prism.base[0]);
  const ExactVec3 u = difference(exact(prism.base[widest]), o);
  const ExactVec3 v = difference(exact(prism.base[widest + 1]), o);
  faces.push_back({plane_along(o, u, v), false});
  faces.push_back({plane_along(shifted(o, e), u, v), false});
  for (FacePlane& f : faces) f.inside_above = above(f.plane, middle);
  return faces;
}

std::vector<Vec3> corners_of(const BoxShape& box, const ConvexPart&, bool, const Place&) {
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c)
    corners.push_back({(c & 1 ? box.max : box.min)[0], (c & 2 ? box.max : box.min)[1],
                       (c & 4 ? box.max : box.min)[2]});
  return corners;
}

std::vector<Vec3> corners_of(const PrismShape& prism, const ConvexPart&, bool, const Place&) {
  std::vector<Vec3> corners = prism.base;
  for (const Vec3& p : prism.base) corners.push_back(p + prism.extrude);
  return corners;
}

// The corners of an intersection of half-spaces; none if it is unbounded and need not be bounded.
std::vector<Vec3> corners_of(const HalfspacesShape& shape, const ConvexPart& part, bool bounded,
                             const Place& place) {
  const auto& planes = shape.planes;
  Vec3 centre{};
  for (const HalfSpace& h : planes)
    centre += (1.0 / static_cast<Real>(planes.size())) * h.plane.point;
  Real size = 0;
  for (const HalfSpace& h : planes) size = std::max(size, norm(h.plane.point - centre));
  PlaneTable table(centre, size > 0 ? size : 1);
  std::vector<HalfSpaceId> inside;
  for (const FacePlane& f : part.faces)
    inside.push_back(half_space(table.add(f.plane), f.inside_above));
  const ConvexCell cell = clip_cube(table, unbounded_reach, inside);
  if (cell.faces.empty()) {
    if (!bounded) return {};
    refuse(place, place.key, "the half-spaces have no point in common; found nothing to add");
  }
  std::vector<Vec3> corners;
  for (const Vertex& v : cell.vertices) {
    if (norm(v.x) > unbounded_reach / 10) {
      if (!bounded) return {};
      refuse(place, place.key,
             "the half-spaces enclose no bounded volume; a solid that is added needs planes on all "
             "sides");
    }
    corners.push_back(v.x + centre);
  }
  return corners;
}

struct Builder {
  bool bounded;
  const Place& place;

  template <class S>
  ShapeGeometry operator()(const S& shape) const {
    if constexpr (requires { face_planes(shape); }) {
      ShapeGeometry geometry;
      geometry.parts.push_back({face_planes(shape)});
      auto& faces = geometry.parts.front().faces;
      for (std::size_t f = 0; f < faces.size(); ++f) faces[f].face = static_cast<Index>(f);
      geometry.corners = corners_of(shape, geometry.parts.front(), bounded, place);
      return geometry;
    } else {
      refuse(place, place.key, "this shape is not supported yet");
    }
  }
};

}  // namespace

ShapeGeometry shape_geometry(const Shape& shape, bool bounded, const Place& place) {
  return std::visit(Builder{bounded, place}, shape);
}

}  // namespace rockfold
