// Frustums and cylinders: a convex base and a convex top with planar sides between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "host/exact/orientation.hpp"
#include "host/refuse.hpp"
#include "host/shapes/exact_vector_exact.hpp"
#include "host/shapes/families_exact.hpp"
#include "host/shapes/section_frame.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Ten times what the reader of models allows points to lie off a plane, relative to the shape's size.
constexpr Real flat = 1e-8;

// Through the three of four points that make the largest triangle.
ExactPlane best_plane(const std::array<Vec3, 4>& quad) {
  int apart = 0;
  Real largest = -1;
  for (int left_out = 0; left_out < 4; ++left_out) {
    const Vec3 &a = quad[(left_out + 1) % 4], &b = quad[(left_out + 2) % 4],
               &c = quad[(left_out + 3) % 4];
    const Real area = norm(cross(b - a, c - a));
    if (area > largest) largest = area, apart = left_out;
  }
  const ExactVec3 o = exact(quad[(apart + 1) % 4]);
  return plane_along(o, exact(quad[(apart + 2) % 4]) - o, exact(quad[(apart + 3) % 4]) - o);
}

// Every corner lies on the inner side of every plane, and those of a face on its plane, to rounding.
void check_convex(const FrustumShape& frustum, const ConvexPart& part, const Place& place) {
  const auto n = static_cast<Index>(frustum.base.size());
  const Vec3 origin = frustum.base[0];
  Real size = 0, far = 0;
  for (const auto* ring : {&frustum.base, &frustum.top})
    for (const Vec3& p : *ring) {
      size = std::max(size, norm(p - origin));
      far = std::max(far, norm(p));
    }
  const Real off = flat * size + 1e-15 * far;
  for (const FacePlane& f : part.faces) {
    Vec3 normal;
    for (int d = 0; d < 3; ++d) normal[d] = CGAL::to_double(f.plane.n[d]);
    const Real length = (f.inside_above ? 1 : -1) * norm(normal);
    const Real offset = CGAL::to_double(Exact(f.plane.d - dot(f.plane.n, exact(origin))));
    for (const auto* ring : {&frustum.base, &frustum.top})
      for (Index i = 0; i < n; ++i) {
        const Real inside = (dot(normal, (*ring)[i] - origin) - offset) / length;
        const bool of_face = f.face < n ? i == f.face || i == (f.face + 1) % n
                                        : (f.face == n) == (ring == &frustum.base);
        if (of_face ? std::abs(inside) <= off : inside >= -off) continue;
        refuse(place, place.key,
               fmt::format("base and top make no convex solid with planar sides: point {} of the "
                           "{} lies {:.3g} m {} face {}",
                           i + 1, ring == &frustum.base ? "base" : "top", std::abs(inside),
                           of_face ? "off the plane of" : "outside", f.face));
      }
  }
}

}  // namespace

ShapeGeometry frustum_geometry(const FrustumShape& frustum, const Place& place) {
  const auto& [base, top] = frustum;
  const std::size_t n = base.size();
  if (n < 3 || top.size() != n)
    refuse(place, place.key, "base and top need equally many points, at least 3");
  ShapeGeometry geometry;
  geometry.corners = base;
  geometry.corners.insert(geometry.corners.end(), top.begin(), top.end());
  auto& faces = geometry.parts.emplace_back().faces;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    faces.push_back({best_plane({base[i], base[j], top[j], top[i]}), false, none});
  }
  faces.push_back({plane_of_polygon(base), false, none});
  faces.push_back({plane_of_polygon(top), false, none});
  ExactVec3 middle{0, 0, 0};
  for (const Vec3& p : geometry.corners) middle = middle + exact(p);
  middle = Exact(1) / Exact(static_cast<int>(2 * n)) * middle;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const int side = side_of(faces[f].plane, middle);
    if (side == 0)
      refuse(place, place.key,
             fmt::format("face {} of the frustum has no area or runs through the middle of its "
                         "points; the top's points must stand over the base's, in the same order",
                         f));
    faces[f].inside_above = side > 0;
    faces[f].face = static_cast<Index>(f);
  }
  check_convex(frustum, geometry.parts.front(), place);
  return geometry;
}

ShapeGeometry cylinder_geometry(const CylinderShape& cylinder, const Place& place) {
  const ExactVec3 start = exact(cylinder.axis[0]), end = exact(cylinder.axis[1]);
  const ExactVec3 along = end - start;
  if (is_zero(along) || !(cylinder.radius > 0) || cylinder.sides < 3)
    refuse(place, place.key, "a cylinder needs an axis, a radius over 0 and at least 3 sides");
  const SectionFrame frame = section_frame(cylinder.axis[1] - cylinder.axis[0]);
  ShapeGeometry geometry;
  std::vector<ExactVec3> section;  // about the axis
  for (const Vec3& p : cylinder.axis)
    for (Index i = 0; i < cylinder.sides; ++i) {
      const auto [sine, cosine] = sine_cosine_degrees(360.0 * i / cylinder.sides);
      const Vec3 offset =
          (cylinder.radius * cosine) * frame.right + (cylinder.radius * sine) * frame.up;
      section.push_back(exact(offset));
      geometry.corners.push_back(p + offset);
    }
  auto& faces = geometry.parts.emplace_back().faces;
  for (Index i = 0; i < cylinder.sides; ++i) {
    const ExactVec3 &a = section[i], &b = section[i + 1 < cylinder.sides ? i + 1 : 0];
    FacePlane face{plane_along(start + a, b - a, along), false, i};
    face.inside_above = side_of(face.plane, start) > 0;
    faces.push_back(std::move(face));
  }
  faces.push_back({{along, dot(along, start)}, true, cylinder.sides});
  faces.push_back({{along, dot(along, end)}, false, cylinder.sides + 1});
  return geometry;
}

}  // namespace rockfold
