// Which joint a face belongs to, and that no joint loses area.
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/nef_models.hpp"
#include "tests/cut/oracles/conservation.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> none_differ;
constexpr Real pi = 3.14159265358979323846;

std::map<std::string, Real> area_by_joint(const BlockArrays& a) {
  std::map<std::string, Real> areas;
  for (std::size_t f = 0; f < a.face_area.size(); ++f)
    if (a.origins[a.face_origin[f]].kind == FaceOrigin::Kind::joint)
      areas[a.origins[a.face_origin[f]].name] += a.face_area[f] / 2;
  for (std::size_t d = 0; d < a.dead_end_block.size(); ++d) {
    const Index begin = a.dead_end_corner_begin[d];
    Vec3 twice{};
    for (Index c = begin + 1; c + 1 < a.dead_end_corner_begin[d + 1]; ++c)
      twice += cross(a.dead_end_vertex[c] - a.dead_end_vertex[begin],
                     a.dead_end_vertex[c + 1] - a.dead_end_vertex[begin]);
    areas[a.origins[a.dead_end_origin[d]].name] += norm(twice) / 2;
  }
  return areas;
}

const std::vector<HalfSpaceOutside> cube16{{{-1, 0, 0}, {}},          {{0, -1, 0}, {}},
                                           {{0, 0, -1}, {}},          {{1, 0, 0}, {16, 16, 16}},
                                           {{0, 1, 0}, {16, 16, 16}}, {{0, 0, 1}, {16, 16, 16}}};

TEST(CoplanarJoints, AreTheFirstListedWhereTheyOverlap) {
  const Frame f{{8, 8, 8}, {2, 1, 0}, {0, 1, 2}};
  const auto strip = [&](Real from, Real to) {
    return std::vector<Vec3>{f(from, -9), f(to, -9), f(to, 9), f(from, 9)};
  };
  const Real whole = clipped_area(strip(-9, 9), cube16);
  for (const bool swapped : {false, true}) {
    Model model = box_model({0, 0, 0}, {16, 16, 16});
    model.joint_materials.resize(2);
    add_polygon(model, f, {{-9, -9}, {1, -9}, {1, 9}, {-9, 9}});
    add_polygon(model, f, {{-1, -9}, {9, -9}, {9, 9}, {-1, 9}});
    model.joints[1].material = 1;
    if (swapped) std::swap(model.joints[0], model.joints[1]);
    const BlockArrays a = cut(model).arrays;
    ASSERT_EQ(a.block_count(), 2);
    const auto areas = area_by_joint(a);
    const std::string first = swapped ? "F2" : "F1", second = swapped ? "F1" : "F2";
    const Real of_first = clipped_area(swapped ? strip(-1, 9) : strip(-9, 1), cube16);
    EXPECT_NEAR(areas.at(first), of_first, 1e-9);
    EXPECT_NEAR(areas.at(second), whole - of_first, 1e-9);
    ASSERT_EQ(a.interfaces.size(), 2u);
    for (const FaceOrigin& o : a.origins)
      if (o.kind == FaceOrigin::Kind::joint) {
        EXPECT_EQ(o.joint_material, o.name == "F2" ? 1 : 0);
      }
    // The section is a rhombus with corners of the cube; the line between the two joints ends on two of its edges.
    for (Index b = 0; b < 2; ++b) {
      const Counts c = counts_of(a, b);
      EXPECT_EQ(c.vertices - c.edges + c.faces, 2);
      EXPECT_EQ(a.face_begin[b + 1] - a.face_begin[b], c.faces);
    }
  }
}

// Each joint's pieces, dead ends and all, add up to the joint's area inside the rock.
TEST(RandomDiscs, LoseNoArea) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::normal_distribution<Real> gauss;
    std::uniform_real_distribution<Real> unit;
    Model model = box_model({0, 0, 0}, {16, 16, 16});
    for (int i = 0; i < 25; ++i) {
      const Vec3 n = normalized({gauss(random), gauss(random), gauss(random)});
      const Vec3 u = normalized(cross({gauss(random), gauss(random), gauss(random)}, n)),
                 v = cross(n, u);
      const Vec3 centre{16 * unit(random), 16 * unit(random), 16 * unit(random)};
      const Real radius = 2 + 8 * unit(random);
      add_joint(model, n, centre);
      for (int k = 0; k < 16; ++k)
        model.joints.back().polygon.push_back(centre + radius * std::cos(pi * k / 8) * u +
                                              radius * std::sin(pi * k / 8) * v);
    }
    const Blocks blocks = cut(model);
    const auto areas = area_by_joint(blocks.arrays);
    Real all = 0;
    for (const Joint& j : model.joints) {
      const Real expected = clipped_area(j.polygon, cube16);
      all += expected;
      const auto found = areas.find(j.name);
      EXPECT_NEAR(found == areas.end() ? 0 : found->second, expected, 1e-9) << j.name;
    }
    EXPECT_NEAR(blocks.cutting.totals.joint_area, all, 1e-9);
    EXPECT_NEAR(blocks.cutting.totals.solid_volume, 4096, 4096e-12);
    EXPECT_EQ(losses(blocks, 28), none_differ);
  }
}

TEST(RandomDiscs, DoNotDependOnOrderAndThreads) {
  for (unsigned seed = 100; seed < 103; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::normal_distribution<Real> gauss;
    std::uniform_real_distribution<Real> unit;
    Model model = box_model({0, 0, 0}, {16, 16, 16});
    for (int i = 0; i < 40; ++i) {
      add_joint(model, Vec3{gauss(random), gauss(random), gauss(random)},
                {16 * unit(random), 16 * unit(random), 16 * unit(random)});
      model.joints.back().radius = 2 + 6 * unit(random);
    }
    EXPECT_EQ(dependences(model, 16), none_differ);
  }
}

// Discs by their radius: a regular polygon of `sides` corners.
TEST(Disc, InsideTheRockIsADeadEndOfItsArea) {
  for (const Index sides : {3, 4, 16, 50}) {
    Model model = box_model({0, 0, 0}, {16, 16, 16});
    add_joint(model, DipOrientation{37, 211}, {8, 7, 6});
    model.joints[0].radius = 3;
    model.joints[0].sides = sides;
    const Blocks blocks = cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_NEAR(blocks.cutting.totals.dangling_joint_area,
                0.5 * sides * 9 * std::sin(2 * pi / sides), 1e-11);
    EXPECT_EQ(counts_of(blocks.arrays, 0), (Counts{8, 12, 6}));
    EXPECT_EQ(losses(blocks, 28), none_differ);
  }
}

}  // namespace
}  // namespace rockfold::test
