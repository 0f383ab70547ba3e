// Bodies from files whose coordinates are rounded are cut into as many blocks as there are bodies, with whole contacts.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "host/files/bodies/fit_bodies.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/models/vault_model.hpp"

namespace rockfold::test {
namespace {

// Beds lie between courses, heads between voussoirs of a course.
Real contact_area(const Vault& vault) {
  const Real head_of_course =
      0.5 * (std::pow(vault.radius + vault.thickness, 2) - std::pow(vault.radius, 2)) *
      std::sin(std::numbers::pi / vault.courses);
  const Real beds = (vault.courses - 1) * vault.along * vault.width * vault.thickness;
  Real heads = 0;
  for (int i = 0; i < vault.courses; ++i)
    heads += (i % 2 == 0 ? vault.along - 1 : vault.along) * head_of_course;
  return beds + heads;
}

void expect_whole(const Vault& vault) {
  Model model = vault.model();
  fit_bodies(model);
  ASSERT_TRUE(model.body_fit);
  EXPECT_EQ(model.body_fit->bodies, static_cast<Index>(model.solids.size()));
  EXPECT_EQ(model.body_fit->convex, static_cast<Index>(model.solids.size()));
  EXPECT_LT(model.body_fit->largest_move, 3 * std::pow(10.0, -vault.decimals));
  EXPECT_TRUE(model.warnings.empty());
  const Blocks blocks = cut(model);
  EXPECT_EQ(blocks.arrays.block_count(), static_cast<Index>(model.solids.size()));
  EXPECT_EQ(std::count(blocks.arrays.convex.begin(), blocks.arrays.convex.end(), true),
            static_cast<std::ptrdiff_t>(model.solids.size()));
  EXPECT_FALSE(blocks.cutting.totals.intent.doubts_decide);
  EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
  // Edges of some 1,000 m are off by the last digit at most.
  EXPECT_NEAR(blocks.cutting.totals.joint_area, contact_area(vault),
              1e3 * std::pow(10.0, -vault.decimals));
}

TEST(RoundedBodies, OfASmallVaultAreWhole) {
  for (const int decimals : {3, 4, 5, 6, 9, 12})
    expect_whole({.courses = 5, .along = 2, .decimals = decimals});
}

TEST(RoundedBodies, OfAVaultOf195VoussoirsAreWhole) {
  expect_whole({});
}

TEST(RoundedBodies, ThatAreApartStayAsTheyAre) {
  Model model = Vault{.courses = 1, .along = 2}.model();
  auto& mesh = std::get<MeshShape>(model.solids[1].shape);
  auto moved = std::make_shared<TriangleSurface>(*mesh.surface);
  for (Vec3& x : moved->vertices) x += 1e-4 * Vec3{-std::sin(0.3), std::cos(0.3), 0};
  mesh.surface = moved;
  model.solids.resize(2);
  fit_bodies(model);
  EXPECT_FALSE(model.body_fit);
  EXPECT_EQ(mesh.surface, moved);
}

Real area_of_interfaces(const Blocks& blocks) {
  Real area = 0;
  for (const auto& i : blocks.arrays.interfaces) area += i.area;
  return area;
}

// An L in plan and the square that fills it: one is not convex, so its corners move and its triangles stay.
Model notched(Real gap) {
  const auto prism = [](const std::vector<std::array<Real, 2>>& base, Real low, Real high) {
    TriangleSurface surface;
    const auto n = static_cast<Index>(base.size());
    for (const Real z : {low, high})
      for (const auto& p : base) surface.vertices.push_back({p[0], p[1], z});
    for (Index i = 0; i < n; ++i) {
      const Index j = (i + 1) % n;
      surface.triangles.push_back({i, j, j + n});
      surface.triangles.push_back({i, j + n, i + n});
    }
    for (Index i = 1; i + 1 < n; ++i) {
      surface.triangles.push_back({0, i + 1, i});
      surface.triangles.push_back({n, n + i, n + i + 1});
    }
    surface.last_digit = 1e-5;
    return surface;
  };
  Model model;
  model.joint_materials.resize(1);
  model.joint_materials[0].name = "mortar";
  model.joint_materials[0].friction_angle = 35;
  // Fanned about its reentrant corner.
  const auto add = [&](TriangleSurface surface) {
    Solid solid;
    solid.name = "s" + std::to_string(model.solids.size());
    solid.shape = MeshShape{"s.obj", std::make_shared<TriangleSurface>(std::move(surface))};
    solid.material = none;
    solid.continues.assign(1, false);
    solid.interface = 0;
    model.solids.push_back(std::move(solid));
  };
  add(prism({{1, 1}, {0, 1}, {0, 0}, {2, 0}, {2, 2}, {1, 2}}, 0, 1));
  add(prism({{0, 1 + gap}, {1 - 0.5 * gap, 1 + gap}, {1 - 0.5 * gap, 2}, {0, 2}}, 0.5 * gap,
            1 - gap));
  return model;
}

TEST(RoundedBodies, ThatAreNotConvexTouchAllTheSame) {
  for (const Real gap : {1e-5, -1e-5}) {
    Model model = notched(gap);
    fit_bodies(model);
    ASSERT_TRUE(model.body_fit);
    EXPECT_EQ(model.body_fit->convex, 1);
    const Blocks blocks = cut(model);
    EXPECT_EQ(blocks.arrays.block_count(), 2);
    EXPECT_NEAR(area_of_interfaces(blocks), 2, 1e-4) << gap;
    EXPECT_FALSE(blocks.cutting.totals.intent.doubts_decide);
  }
}

TEST(RoundedBodies, BeyondTheToleranceAreApart) {
  Model model = notched(1e-4);
  fit_bodies(model);
  EXPECT_EQ(area_of_interfaces(cut(model)), 0);
  Model given = notched(1e-4);
  given.contact.tolerance = 1e-4;
  fit_bodies(given);
  EXPECT_NEAR(area_of_interfaces(cut(given)), 2, 1e-3);
}

TEST(RoundedBodies, RefuseAToleranceOfTheirOwnSize) {
  Model model = notched(1e-5);
  model.contact.tolerance = 0.06;
  model.contact.place = {"m.toml", 3, 1, "contact"};
  try {
    fit_bodies(model);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics().front().place.key, "contact.tolerance");
    EXPECT_NE(std::string(error.what()).find("\"s1\""), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace rockfold::test
