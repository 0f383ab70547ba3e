// The adversary: no model of finite numbers fails, none loses volume, none depends on the order of its joints.
#include "tests/cut/models/nasty_models.hpp"

#include <gtest/gtest.h>

#include "tests/cut/models/model_text.hpp"
#include "tests/cut/random/corpus.hpp"
#include "tests/cut/random/seeded_runs.hpp"

namespace rockfold::test {
namespace {

SeededCase check(const NastyModel& nasty, unsigned seed) {
  const Faults faults =
      faults_of_cutting(nasty.model, seed, nasty.size, [&](const Blocks& blocks, Faults& list) {
        check_total(blocks, nasty.volume, 1e-12 + nasty.volume_error, list);
        if (nasty.blocks && blocks.arrays.block_count() != *nasty.blocks)
          list.push_back("count: " + std::to_string(blocks.arrays.block_count()) +
                         " blocks, expected " + std::to_string(*nasty.blocks));
      });
  return {nasty.kind.substr(0, nasty.kind.find(',')), faults, [nasty, seed] {
            const Model least = smallest_faulty(nasty.model, [&](const Model& m) {
              return faults_of_cutting(m, seed, nasty.size);
            });
            return nasty.kind + "\n" + to_toml(least);
          }};
}

SeededCase check_any(unsigned seed) {
  return check(nasty_model(seed), seed);
}

class NastyKind : public testing::TestWithParam<int> {
 protected:
  static SeededCase check_kind(unsigned seed) {
    return check(nasty_model_of_kind(GetParam(), seed), seed);
  }
};
class SlowNastyKind : public NastyKind {};

TEST_P(NastyKind, AloneIsCutWhole) {
  check_seeds(0, 20, check_kind);
}
TEST_P(SlowNastyKind, AloneIsCutWhole) {
  check_seeds(from_environment("ROCKFOLD_FIRST_SEED", 1000),
              from_environment("ROCKFOLD_NASTY_CASES", 10000) / 20, check_kind);
}
const auto by_name = [](const testing::TestParamInfo<int>& info) {
  std::string name = nasty_model_of_kind(info.param, 0).kind;
  name.resize(name.find(','));
  for (char& c : name)
    if (c == ' ' || c == '-') c = '_';
  return name;
};
INSTANTIATE_TEST_SUITE_P(, NastyKind, testing::Range(0, nasty_kind_count()), by_name);
INSTANTIATE_TEST_SUITE_P(, SlowNastyKind, testing::Range(0, nasty_kind_count()), by_name);

TEST(NastyModels, AreCutWhole) {
  check_seeds(0, 200, check_any);
}
TEST(SlowNastyModels, AreCutWhole) {
  check_seeds(from_environment("ROCKFOLD_FIRST_SEED", 100000),
              from_environment("ROCKFOLD_NASTY_CASES", 10000), check_any);
}

TEST(NastyModels, ThatOnceFailed) {
  for (const unsigned seed : corpus::nasty_seeds) check_seeds(seed, 1, check_any);
  for (const auto& [kind, seed] : corpus::nasty_kind_seeds)
    check_seeds(seed, 1,
                [kind = kind](unsigned s) { return check(nasty_model_of_kind(kind, s), s); });
}

}  // namespace
}  // namespace rockfold::test
