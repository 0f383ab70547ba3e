// No joint loses area where slivers lie along it: planes that miss a common line or point by a hair have faces narrower than any
// block, which count with their joint like all others. The areas are clipped in doubles, independently of host/.
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "host/cut/cells/complex.hpp"
#include "tests/cut/models/draw.hpp"
#include "tests/cut/oracles/conservation.hpp"

namespace rockfold::test {
namespace {

constexpr Real edge = 8;

std::vector<HalfSpaceOutside> cube() {
  std::vector<HalfSpaceOutside> faces;
  for (int d = 0; d < 3; ++d)
    for (const Real side : {0.0, edge}) {
      HalfSpaceOutside face{{}, {side, side, side}};
      face.normal[d] = side > 0 ? 1 : -1;
      faces.push_back(face);
    }
  return faces;
}

Real section(const Vec3& normal, const Vec3& point) {
  const Vec3 up = normalized(normal), u = 4 * edge * normalized(cross(up, {0.3, -0.5, 0.8})),
             v = cross(up, u);
  return clipped_area({point - u - v, point + u - v, point + u + v, point - u + v}, cube());
}

using Areas = std::map<std::string, Real>;  // m², by joint

void add(Model& model, const Vec3& normal, const Vec3& point, Areas& expected) {
  add_joint(model, normal, point);
  expected[model.joints.back().name] = section(normal, point);
}

// Each plane misses the line through `o` by up to `miss`·edge, and its direction by up to `miss`.
void add_pencil(Model& model, Draw& draw, const Vec3& o, Real miss, Areas& expected) {
  const Vec3 axis = draw.direction();
  for (int i = 0; i < 5; ++i)
    add(model, draw.normal_to(axis) + miss * draw.direction(),
        o + draw.uniform(-1, 1) * axis + edge * miss * draw.direction(), expected);
}

// Of all fragments, whatever is on their sides.
Areas areas_of(const Complex& complex) {
  Areas areas;
  for (const Fragment& f : complex.fragments)
    if (f.joint != none) areas[complex.origins[f.joint].name] += f.area;
  return areas;
}

void expect_equal(const Blocks& blocks, const Areas& expected) {
  const Areas found = areas_of(blocks.complex());
  Real all = 0;
  for (const auto& [name, area] : expected) {
    all += area;
    const auto at = found.find(name);
    EXPECT_NEAR(at == found.end() ? 0 : at->second, area, 1e-12 * area) << name;
  }
  EXPECT_NEAR(blocks.cutting.totals.joint_area, all, 1e-12 * all);
  EXPECT_NEAR(sum(blocks.arrays.volume) / (edge * edge * edge), 1, 1e-12);
}

TEST(JointAreas, AreWholeWhereSliversLieAlongALine) {
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const Real miss : {0.0, 1e-13, 1e-11, 1e-9, 1e-7, 1e-4}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", miss " << miss);
      Draw draw(seed);
      Model model = box_model({0, 0, 0}, {edge, edge, edge});
      Areas expected;
      for (int i = 0; i < 2; ++i) add_pencil(model, draw, draw.within(2, 6), miss, expected);
      try {
        const Blocks blocks = cut(model);
        expect_equal(blocks, expected);
        // At most between slivers, narrower than 1e-9 of the size, and the blocks that own them.
        EXPECT_LE(blocks.cutting.totals.dangling_joint_area, 1e-7 * edge * edge);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

// A sliver has two sides, and each is its own joint's: two joints that lie closer than any block is wide have their whole areas,
// apart from each other. From 1e-10 of the size on they are two.
TEST(JointAreas, AreEachJointsOwnOnTheTwoSidesOfASliver) {
  for (unsigned seed = 0; seed < 40; ++seed)
    for (const Real apart : {3e-10, 1e-9, 4e-9, 1e-7}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", apart " << apart);
      Draw draw(seed);
      Model model = box_model({0, 0, 0}, {edge, edge, edge});
      Areas expected;
      for (int i = 0; i < 3; ++i) {
        const Vec3 n = draw.direction(), point = draw.within(2, 6);
        for (int k = 0; k < 3; ++k) {
          const Vec3 tilt = k == 2 ? apart * draw.direction() : Vec3{};
          add(model, n + tilt, point + k * 1.8 * edge * apart * n, expected);
        }
      }
      try {
        const Blocks blocks = cut(model);
        EXPECT_GT(blocks.cutting.totals.intent.slivers, apart < 1e-9 ? 0 : -1);
        expect_equal(blocks, expected);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

}  // namespace
}  // namespace rockfold::test
