// Finite joints of any position against Nef polyhedra: the same blocks, volumes, faces, edges, vertices, shells, genus.
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/conservation.hpp"
#include "tests/cut/nef_models.hpp"
#include "tests/cut/nef_oracle.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> none_differ;

std::string to_text(const Model& m) {
  std::string text = std::to_string(m.solids.size()) + " solids";
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

void expect_blocks_of_the_oracle(const Model& model) {
  const Blocks found = cut(model);
  EXPECT_EQ(differences(found, nef_blocks(model)), none_differ);
  EXPECT_EQ(losses(found, 32), none_differ);
}

template <class Draw>
void check_seeds(unsigned first, unsigned count, const Draw& draw) {
  for (unsigned seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    const Model model = draw(seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ": " << to_text(model));
    try {
      expect_blocks_of_the_oracle(model);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(RandomFiniteJoints, MakeTheBlocksOfNefPolyhedra) {
  check_seeds(0, 300, random_finite_joints);
}
TEST(SlowRandomFiniteJoints, MakeTheBlocksOfNefPolyhedra) {
  check_seeds(1000, 5000, random_finite_joints);
}

// The same joints without their ends.
TEST(RandomFiniteJoints, WithoutEndsMakeThoseBlocksToo) {
  check_seeds(500, 60, [](unsigned seed) {
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
  if (m.one_origin_a_plane) return expect_blocks_of_the_oracle(m.model);
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
  EXPECT_EQ(dependences(GetParam().model, GetParam().one_origin_a_plane), none_differ);
}

}  // namespace
}  // namespace rockfold::test
