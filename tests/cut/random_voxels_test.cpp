// Random rectangles on an integer grid in random boxes: overlapping in a plane, touching, crossing, ending on each other.
// Against unit cubes; straight and under affine maps, where nothing is exact any more.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/conservation.hpp"
#include "tests/cut/voxel_oracle.hpp"

namespace rockfold::test {
namespace {

GridModel random_grid(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](int low, int high) {
    return low + static_cast<int>(random() % (high - low + 1));
  };
  GridModel m;
  for (int& n : m.size) n = draw(2, 4);
  const auto range = [&](int n) {
    const int from = draw(0, n - 1);
    return std::array<int, 2>{from, draw(from + 1, n)};
  };
  m.solids.push_back({{0, 0, 0}, m.size});
  const int boxes = std::max(0, draw(-2, 2));
  for (int i = 0; i < boxes; ++i) {
    GridBox box{{}, {}, draw(0, 4) == 0};
    for (int d = 0; d < 3; ++d) {
      const auto [from, to] = range(m.size[d]);
      box.min[d] = from;
      box.max[d] = to;
    }
    m.solids.push_back(box);
  }
  const int joints = draw(1, 14);
  const int planes = draw(1, 3);  // few planes: many joints share one
  for (int j = 0; j < joints; ++j) {
    const int axis = draw(0, 2);
    // Now and then on the boundary of the box, where a joint cuts nothing.
    const int at =
        draw(0, 9) == 0 ? draw(0, 1) * m.size[axis] : std::min(m.size[axis] - 1, draw(1, planes));
    const int nu = m.size[axis == 0 ? 1 : 0], nv = m.size[axis == 2 ? 1 : 2];
    GridJoint r{axis, at, range(nu), range(nv)};
    if (draw(0, 2) == 0) r.u = {0, nu};
    if (draw(0, 2) == 0) r.v = {0, nv};
    m.joints.push_back(r);
  }
  return m;
}

AffineMap random_map(unsigned seed) {
  std::mt19937 random(seed + 12345);
  std::normal_distribution<Real> gauss;
  const auto any = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
  AffineMap map;
  // Axes at more than some 20 degrees to the plane of the others: rules for what nearly coincides leave them alone.
  Real flat = 0;
  do {
    for (Vec3& c : map.column) c = (0.5 + std::abs(gauss(random))) * normalized(any());
    flat = 1;
    for (int d = 0; d < 3; ++d)
      flat =
          std::min(flat, std::abs(map.determinant()) / (norm(map.column[d]) * norm(map.square(d))));
  } while (flat < 0.35);
  map.shift = any();
  return map;
}

void check(const GridModel& m, const Placing& placing, Real tolerance) {
  const GridBlocks expected = blocks_of(m);
  const Model model = model_of(m, placing);
  if (expected.blocks.empty()) {
    EXPECT_THROW(cut(model), Error);
    return;
  }
  const Blocks found = cut(model);
  const AffineMap map = placing.straight ? AffineMap{} : placing.map;
  EXPECT_EQ(differences(found, expected, map, tolerance), std::vector<std::string>{});
  const Vec3 corner{1.0 * m.size[0], 1.0 * m.size[1], 1.0 * m.size[2]};
  EXPECT_EQ(losses(found, norm(map(corner) - map({})), std::max(tolerance, 1e-12)),
            std::vector<std::string>{});
}

// Stops at the third seed that fails, with its model.
template <class Check>
void check_seeds(unsigned first, unsigned count, const Check& check_one) {
  int failures = 0;
  for (unsigned seed = first; seed < first + count && failures < 3; ++seed) {
    const GridModel m = random_grid(seed);
    const auto before =
        testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
    {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << to_text(m));
      try {
        check_one(m, seed);
      } catch (const std::exception& error) {
        ADD_FAILURE() << error.what();
      }
    }
    failures +=
        testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count() >
        before;
  }
}

void check_straight(const GridModel& m, unsigned /*seed*/) {
  check(m, {}, 1e-12);
}
void check_oblique(const GridModel& m, unsigned seed) {
  check(m, {.map = random_map(seed), .straight = false, .prisms = seed % 3 == 0}, 1e-11);
}
void check_noisy(const GridModel& m, unsigned seed) {
  check(m, {.map = random_map(seed), .straight = false, .noise = 2e-11, .seed = seed}, 1e-9);
}
void check_order_and_threads(const GridModel& m, unsigned seed) {
  if (blocks_of(m).blocks.empty()) return;
  EXPECT_EQ(dependences(model_of(m, {.map = random_map(seed), .straight = seed % 2 == 0})),
            std::vector<std::string>{});
}

TEST(RandomGridJoints, AreCutIntoTheCubesTheyDivide) {
  check_seeds(0, 400, check_straight);
}
TEST(RandomGridJoints, UnderAffineMapsToo) {
  check_seeds(1000, 300, check_oblique);
}
TEST(RandomGridJoints, WithNoiseToo) {
  check_seeds(2000, 100, check_noisy);
}
TEST(RandomGridJoints, DoNotDependOnOrderAndThreads) {
  check_seeds(3000, 40, check_order_and_threads);
}

TEST(SlowRandomGridJoints, AreCutIntoTheCubesTheyDivide) {
  check_seeds(100000, 10000, check_straight);
}
TEST(SlowRandomGridJoints, UnderAffineMapsToo) {
  check_seeds(200000, 10000, check_oblique);
}
TEST(SlowRandomGridJoints, WithNoiseToo) {
  check_seeds(300000, 3000, check_noisy);
}
TEST(SlowRandomGridJoints, DoNotDependOnOrderAndThreads) {
  check_seeds(400000, 2000, check_order_and_threads);
}

// With through-going joints alone, that is all rectangles as wide as the box and given without corners.
TEST(RandomGridJoints, ThatGoThroughMayBeGivenAsPlanes) {
  check_seeds(5000, 200, [](const GridModel& given, unsigned) {
    GridModel m = given;
    for (GridJoint& j : m.joints) {
      j.u = {0, m.size[j.axis == 0 ? 1 : 0]};
      j.v = {0, m.size[j.axis == 2 ? 1 : 2]};
    }
    const GridBlocks expected = blocks_of(m);
    if (expected.blocks.empty()) return;
    Model model = model_of(m);
    for (Joint& j : model.joints) j.polygon.clear();
    EXPECT_EQ(differences(cut(model), expected), std::vector<std::string>{});
  });
}

}  // namespace
}  // namespace rockfold::test
