// No joint loses area where slivers lie along it: planes that miss a common line or point by a hair have faces narrower than any
// block, which count with their joint like all others. The areas are clipped in doubles, independently of host/.
#include <gtest/gtest.h>

#include "tests/cut/conservation.hpp"
#include "tests/cut/draw.hpp"

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

// Each plane misses the line through `o` by up to `miss`·edge, and its direction by up to `miss`.
Real add_pencil(Model& model, Draw& draw, const Vec3& o, Real miss) {
  const Vec3 axis = draw.direction();
  Real area = 0;
  for (int i = 0; i < 5; ++i) {
    const Vec3 n = draw.normal_to(axis) + miss * draw.direction();
    const Vec3 point = o + draw.uniform(-1, 1) * axis + edge * miss * draw.direction();
    add_joint(model, n, point);
    area += section(n, point);
  }
  return area;
}

TEST(JointAreas, AreWholeWhereSliversLieAlongALine) {
  for (unsigned seed = 0; seed < 60; ++seed)
    for (const Real miss : {0.0, 1e-13, 1e-11, 1e-9, 1e-7, 1e-4}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", miss " << miss);
      Draw draw(seed);
      Model model = box_model({0, 0, 0}, {edge, edge, edge});
      const Real expected = add_pencil(model, draw, draw.within(2, 6), miss) +
                            add_pencil(model, draw, draw.within(2, 6), miss);
      try {
        const Blocks blocks = cut(model);
        EXPECT_NEAR(blocks.cutting.totals.joint_area / expected, 1, 1e-12);
        // At most between slivers, narrower than 1e-9 of the size, and the blocks that own them.
        EXPECT_LE(blocks.cutting.totals.dangling_joint_area, 1e-7 * edge * edge);
        EXPECT_NEAR(sum(blocks.arrays.volume) / (edge * edge * edge), 1, 1e-12);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
}

}  // namespace
}  // namespace rockfold::test
