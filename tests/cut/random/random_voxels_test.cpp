// Random rectangles on an integer grid in random boxes: overlapping in a plane, touching, crossing, ending on each other.
// Against unit cubes; straight and under affine maps, where nothing is exact any more.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/oracles/conservation.hpp"
#include "tests/cut/oracles/voxel_oracle.hpp"

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

std::vector<std::string> faults_of(const GridModel& m, const Placing& placing, Real tolerance) {
  const GridBlocks expected = blocks_of(m);
  const Model model = model_of(m, placing);
  try {
    const Blocks found = cut(model);
    if (expected.blocks.empty()) return {"blocks where there is no rock"};
    const AffineMap map = placing.straight ? AffineMap{} : placing.map;
    std::vector<std::string> faults = differences(found, expected, map, tolerance);
    const Vec3 corner{1.0 * m.size[0], 1.0 * m.size[1], 1.0 * m.size[2]};
    for (const std::string& loss : losses(found, norm(map(corner) - map({})), tolerance))
      faults.push_back(loss);
    return faults;
  } catch (const Error& error) {
    if (expected.blocks.empty()) return {};
    return {error.what()};
  } catch (const std::exception& error) {
    return {error.what()};
  }
}

// Leaves out what is not needed for a fault.
template <class Faults>
GridModel smallest_faulty(GridModel m, const Faults& faults) {
  for (std::size_t i = m.joints.size(); i-- > 0;) {
    GridModel less = m;
    less.joints.erase(less.joints.begin() + static_cast<std::ptrdiff_t>(i));
    if (!faults(less).empty()) m = std::move(less);
  }
  for (std::size_t i = m.solids.size(); i-- > 1;) {
    GridModel less = m;
    less.solids.erase(less.solids.begin() + static_cast<std::ptrdiff_t>(i));
    if (!faults(less).empty()) m = std::move(less);
  }
  return m;
}

// Goes on after a seed that fails, up to the third.
template <class Faults>
void check_seeds(unsigned first, unsigned count, const Faults& faults_of_seed) {
  int failed = 0;
  for (unsigned seed = first; seed < first + count && failed < 3; ++seed) {
    const auto faults = [&](const GridModel& m) { return faults_of_seed(m, seed); };
    const GridModel m = random_grid(seed);
    if (faults(m).empty()) continue;
    ++failed;
    const GridModel smallest = smallest_faulty(m, faults);
    EXPECT_EQ(faults(smallest), std::vector<std::string>{})
        << "seed " << seed << ": " << to_text(smallest);
  }
}

std::vector<std::string> straight(const GridModel& m, unsigned /*seed*/) {
  return faults_of(m, {}, 1e-12);
}
std::vector<std::string> oblique(const GridModel& m, unsigned seed) {
  return faults_of(m, {.map = random_map(seed), .straight = false, .prisms = seed % 3 == 0}, 1e-11);
}
std::vector<std::string> noisy(const GridModel& m, unsigned seed) {
  return faults_of(m, {.map = random_map(seed), .straight = false, .noise = 2e-11, .seed = seed},
                   1e-9);
}

// Which of two joints wins where they overlap does depend on their order.
GridModel without_overlaps(const GridModel& m) {
  GridModel out{m.size, m.solids, {}};
  const auto overlap = [](const std::array<int, 2>& a, const std::array<int, 2>& b) {
    return a[0] < b[1] && b[0] < a[1];
  };
  for (const GridJoint& j : m.joints)
    if (std::none_of(out.joints.begin(), out.joints.end(), [&](const GridJoint& k) {
          return k.axis == j.axis && k.at == j.at && overlap(k.u, j.u) && overlap(k.v, j.v);
        }))
      out.joints.push_back(j);
  return out;
}
std::vector<std::string> dependent(const GridModel& given, unsigned seed) {
  const GridModel m = without_overlaps(given);
  if (blocks_of(m).blocks.empty()) return {};
  const AffineMap map = random_map(seed);
  return dependences(model_of(m, {.map = map, .straight = seed % 2 == 0}), 4);
}

TEST(RandomGridJoints, AreCutIntoTheCubesTheyDivide) {
  check_seeds(0, 400, straight);
}
TEST(RandomGridJoints, UnderAffineMapsToo) {
  check_seeds(1000, 300, oblique);
}
TEST(RandomGridJoints, WithNoiseToo) {
  check_seeds(2000, 100, noisy);
}
TEST(RandomGridJoints, DoNotDependOnOrderAndThreads) {
  check_seeds(3000, 40, dependent);
}

TEST(SlowRandomGridJoints, AreCutIntoTheCubesTheyDivide) {
  check_seeds(100000, 10000, straight);
}
TEST(SlowRandomGridJoints, UnderAffineMapsToo) {
  check_seeds(200000, 10000, oblique);
}
TEST(SlowRandomGridJoints, WithNoiseToo) {
  check_seeds(300000, 3000, noisy);
}
TEST(SlowRandomGridJoints, DoNotDependOnOrderAndThreads) {
  check_seeds(400000, 2000, dependent);
}

// With through-going joints alone, that is all rectangles as wide as the box and given without corners.
TEST(RandomGridJoints, ThatGoThroughMayBeGivenAsPlanes) {
  check_seeds(5000, 200, [](const GridModel& given, unsigned) -> std::vector<std::string> {
    GridModel m = given;
    for (GridJoint& j : m.joints) {
      j.u = {0, m.size[j.axis == 0 ? 1 : 0]};
      j.v = {0, m.size[j.axis == 2 ? 1 : 2]};
    }
    const GridBlocks expected = blocks_of(m);
    if (expected.blocks.empty()) return {};
    Model model = model_of(m);
    for (Joint& j : model.joints) j.polygon.clear();
    return differences(cut(model), expected);
  });
}

}  // namespace
}  // namespace rockfold::test
