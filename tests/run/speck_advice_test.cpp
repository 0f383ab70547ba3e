// What a run that stops says of tiny blocks.
#include "src/run/speck_advice.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

BlockArrays blocks_of(std::vector<Real> volume) {
  BlockArrays blocks;
  blocks.volume = std::move(volume);
  return blocks;
}

TEST(SpeckAdvice, NamesTheBlockInTroubleOrElseTheSmallest) {
  const BlockArrays one = blocks_of({10, 9e-9, 20});
  EXPECT_EQ(speck_advice(one, {}, 0),
            ". Block 2 has 9e-09 m3, less than a millionth of the mean block's 10 m3: "
            "cut.specks = \"merge\" joins such blocks to their neighbours");
  const BlockArrays two = blocks_of({10, 9e-9, 20, 8e-9});
  EXPECT_NE(speck_advice(two, {}, 1).find("Block 2 has 9e-09 m3"), std::string::npos);
  EXPECT_NE(speck_advice(two, {}, 2).find("Block 4 has 8e-09 m3"), std::string::npos);
  EXPECT_NE(speck_advice(two, {}, none).find("(and so has 1 other)"), std::string::npos);
}

TEST(SpeckAdvice, IsSilentOfBlocksThatAreNoSpecks) {
  EXPECT_EQ(speck_advice(blocks_of({10, 9e-5, 20}), {}, 1), "");
  EXPECT_EQ(speck_advice(blocks_of({}), {}, none), "");
  CutSpec merged;
  merged.specks = Specks::merge;
  EXPECT_NE(speck_advice(blocks_of({10, 9e-9, 20}), merged, 1)
                .find("has left it, a larger cut.min_volume may not"),
            std::string::npos);
}

}  // namespace
}  // namespace rockfold
