// Ground surfaces of triangles: planes of triangles that pass near other triangles' corners without being meant to.
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"
#include "tests/flatten/block_check.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> no_faults;

// Posts 10 m apart, up to 4 m higher or lower than a slope; two triangles a square.
std::shared_ptr<TriangleSurface> rough_ground(Index posts, unsigned seed) {
  auto ground = std::make_shared<TriangleSurface>();
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<Real>(random() >> 11) * 0x1p-53; };
  for (Index j = 0; j < posts; ++j)
    for (Index i = 0; i < posts; ++i)
      ground->vertices.push_back({10.0 * i, 10.0 * j, 300 + 2.0 * i + 1.5 * j + 4 * uniform()});
  for (Index j = 0; j + 1 < posts; ++j)
    for (Index i = 0; i + 1 < posts; ++i) {
      const Index a = j * posts + i, b = a + 1, c = a + posts, d = c + 1;
      ground->triangles.push_back({a, b, d});
      ground->triangles.push_back({a, d, c});
    }
  return ground;
}

// Each third post's elevation becomes that of the plane of a triangle two rows before, plus `miss`.
void plant_accidents(TriangleSurface& ground, Index posts, Real miss) {
  for (Index j = 3; j < posts; j += 3)
    for (Index i = 2; i < posts; i += 3) {
      const Index a = (j - 3) * posts + i - 1, b = a + 1, c = a + posts;
      const Vec3 &p = ground.vertices[a], &q = ground.vertices[b], &r = ground.vertices[c];
      const Vec3 n = cross(q - p, r - p);
      Vec3& x = ground.vertices[j * posts + i];
      x[2] = p[2] - (n[0] * (x[0] - p[0]) + n[1] * (x[1] - p[1])) / n[2] + miss;
    }
}

Model model_of(std::shared_ptr<TriangleSurface> ground) {
  TerrainShape terrain;
  terrain.ground = std::move(ground);
  Model model;
  Solid rock;
  rock.name = "rock";
  rock.shape = std::move(terrain);
  rock.continues.assign(6, false);
  model.solids.push_back(std::move(rock));
  return model;
}

TEST(Terrain, KeepsEachTriangleThoughPlanesPassNearOtherCorners) {
  constexpr Index posts = 20;
  for (const Real miss : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5}) {
    SCOPED_TRACE(miss);
    auto ground = rough_ground(posts, 3);
    plant_accidents(*ground, posts, miss);
    const Blocks blocks = cut(model_of(std::move(ground)));
    EXPECT_EQ(blocks.cutting.totals.intent.doubts, 0);
    EXPECT_EQ(faults_of(blocks.complex()), no_faults);
    EXPECT_EQ(faults_of(blocks.arrays, blocks.complex().planes.model_size()), no_faults);
    ASSERT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_EQ(blocks.arrays.face_area.size(), 2 * (posts - 1) * (posts - 1) + 5);
  }
}

// Elevations to a decimetre on map coordinates: neighbours that were meant to be coplanar miss it by the last digit.
TEST(Terrain, OnMapCoordinatesIsOneBlockOfItsVolume) {
  constexpr Index posts = 20;
  for (const Real apart : {0.2, 0.3, 1.1, 8.333})
    for (const unsigned seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(testing::Message() << apart << ", seed " << seed);
      auto ground = rough_ground(posts, seed);
      for (Vec3& x : ground->vertices)
        x = {500000 + apart * std::round(x[0] / 10), 4600000 + apart * std::round(x[1] / 10),
             std::round(10 * x[2]) / 10};
      long double volume = 0;
      for (const auto& t : ground->triangles) {
        const Vec3 &a = ground->vertices[t[0]], &b = ground->vertices[t[1]],
                   &c = ground->vertices[t[2]];
        volume += cross(b - a, c - a)[2] / 2 * ((a[2] + b[2] + c[2]) / 3);
      }
      const Blocks blocks = cut(model_of(std::move(ground)));
      EXPECT_EQ(blocks.cutting.totals.intent.doubts, 0);
      ASSERT_EQ(blocks.arrays.block_count(), 1);
      EXPECT_EQ(blocks.arrays.shell_count[0], 1);
      EXPECT_EQ(blocks.arrays.genus[0], 0);
      EXPECT_NEAR(blocks.arrays.volume[0] / static_cast<Real>(volume), 1, 1e-9);
    }
}

// A box of n[d] cells an edge; each square is two triangles along one of its diagonals.
std::shared_ptr<TriangleSurface> meshed_box(const Vec3& min, const Vec3& max, std::array<int, 3> n,
                                            std::mt19937& random) {
  auto surface = std::make_shared<TriangleSurface>();
  std::map<std::array<int, 3>, Index> number;
  const auto vertex = [&](const std::array<int, 3>& i) {
    const auto [it, fresh] = number.try_emplace(i, static_cast<Index>(surface->vertices.size()));
    if (fresh) {
      Vec3 x;
      for (int d = 0; d < 3; ++d) x[d] = min[d] + (max[d] - min[d]) * i[d] / n[d];
      surface->vertices.push_back(x);
    }
    return it->second;
  };
  for (int d = 0; d < 3; ++d)
    for (const bool upper : {false, true}) {
      const int u = (d + 1) % 3, v = (d + 2) % 3;
      for (int i = 0; i < n[u]; ++i)
        for (int j = 0; j < n[v]; ++j) {
          std::array<Index, 4> c{};
          for (int k = 0; k < 4; ++k) {
            std::array<int, 3> at{};
            at[d] = upper ? n[d] : 0;
            at[u] = i + (k == 1 || k == 2), at[v] = j + (k >= 2);
            c[upper ? k : 3 - k] = vertex(at);
          }
          const int turn = random() & 1u;
          surface->triangles.push_back({c[turn], c[turn + 1], c[turn + 2]});
          surface->triangles.push_back({c[turn], c[turn + 2], c[(turn + 3) % 4]});
        }
    }
  return surface;
}

// Rounding leaves their corners beside each other's planes by the last digit.
TEST(Meshes, ThatShareAFaceAreOneBlock) {
  std::mt19937 random(5);
  for (const Real size : {1.0, 7.0, 700.0})
    for (int i = 0; i < 10; ++i) {
      SCOPED_TRACE(testing::Message() << size << ", " << i);
      Model model;
      for (const bool second : {false, true}) {
        Solid solid = box_solid(second ? "b" : "a", {}, {});
        solid.continues.assign(1, false);
        MeshShape mesh;
        mesh.surface = second ? meshed_box({size, 0, 0}, {2 * size, size, size}, {2, 5, 3}, random)
                              : meshed_box({0, 0, 0}, {size, size, size}, {3, 2, 4}, random);
        solid.shape = mesh;
        model.solids.push_back(std::move(solid));
      }
      const Blocks blocks = cut(model);
      ASSERT_EQ(blocks.arrays.block_count(), 1);
      EXPECT_NEAR(blocks.arrays.volume[0], 2 * size * size * size, 1e-9 * size * size * size);
    }
}

}  // namespace
}  // namespace rockfold::test
