// Planes as meshes that are flat but for noise.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "src/base/vector.hpp"
#include "src/model/model.hpp"

namespace rockfold::test {

/// A square on the plane through `centre`, of `cells` × `cells` squares of two triangles each. Its vertices are off the plane by up
/// to half of noise × edge to either side.
inline TriangleSurface rough_square(const Vec3& normal, const Vec3& centre, Real edge, int cells,
                                    Real noise, unsigned seed = 1) {
  std::mt19937 random(seed);
  const auto off = [&] {
    return (static_cast<Real>(random()) / 4294967296.0 - 0.5) * noise * edge;
  };
  const Vec3 e = normalized(
                 cross(std::abs(normal[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, normal)),
             f = cross(normal, e);
  TriangleSurface surface;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j)
      surface.vertices.push_back(centre + (edge * (1.0 * i / cells - 0.5)) * e +
                                 (edge * (1.0 * j / cells - 0.5)) * f + off() * normal);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Index a = i * (cells + 1) + j, b = a + cells + 1;
      surface.triangles.push_back({a, b, b + 1});
      surface.triangles.push_back({a, b + 1, a + 1});
    }
  return surface;
}

/// A joint mesh, named M1, M2, …
inline JointMesh& add_mesh(Model& model, TriangleSurface surface) {
  JointMesh mesh;
  mesh.name = "M" + std::to_string(model.joint_meshes.size() + 1);
  mesh.surface = std::make_shared<TriangleSurface>(std::move(surface));
  model.joint_meshes.push_back(std::move(mesh));
  return model.joint_meshes.back();
}

}  // namespace rockfold::test
