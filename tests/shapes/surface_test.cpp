// Spheres, meshes and terrains: closed surfaces.
#include <chrono>

#include <gtest/gtest.h>

#include "tests/shapes/bases.hpp"
#include "tests/shapes/measure.hpp"

namespace rockfold::test {
namespace {

using Clock = std::chrono::steady_clock;

TEST(Sphere, ConvergesWithTheSquareOfItsEdges) {
  const Real ball = 4.0 / 3 * std::numbers::pi * 8;
  Real last = 0;
  for (Index n = 0; n <= 5; ++n) {
    const SphereShape shape{{100, -50, 7}, 2, n};
    const ClosedSurface surface = geometry_of(shape).surface;
    EXPECT_EQ(surface.face.size(), 20u << (2 * n));
    EXPECT_EQ(surface.vertices.size(), (10u << (2 * n)) + 2);
    EXPECT_EQ(open_edges(surface), 0u);
    for (const Vec3& p : surface.vertices) EXPECT_NEAR(norm(p - shape.center), 2, 1e-13);
    const Real lost = 1 - measure_surface(surface).volume / ball;
    EXPECT_GT(lost, 0);
    // lost = c h² (1 + O(h²)): what the ratio misses falls by four with each subdivision, too.
    if (n >= 2) {
      EXPECT_NEAR(last / lost, 4, 0.3 * std::pow(0.25, n - 2)) << n << " subdivisions";
    }
    last = lost;
  }
}

TEST(Sphere, OfNoSubdivisionIsAnIcosahedron) {
  const Measured measured = measure_surface(geometry_of(SphereShape{{1, 2, 3}, 3, 0}).surface);
  const Real edge = 3 / std::sin(2 * std::numbers::pi / 5);
  EXPECT_NEAR(measured.volume, 5 * (3 + std::sqrt(5.0)) / 12 * edge * edge * edge, 1e-12);
  EXPECT_NEAR(measured.area.at(0), 5 * std::sqrt(3.0) * edge * edge, 1e-12);
}

TEST(Mesh, IsTakenAsGiven) {
  auto triangles = std::make_shared<TriangleSurface>();
  triangles->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  triangles->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const ShapeGeometry geometry = geometry_of(MeshShape{"t.stl", triangles});
  EXPECT_EQ(geometry.surface.vertices, triangles->vertices);
  EXPECT_EQ(geometry.surface.corner, (std::vector<Index>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}));
  EXPECT_EQ(geometry.surface.polygon_begin, (std::vector<Index>{0, 3, 6, 9, 12}));
  EXPECT_EQ(geometry.surface.face, (std::vector<Index>{0, 0, 0, 0}));
  EXPECT_NEAR(measure_surface(geometry.surface).volume, 1, 1e-15);
  EXPECT_EQ(geometry.corners.size(), 8u);
  EXPECT_NE(refusal(MeshShape{"t.stl", nullptr}), "");
}

Real hill(Real x, Real y) {
  return 20 + 3 * std::sin(0.3 * x) * std::cos(0.2 * y) + 0.05 * x;
}

/// Posts 1 m apart; cells that `keep` refuses have no ground.
template <class Keep>
std::shared_ptr<TriangleSurface> grid(Index columns, Index rows, const Vec3& corner, Keep keep) {
  auto ground = std::make_shared<TriangleSurface>();
  std::vector<Index> vertex(static_cast<std::size_t>(columns) * rows, none);
  const auto post = [&](Index i, Index j) {
    Index& v = vertex[static_cast<std::size_t>(j) * columns + i];
    if (v == none) {
      v = static_cast<Index>(ground->vertices.size());
      ground->vertices.push_back({corner[0] + i, corner[1] + j, corner[2] + hill(i, j)});
    }
    return v;
  };
  for (Index j = 0; j + 1 < rows; ++j)
    for (Index i = 0; i + 1 < columns; ++i) {
      if (!keep(i, j)) continue;
      const Index a = post(i, j), b = post(i + 1, j), c = post(i + 1, j + 1), d = post(i, j + 1);
      ground->triangles.push_back({a, b, c});
      ground->triangles.push_back({a, c, d});
    }
  return ground;
}

std::shared_ptr<TriangleSurface> grid(Index columns, Index rows, const Vec3& corner = {}) {
  return grid(columns, rows, corner, [](Index, Index) { return true; });
}

/// Σ over triangles: plan area × mean height over the base.
Real volume_under(const TriangleSurface& ground, Real base) {
  Real volume = 0;
  for (const auto& t : ground.triangles) {
    const Vec3 &a = ground.vertices[t[0]], &b = ground.vertices[t[1]], &c = ground.vertices[t[2]];
    volume += cross(b - a, c - a)[2] / 2 * ((a[2] + b[2] + c[2]) / 3 - base);
  }
  return volume;
}

Index polygons_of_face(const ClosedSurface& surface, Index face) {
  return static_cast<Index>(std::count(surface.face.begin(), surface.face.end(), face));
}

TEST(Terrain, OnARectangleHasFourWallsAndOneBottom) {
  const auto ground = grid(8, 5, {100, 200, 0});
  const ShapeGeometry geometry = geometry_of(TerrainShape{"t.asc", -10, ground});
  const ClosedSurface& surface = geometry.surface;
  const Measured measured = measure_surface(surface);
  EXPECT_NEAR(measured.volume, volume_under(*ground, -10), 1e-12 * measured.volume);
  EXPECT_LE(norm(measured.boundary), 1e-10);
  EXPECT_TRUE(polygons_are_convex(surface, 1e-12));
  EXPECT_EQ(polygons_of_face(surface, 0), 4);
  EXPECT_EQ(polygons_of_face(surface, 1), 4);
  EXPECT_EQ(polygons_of_face(surface, 2), 7);
  EXPECT_EQ(polygons_of_face(surface, 3), 7);
  EXPECT_EQ(polygons_of_face(surface, 4), 1);
  EXPECT_EQ(polygons_of_face(surface, 5), 56);
  EXPECT_EQ(measured.area.at(4), 28);
  // Only the bottom's four edges and the walls' edges on them do not match one to one.
  EXPECT_EQ(open_edges(surface), 4u + 22u);
  for (std::size_t p = 0; p < surface.face.size(); ++p)
    for (Index c = surface.polygon_begin[p]; c < surface.polygon_begin[p + 1]; ++c) {
      const Vec3& x = surface.vertices[surface.corner[c]];
      if (surface.face[p] == 0) {
        EXPECT_EQ(x[0], 100);
      }
      if (surface.face[p] == 1) {
        EXPECT_EQ(x[0], 107);
      }
      if (surface.face[p] == 2) {
        EXPECT_EQ(x[1], 200);
      }
      if (surface.face[p] == 3) {
        EXPECT_EQ(x[1], 204);
      }
      if (surface.face[p] == 4) {
        EXPECT_EQ(x[2], -10);
      }
    }
}

TEST(Terrain, WithAnyOutlineAndHolesIsClosed) {
  const std::vector<std::shared_ptr<TriangleSurface>> grounds{
      grid(20, 20, {1e6, 2e6, 0}, [](Index i, Index j) { return i + j < 25; }),
      grid(20, 20, {}, [](Index i, Index j) { return std::abs(i - 9) > 3 || std::abs(j - 9) > 2; }),
      // Two islands, one with a lake that holds an island.
      grid(30, 20, {}, [](Index i, Index j) {
        return i != 15 && (std::abs(i - 7) > 4 || std::abs(j - 9) > 4 ||
                           (std::abs(i - 7) < 2 && std::abs(j - 9) < 2));
      })};
  for (const auto& ground : grounds) {
    const ShapeGeometry geometry = geometry_of(TerrainShape{"t.asc", 5, ground});
    const Measured measured = measure_surface(geometry.surface);
    EXPECT_EQ(open_edges(geometry.surface), 0u);
    EXPECT_NEAR(measured.volume, volume_under(*ground, 5), 1e-11 * measured.volume);
    EXPECT_NEAR(measured.area.at(4), static_cast<Real>(ground->triangles.size()) / 2, 1e-9);
    EXPECT_LE(norm(measured.boundary), 1e-8);
    EXPECT_TRUE(polygons_are_convex(geometry.surface, 1e-9));
  }
}

TEST(Terrain, OverScatteredPostsIsClosed) {
  // A fan about a post in a ragged ring: the outline is no rectangle and not convex.
  Random random(9);
  auto ground = std::make_shared<TriangleSurface>();
  ground->vertices.push_back({0, 0, 4});
  const Polygon2 ring = random_star(17, random);
  for (const auto& [x, y] : ring) ground->vertices.push_back({x, y, random.uniform(1, 3)});
  for (Index i = 0; i < 17; ++i) ground->triangles.push_back({0, 1 + i, 1 + (i + 1) % 17});
  const ClosedSurface surface = geometry_of(TerrainShape{"t.xyz", 0, ground}).surface;
  const Measured measured = measure_surface(surface);
  EXPECT_EQ(open_edges(surface), 0u);
  EXPECT_NEAR(measured.volume, volume_under(*ground, 0), 1e-13);
  EXPECT_NEAR(measured.area.at(4), shoelace(ring), 1e-14);
  EXPECT_EQ(polygons_of_face(surface, 4), 15);
}

TEST(Terrain, Of500By500PostsTakesAboutASecond) {
  const auto ground = grid(500, 500, {4e5, 5e6, 0});
  const auto begin = Clock::now();
  const ShapeGeometry geometry = geometry_of(TerrainShape{"t.asc", -10, ground});
  const Real seconds = std::chrono::duration<Real>(Clock::now() - begin).count();
  RecordProperty("seconds", std::to_string(seconds));
  EXPECT_LT(seconds, 5) << "far over a second, even on a busy machine";
  EXPECT_EQ(geometry.surface.face.size(), 2u * 499 * 499 + 4 * 499 + 1);
  EXPECT_NEAR(measure_surface(geometry.surface).volume, volume_under(*ground, -10), 1e-2);
}

TEST(Terrain, RefusesGroundThatIsNone) {
  const auto with = [](std::vector<Vec3> vertices, std::vector<std::array<Index, 3>> triangles) {
    auto ground = std::make_shared<TriangleSurface>();
    ground->vertices = std::move(vertices);
    ground->triangles = std::move(triangles);
    return refusal(TerrainShape{"t.xyz", 0, ground});
  };
  EXPECT_NE(refusal(TerrainShape{"t.xyz", 0, nullptr}), "");
  EXPECT_NE(with({{0, 0, 1}, {1, 0, 1}, {0, 1, -1}}, {{0, 1, 2}}).find("base elevation"),
            std::string::npos);
  EXPECT_NE(with({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 2, 1}}).find("overhangs"),
            std::string::npos);
  EXPECT_NE(with({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}, {0, 1, 2}}).find("on each other"),
            std::string::npos);
}

}  // namespace
}  // namespace rockfold::test
