// Ground as it is surveyed, with joints and openings: never an error, no volume lost, blocks that do not hang on the last digit.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/model_text.hpp"
#include "tests/cut/models/terrain_models.hpp"
#include "tests/cut/random/corpus.hpp"
#include "tests/cut/random/seeded_runs.hpp"
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

// Ground that is off by about the tolerance has a thousand slivers on and under it: what looks through them covers each area that it
// starts from once. Areas are clipped to the tolerance along their edges.
TEST(Terrains, AreSeenThroughSliversOnce) {
  for (const unsigned seed : {1001u, 1002u, 1253u}) {
    SCOPED_TRACE(seed);
    const Blocks blocks = cut(jittered(terrain_model(seed, 60).model, 1e-7, 1));
    const Complex& complex = *blocks.cutting.complex;
    struct Covered {
      Real area = 0, edges = 0;
    };
    std::map<Index, Covered> by_start;
    for (const Beam& b : complex.beams) {
      if (b.start == none) continue;
      Covered& covered = by_start[b.start];
      covered.area += b.area;
      for (std::size_t k = 0; k < b.polygon.size(); ++k)
        covered.edges += norm(b.polygon[k] - b.polygon[(k + 1) % b.polygon.size()]);
    }
    EXPECT_FALSE(by_start.empty());
    for (const auto& [start, covered] : by_start)
      EXPECT_NEAR(covered.area, complex.fragments[start / 2].area,
                  complex.planes.width_tolerance() * covered.edges);
  }
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
