// Spheres, as icosahedra whose triangles are divided.
#include <array>
#include <map>
#include <numbers>
#include <utility>

#include "host/shapes/families_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Triangle = std::array<Index, 3>;

struct UnitSphere {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;  // counter-clockwise from outside
};

UnitSphere icosahedron() {
  constexpr Real phi = std::numbers::phi;
  UnitSphere sphere;
  for (int d = 0; d < 3; ++d)
    for (const Real a : {-1.0, 1.0})
      for (const Real b : {-phi, phi}) {
        Vec3 p{};
        p[(d + 1) % 3] = a;
        p[(d + 2) % 3] = b;
        sphere.vertices.push_back(p);
      }
  // Edges are 2 long, all other distances at least 2·phi: three vertices that are close to each other are a face.
  const auto near = [&](Index i, Index j) {
    return norm(sphere.vertices[i] - sphere.vertices[j]) < 2.5;
  };
  const auto n = static_cast<Index>(sphere.vertices.size());
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j)
      for (Index k = j + 1; k < n; ++k) {
        if (!near(i, j) || !near(j, k) || !near(k, i)) continue;
        const auto& v = sphere.vertices;
        const bool outward = dot(v[i], cross(v[j], v[k])) > 0;
        sphere.triangles.push_back(outward ? Triangle{i, j, k} : Triangle{i, k, j});
      }
  for (Vec3& p : sphere.vertices) p = normalized(p);
  return sphere;
}

void divide(UnitSphere& sphere) {
  std::map<std::pair<Index, Index>, Index> middle;  // of the edges
  const auto middle_of = [&](Index i, Index j) {
    const auto [found, added] =
        middle.try_emplace(std::minmax(i, j), static_cast<Index>(sphere.vertices.size()));
    if (added) sphere.vertices.push_back(normalized(sphere.vertices[i] + sphere.vertices[j]));
    return found->second;
  };
  std::vector<Triangle> smaller;
  smaller.reserve(4 * sphere.triangles.size());
  for (const auto& [a, b, c] : sphere.triangles) {
    const Index ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
    smaller.push_back({a, ab, ca});
    smaller.push_back({b, bc, ab});
    smaller.push_back({c, ca, bc});
    smaller.push_back({ab, bc, ca});
  }
  sphere.triangles = std::move(smaller);
}

}  // namespace

ShapeGeometry sphere_geometry(const SphereShape& shape) {
  UnitSphere sphere = icosahedron();
  for (Index i = 0; i < shape.subdivisions; ++i) divide(sphere);
  ShapeGeometry geometry;
  ClosedSurface& surface = geometry.surface;
  for (const Vec3& p : sphere.vertices) surface.vertices.push_back(shape.center + shape.radius * p);
  for (const Triangle& t : sphere.triangles) {
    surface.corner.insert(surface.corner.end(), t.begin(), t.end());
    surface.polygon_begin.push_back(static_cast<Index>(surface.corner.size()));
  }
  surface.face.assign(sphere.triangles.size(), 0);
  const Vec3 reach{shape.radius, shape.radius, shape.radius};
  geometry.corners = box_corners(shape.center - reach, shape.center + reach);
  return geometry;
}

}  // namespace rockfold
