// Ground surfaces of triangles: planes of triangles that pass near other triangles' corners without being meant to.
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/complex_check.hpp"
#include "tests/cut/sample_models.hpp"
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
    EXPECT_EQ(blocks.cutting.totals.intent.near_decisions, 0);
    EXPECT_EQ(faults_of(blocks.complex()), no_faults);
    EXPECT_EQ(faults_of(blocks.arrays, blocks.complex().planes.model_size()), no_faults);
    ASSERT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_EQ(blocks.arrays.face_area.size(), 2 * (posts - 1) * (posts - 1) + 5);
  }
}

}  // namespace
}  // namespace rockfold::test
