// Finite joints of any position against Nef polyhedra: the same blocks, volumes, faces, edges, vertices, shells, genus.
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/nef_models.hpp"
#include "tests/cut/oracles/conservation.hpp"
#include "tests/cut/oracles/nef_oracle.hpp"
#include "tests/reference/sanitized.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> none_differ;

std::string to_text(const Model& m) {
  std::string text;
  for (const Solid& s : m.solids)
    text += (s.add ? "+" : "-") + std::to_string(s.shape.index()) + " ";
  const auto add = [&text](const Vec3& p) {
    for (const Real c : p) text += " " + std::to_string(c);
  };
  for (const Joint& j : m.joints) {
    text += "\n" + j.name + ": normal";
    add(std::get<Vec3>(j.plane.orientation));
    text += " point";
    add(j.plane.point);
    for (const Vec3& p : j.polygon) text += ",", add(p);
  }
  return text;
}

std::vector<std::string> faults_of(const Model& model) {
  try {
    const Blocks found = cut(model);
    std::vector<std::string> faults = differences(found, nef_blocks(model));
    for (const std::string& loss : losses(found, 32)) faults.push_back(loss);
    return faults;
  } catch (const std::exception& error) {
    return {error.what()};
  }
}

// Leaves out what is not needed for a fault.
Model smallest_faulty(Model model) {
  for (std::size_t i = model.joints.size(); i-- > 0;) {
    Model less = model;
    less.joints.erase(less.joints.begin() + static_cast<std::ptrdiff_t>(i));
    if (!faults_of(less).empty()) model = std::move(less);
  }
  for (std::size_t i = model.solids.size(); i-- > 1;) {
    Model less = model;
    less.solids.erase(less.solids.begin() + static_cast<std::ptrdiff_t>(i));
    if (!faults_of(less).empty()) model = std::move(less);
  }
  return model;
}

// Goes on after a seed that fails, up to the third.
template <class Draw>
void check_seeds(unsigned first, unsigned count, const Draw& draw) {
  int failed = 0;
  for (unsigned seed = first; seed < first + count && failed < 3; ++seed) {
    const Model model = draw(seed);
    if (faults_of(model).empty()) continue;
    ++failed;
    const Model smallest = smallest_faulty(model);
    EXPECT_EQ(faults_of(smallest), none_differ) << "seed " << seed << ": " << to_text(smallest);
  }
}

TEST(LongRandomFiniteJoints, MakeTheBlocksOfNefPolyhedra) {
  check_seeds(0, 300, random_finite_joints);
}
TEST(SlowRandomFiniteJoints, MakeTheBlocksOfNefPolyhedra) {
  check_seeds(1000, 5000, random_finite_joints);
}

TEST(LongRandomFiniteJoints, OfAnyRealPositionToo) {
  check_seeds(0, 150, random_discs);
}
TEST(SlowRandomFiniteJoints, OfAnyRealPositionToo) {
  check_seeds(1000, 3000, random_discs);
}

// The same joints without their ends.
TEST(RandomFiniteJoints, WithoutEndsMakeThoseBlocksToo) {
  check_seeds(500, reference::cases(60u, 10u), [](unsigned seed) {
    Model model = random_finite_joints(seed);
    for (Joint& j : model.joints) j.polygon.clear();
    return model;
  });
}

class NastyJoints : public testing::TestWithParam<NamedModel> {};
INSTANTIATE_TEST_SUITE_P(, NastyJoints, testing::ValuesIn(nasty_models()),
                         [](const auto& test) { return test.param.name; });

// Coplanar joints are one origin to the oracle: their faces are counted by hand below.
TEST_P(NastyJoints, MakeTheBlocksOfNefPolyhedra) {
  const NamedModel& m = GetParam();
  if (m.one_origin_a_plane) {
    EXPECT_EQ(faults_of(m.model), none_differ);
    return;
  }
  const Blocks found = cut(m.model);
  std::vector<NefBlock> expected = nef_blocks(m.model);
  for (NefBlock& e : expected)
    for (Index b = 0; b < found.arrays.block_count(); ++b)
      if (std::abs(found.arrays.volume[b] - e.volume) < 1e-6) e.counts = counts_of(found.arrays, b);
  EXPECT_EQ(differences(found, expected), none_differ);
  EXPECT_EQ(losses(found, 32), none_differ);
}

TEST_P(NastyJoints, DoNotDependOnOrderAndThreads) {
  // Which of two coplanar joints a face belongs to does depend on their order.
  EXPECT_EQ(dependences(GetParam().model, 16, GetParam().one_origin_a_plane), none_differ);
}

}  // namespace
}  // namespace rockfold::test
