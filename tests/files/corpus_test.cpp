// What fuzzing has found worth keeping (tests/fuzz), through the readers of every build.
#include <fstream>
#include <iterator>

#include "tests/files/fuzzed_readers.hpp"
#include "tests/files/sample_files.hpp"

namespace rockfold {

namespace {

struct Outcome {
  std::size_t refused = 0, read = 0;
};

/// Ends the program, as under the fuzzer, where a reader does not hold its promises.
Outcome outcome_of(const char* corpus, Fuzzed (*read)(std::string_view)) {
  Outcome outcome;
  const auto folder = std::filesystem::path(ROCKFOLD_SOURCE_DIR) / "tests/fuzz" / corpus;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    SCOPED_TRACE(entry.path().string());
    ++(read(bytes) == Fuzzed::read ? outcome.read : outcome.refused);
  }
  return outcome;
}

}  // namespace

TEST(Corpus, OfMeshesIsRefusedOrReadSoundly) {
  const auto outcome = outcome_of("corpus_mesh", read_fuzzed_mesh);
  EXPECT_GT(outcome.refused, 100u);
  EXPECT_GT(outcome.read, 20u);
}

TEST(Corpus, OfTerrainsAndTablesIsRefusedOrReadSoundly) {
  const auto outcome = outcome_of("corpus_grid", read_fuzzed_grid);
  EXPECT_GT(outcome.refused, 100u);
  EXPECT_GT(outcome.read, 20u);
}

}  // namespace rockfold
