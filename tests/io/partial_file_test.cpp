// What becomes of files that are being written when a signal ends the program at once.
#include "src/io/partial_file.hpp"

#include <csignal>
#include <fstream>
#include <optional>

#include <gtest/gtest.h>

#include "host/flatten/face_polygons.hpp"
#include "src/io/result_file.hpp"
#include "tests/io/sample.hpp"

namespace rockfold::test {
namespace {

using Names = std::vector<std::string>;

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

TEST(PartialFiles, WithoutAnythingWorthKeepingAreRemoved) {
  const TemporaryFolder folder;
  write_file(folder / "a.vtkhdf", "older");
  ResultWriter writer(folder / "a.vtkhdf", sample_model(), sample_header());
  writer.write_blocks(box_grid(2, 1, 1), face_polygons(box_grid(2, 1, 1)));
  const PartialFile text(folder / "b.stl");
  write_file(text.aside(), "solid");
  EXPECT_FALSE(settle_partial_files());
  EXPECT_EQ(folder.names(), Names{"a.vtkhdf"});
  EXPECT_EQ(file_bytes(folder / "a.vtkhdf"), "older");
}

TEST(PartialFiles, ThatHoldStatesTakeTheirNamesInPlaceOfOlderResults) {
  const TemporaryFolder folder;
  for (const char* older : {"a.vtkhdf", "a.xdmf"}) write_file(folder / older, "older");
  const BlockArrays blocks = box_grid(2, 1, 1);
  ResultWriter writer(folder / "a.vtkhdf", sample_model(), sample_header());
  write_sample(writer, blocks, lattice_with_cut(1), {0, 1});
  EXPECT_TRUE(settle_partial_files());
  EXPECT_EQ(folder.names(), Names{"a.vtkhdf"});
  EXPECT_EQ(read_result_info(folder / "a.vtkhdf").time.size(), 2u);
}

TEST(PartialFiles, WithTheirNamesAreLeftAlone) {
  const TemporaryFolder folder;
  PartialFile text(folder / "b.stl");
  write_file(text.aside(), "solid");
  text.take_name();
  EXPECT_FALSE(settle_partial_files());
  EXPECT_EQ(folder.names(), Names{"b.stl"});
}

volatile std::sig_atomic_t seen = 0;

TEST(SignalsWait, HoldsThemBackWhileItLives) {
  const auto before = std::signal(SIGTERM, [](int) { seen = 1; });
  std::optional<SignalsWait> wait(std::in_place);
  std::raise(SIGTERM);
  EXPECT_EQ(seen, 0);
  wait.reset();
  EXPECT_EQ(seen, 1);
  std::signal(SIGTERM, before);
}

}  // namespace
}  // namespace rockfold::test
