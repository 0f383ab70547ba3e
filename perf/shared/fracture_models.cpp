#include "perf/shared/fracture_models.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

Solid solid_of(Shape shape) {
  Solid rock;
  rock.name = "rock";
  rock.continues.assign(face_names(shape).size(), false);
  rock.shape = std::move(shape);
  return rock;
}

// In [0, 1); the same with every library, unlike the standard's distributions.
Real uniform(std::mt19937_64& random) {
  return static_cast<Real>(random() >> 11) * 0x1p-53;
}

}  // namespace

Model disc_network(Index count, Real least, Real most) {
  constexpr Real edge = 100;
  std::mt19937_64 random(7);
  Model model;
  model.solids.push_back(solid_of(BoxShape{{0, 0, 0}, {edge, edge, edge}}));
  for (Index i = 0; i < count; ++i) {
    const Real z = uniform(random), turn = 2 * std::numbers::pi * uniform(random);
    const Real r = std::sqrt(1 - z * z);
    Joint joint;
    joint.name = "disc";
    joint.plane.orientation = Vec3{r * std::cos(turn), r * std::sin(turn), z};
    for (Real& x : joint.plane.point) x = edge * uniform(random);
    joint.radius = least + (most - least) * uniform(random);
    model.joints.push_back(joint);
  }
  return model;
}

Model hilly_terrain(Index posts) {
  constexpr Real apart = 10;  // m
  auto ground = std::make_shared<TriangleSurface>();
  std::mt19937_64 random(7);
  for (Index j = 0; j < posts; ++j)
    for (Index i = 0; i < posts; ++i) {
      const Real x = apart * i, y = apart * j;
      const Real z = 300 + 80 * std::sin(x / 310) * std::cos(y / 420) +
                     25 * std::sin(x / 71 + y / 113) + 3 * uniform(random);
      ground->vertices.push_back({x, y, z});
    }
  for (Index j = 0; j + 1 < posts; ++j)
    for (Index i = 0; i + 1 < posts; ++i) {
      const Index a = j * posts + i, b = a + 1, c = a + posts, d = c + 1;
      ground->triangles.push_back({a, b, d});
      ground->triangles.push_back({a, d, c});
    }
  TerrainShape terrain;
  terrain.ground = std::move(ground);
  Model model;
  model.solids.push_back(solid_of(std::move(terrain)));
  return model;
}

Model bumpy_ball(Index rings) {
  const Index around = 2 * rings;
  auto ball = std::make_shared<TriangleSurface>();
  std::mt19937_64 random(7);
  const auto point = [&random](Real polar, Real turn) {
    const Real r = 10 + 0.5 * std::sin(5 * polar) * std::sin(7 * turn) + 0.02 * uniform(random);
    return r * Vec3{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                    std::cos(polar)};
  };
  for (Index i = 1; i < rings; ++i)
    for (Index k = 0; k < around; ++k)
      ball->vertices.push_back(
          point(std::numbers::pi * i / rings, 2 * std::numbers::pi * k / around));
  const auto north = static_cast<Index>(ball->vertices.size()), south = north + 1;
  ball->vertices.push_back(point(0, 0));
  ball->vertices.push_back(point(std::numbers::pi, 0));
  for (Index k = 0; k < around; ++k) {
    const Index next = (k + 1) % around, last = (rings - 2) * around;
    ball->triangles.push_back({north, k, next});
    for (Index i = 0; i + 2 < rings; ++i) {
      const Index a = i * around;
      ball->triangles.push_back({a + k, a + around + k, a + around + next});
      ball->triangles.push_back({a + k, a + around + next, a + next});
    }
    ball->triangles.push_back({last + k, south, last + next});
  }
  MeshShape mesh;
  mesh.surface = std::move(ball);
  Model model;
  model.solids.push_back(solid_of(std::move(mesh)));
  return model;
}

}  // namespace rockfold
