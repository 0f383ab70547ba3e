// Ground as it is surveyed, with joints and openings: never an error, no volume lost, blocks that do not hang on the last digit.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/cut/corpus.hpp"
#include "tests/cut/model_text.hpp"
#include "tests/cut/seeded_runs.hpp"
#include "tests/cut/terrain_models.hpp"
#include "tests/reference/sanitized.hpp"

namespace rockfold::test {
namespace {

// Blocks that are there whichever way the ground is off by a tenth of a micrometre.
void check_jitter(const TerrainModel& terrain, Index blocks, Faults& faults) {
  const auto count = [&](unsigned seed) {
    return cut(jittered(terrain.model, 1e-7, seed)).arrays.block_count();
  };
  const Index once = count(1);
  if (once != blocks && once == count(2) && once == count(3))
    faults.push_back("jitter: " + std::to_string(blocks) + " blocks, of jittered ground " +
                     std::to_string(once));
}

SeededCase check(unsigned seed, int most_posts) {
  const TerrainModel terrain = terrain_model(seed, most_posts);
  const Faults faults =
      faults_of_cutting(terrain.model, seed, terrain.size, [&](const Blocks& b, Faults& list) {
        if (!terrain.subtracted) check_total(b, terrain.ground_volume, 1e-12, list);
        check_jitter(terrain, b.arrays.block_count(), list);
      });
  return {terrain.kind.substr(0, terrain.kind.find(" posts")), faults, [terrain, seed] {
            const Model least = smallest_faulty(terrain.model, [&](const Model& m) {
              return faults_of_cutting(m, seed, terrain.size);
            });
            return terrain.kind + "\n" + to_toml(least);
          }};
}

TEST(Terrains, AreCutWhole) {
  check_seeds(0, reference::cases(24u, 8u), [](unsigned seed) { return check(seed, 12); });
}
TEST(SlowTerrains, AreCutWhole) {
  check_seeds(from_environment("ROCKFOLD_FIRST_SEED", 1000),
              from_environment("ROCKFOLD_TERRAIN_CASES", 1000),
              [](unsigned seed) { return check(seed, 60); });
}
TEST(Terrains, ThatOnceFailed) {
  const std::size_t count = corpus::terrain_seeds.size();
  for (std::size_t i = 0; i < reference::cases<std::size_t>(count, 2); ++i)
    check_seeds(corpus::terrain_seeds[i], 1, [](unsigned s) { return check(s, 60); });
}

}  // namespace
}  // namespace rockfold::test
