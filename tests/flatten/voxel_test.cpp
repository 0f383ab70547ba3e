// Random block operations and joints on a lattice, against voxels.
#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"
#include "tests/flatten/block_check.hpp"

namespace rockfold::test {
namespace {

constexpr int n = 6;  // voxels a side

struct Box {
  std::array<int, 3> min, max;
  bool add;
};

struct Case {
  std::vector<Box> boxes;
  std::array<std::set<int>, 3> joints;  // planes x = k, y = k, z = k
};

Case random_case(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](int low, int high) {
    return low + static_cast<int>(random() % (high - low + 1));
  };
  Case c;
  const int boxes = draw(2, 7);
  for (int i = 0; i < boxes; ++i) {
    Box box{{}, {}, i == 0 || draw(0, 9) < 5};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = i == 0 ? draw(0, 1) : draw(0, n - 1);
      box.max[d] = i == 0 ? draw(n - 1, n) : draw(box.min[d] + 1, n);
    }
    c.boxes.push_back(box);
  }
  const int joints = draw(0, 4);
  for (int i = 0; i < joints; ++i) c.joints[draw(0, 2)].insert(draw(0, n));
  return c;
}

Model model_of(const Case& c) {
  Model model;
  for (std::size_t i = 0; i < c.boxes.size(); ++i) {
    const Box& b = c.boxes[i];
    const auto real = [](const std::array<int, 3>& v) {
      return Vec3{1.0 * v[0], 1.0 * v[1], 1.0 * v[2]};
    };
    model.solids.push_back(
        box_solid(std::string("s").append(std::to_string(i)), real(b.min), real(b.max), b.add));
    model.solids.back().material = static_cast<Index>(i);
  }
  for (int d = 0; d < 3; ++d)
    for (const int k : c.joints[d]) {
      Vec3 normal{}, point{0.5, 0.5, 0.5};
      normal[d] = 1;
      point[d] = k;
      add_joint(model, normal, point);
    }
  return model;
}

// Volumes of the blocks, sorted, and the area of the joints inside the rock.
struct Answer {
  std::vector<Index> volumes;
  Index joint_area = 0;
};

Answer by_voxels(const Case& c) {
  const auto id = [](int x, int y, int z) { return (z * n + y) * n + x; };
  std::vector<bool> rock(n * n * n, false);
  std::vector<int> part(n * n * n);
  std::iota(part.begin(), part.end(), 0);
  for (const Box& b : c.boxes)
    for (int z = b.min[2]; z < b.max[2]; ++z)
      for (int y = b.min[1]; y < b.max[1]; ++y)
        for (int x = b.min[0]; x < b.max[0]; ++x) rock[id(x, y, z)] = b.add;
  const auto root = [&](int i) {
    while (part[i] != i) i = part[i];
    return i;
  };
  Answer answer;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (int d = 0; d < 3; ++d) {
          const std::array<int, 3> next{x + (d == 0), y + (d == 1), z + (d == 2)};
          if (next[d] == n || !rock[id(x, y, z)] || !rock[id(next[0], next[1], next[2])]) continue;
          if (c.joints[d].count(next[d]) > 0)
            ++answer.joint_area;
          else
            part[root(id(x, y, z))] = root(id(next[0], next[1], next[2]));
        }
  std::vector<Index> volume(n * n * n, 0);
  for (int i = 0; i < n * n * n; ++i)
    if (rock[i]) ++volume[root(i)];
  for (const Index v : volume)
    if (v > 0) answer.volumes.push_back(v);
  std::sort(answer.volumes.begin(), answer.volumes.end());
  return answer;
}

void check(unsigned seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  const Case c = random_case(seed);
  const Answer expected = by_voxels(c);
  const Model model = model_of(c);
  if (expected.volumes.empty()) {
    EXPECT_THROW(cut(model), Error);
    return;
  }
  const Blocks blocks = cut(model);
  std::vector<Real> volumes = blocks.arrays.volume;
  std::sort(volumes.begin(), volumes.end());
  ASSERT_EQ(volumes.size(), expected.volumes.size());
  for (std::size_t i = 0; i < volumes.size(); ++i)
    EXPECT_NEAR(volumes[i], expected.volumes[i], 1e-11);
  EXPECT_NEAR(blocks.cutting.totals.joint_area, expected.joint_area, 1e-11);
  EXPECT_EQ(faults_of(blocks.complex()), std::vector<std::string>{});
  EXPECT_EQ(faults_of(blocks.arrays, blocks.complex().planes.model_size()),
            std::vector<std::string>{});
}

void check_seeds(unsigned first, unsigned count) {
  for (unsigned seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    try {
      check(seed);
    } catch (const std::exception& error) {
      ADD_FAILURE() << "seed " << seed << ": " << error.what();
    }
  }
}

TEST(RandomSolids, AreTheVoxelsTheyCover) {
  check_seeds(0, 200);
}
TEST(SlowRandomSolids, AreTheVoxelsTheyCover) {
  check_seeds(1000, 5000);
}

}  // namespace
}  // namespace rockfold::test
