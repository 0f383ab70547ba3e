// Triangles so narrow that their corners nearly lie on one line, as programs that stitch meshes leave them.
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"

namespace rockfold::test {
namespace {

void add_mesh(Model& model, std::vector<Vec3> vertices,
              std::vector<std::array<Index, 3>> triangles) {
  auto surface = std::make_shared<TriangleSurface>();
  surface->vertices = std::move(vertices);
  surface->triangles = std::move(triangles);
  JointMesh mesh;
  mesh.name = "fault";
  mesh.surface = std::move(surface);
  model.joint_meshes.push_back(std::move(mesh));
}

TEST(Needles, OfAJointMeshCutNoMoreThanTheirArea) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<Real> inside(2, 8), unit(0, 1);
  std::normal_distribution<Real> gauss;
  const auto any = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
  for (int i = 0; i < 100; ++i) {
    Model model = box_model({0, 0, 0}, {10, 10, 10});
    add_joint(model, Vec3{0, 1, 0}, {5, 1, 5});
    const Vec3 a{inside(random), inside(random), inside(random)};
    const Vec3 b = a + normalized(any());
    const Real width = std::pow(10.0, -13 + 6 * unit(random));
    add_mesh(model, {a, b, a + unit(random) * (b - a) + width * any()}, {{0, 1, 2}});
    const Blocks blocks = cut(model);
    EXPECT_EQ(blocks.arrays.block_count(), 2) << width;
    EXPECT_NEAR(blocks.cutting.totals.joint_area, 100, 1e-9 + 3 * width) << width;
    EXPECT_EQ(faults_of(blocks.complex()), std::vector<std::string>{}) << width;
  }
}

// A fault of two triangles one of whose corners lies on the other's edge, but for a needle between them.
TEST(Needles, BetweenTrianglesOfAFaultLeaveItWhole) {
  for (const Real width : {0.0, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6}) {
    Model model = box_model({0, 0, 0}, {10, 10, 10});
    add_mesh(model,
             {{-5, -5, 4}, {15, -5, 4}, {15, 15, 6}, {-5, 15, 5}, {5, 5 - width, 4.999 + width}},
             {{0, 1, 4}, {1, 2, 4}, {0, 4, 2}, {0, 2, 3}});
    const Blocks blocks = cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 2) << width;
    EXPECT_NEAR(blocks.arrays.volume[0], 491.6334, 0.001) << width;
    EXPECT_NEAR(blocks.arrays.volume[0] + blocks.arrays.volume[1], 1000, 1e-9) << width;
  }
}

TEST(Needles, OfASolidsMeshCloseIt) {
  for (const Real width : {1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6}) {
    auto surface = std::make_shared<TriangleSurface>();
    // A tetrahedron whose edge from 1 to 2 has a vertex beside it.
    surface->vertices = {
        {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {2 - width, 2 - 0.5 * width, 0}};
    surface->triangles = {{0, 4, 1}, {0, 2, 4}, {4, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    Model model;
    Solid rock = box_solid("rock", {}, {});
    rock.continues.assign(1, false);
    MeshShape mesh;
    mesh.surface = std::move(surface);
    rock.shape = mesh;
    model.solids.push_back(rock);
    add_joint(model, Vec3{1, 0.1, 0.2}, {1, 1, 1});
    const Blocks blocks = cut(model);
    EXPECT_EQ(blocks.arrays.block_count(), 2) << width;
    EXPECT_NEAR(blocks.arrays.volume[0] + blocks.arrays.volume[1], 32.0 / 3, 1e-11) << width;
    EXPECT_EQ(faults_of(blocks.complex()), std::vector<std::string>{}) << width;
  }
}

}  // namespace
}  // namespace rockfold::test
