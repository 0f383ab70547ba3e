// Two sides of a joint that slivers show as parts of different faces: contact adds up to the area of each.
#include "host/flatten/balance_contacts.hpp"

#include <gtest/gtest.h>

#include "host/flatten/lost_contact.hpp"

namespace rockfold {
namespace {

using Interface = BlockArrays::Interface;

/// Two blocks with three faces each on one joint, the last of which look elsewhere; m².
BlockArrays two_blocks(const std::vector<Real>& areas, std::vector<Interface> interfaces) {
  BlockArrays blocks;
  blocks.face_begin = {0, 3, 6};
  blocks.volume = {1, 1};
  blocks.face_area = areas;
  blocks.face_origin.assign(6, 0);
  const Vec3 up{0, 0, 1}, down{0, 0, -1}, east{1, 0, 0}, west{-1, 0, 0};
  blocks.face_normal = {up, up, east, down, down, west};
  blocks.loop_begin = {0, 1, 2, 3, 4, 5, 6};
  blocks.corner_begin = {0, 1, 2, 3, 4, 5, 6};
  blocks.corner_vertex.assign(6, 0);
  blocks.vertex = {{7, 8, 9}};
  blocks.origins = {{.name = "fault"}};
  blocks.interfaces = std::move(interfaces);
  return blocks;
}

Interface between(Index face, Index other, Real area) {
  return {{0, 1}, {face, other}, area};
}

TEST(ContactBalance, MovesWhatAFaceHasTooMuchToTheOneBesideItThatLacksIt) {
  BlockArrays blocks = two_blocks({63, 48, 5, 64.5, 46.5, 5},
                                  {between(0, 3, 63), between(1, 4, 48), between(2, 5, 5)});
  ASSERT_EQ(lost_contact(blocks).size(), 1u);
  balance_contacts(blocks);
  EXPECT_TRUE(lost_contact(blocks).empty());
  ASSERT_EQ(blocks.interfaces.size(), 4u);
  const std::vector<Interface> expected{between(0, 3, 63), between(1, 3, 1.5), between(1, 4, 46.5),
                                        between(2, 5, 5)};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(blocks.interfaces[i].face[0], expected[i].face[0]) << i;
    EXPECT_EQ(blocks.interfaces[i].face[1], expected[i].face[1]) << i;
    EXPECT_DOUBLE_EQ(blocks.interfaces[i].area, expected[i].area) << i;
  }
}

TEST(ContactBalance, MovesNothingToFacesThatDoNotLookAtTheOther) {
  BlockArrays blocks = two_blocks({63, 48, 5, 63, 46.5, 6.5},
                                  {between(0, 3, 63), between(1, 4, 48), between(2, 5, 5)});
  balance_contacts(blocks);
  EXPECT_EQ(blocks.interfaces.size(), 3u);
  const auto lost = lost_contact(blocks);
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0].block, 1);
  EXPECT_DOUBLE_EQ(lost[0].lost, 1.5);
  EXPECT_DOUBLE_EQ(lost[0].surplus, 1.5);
  EXPECT_EQ(lost[0].place, (Vec3{7, 8, 9}));
}

TEST(ContactBalance, InventsNoContact) {
  BlockArrays blocks = two_blocks({63, 48, 5, 63, 48, 5}, {between(0, 3, 60), between(1, 4, 48)});
  balance_contacts(blocks);
  EXPECT_EQ(blocks.interfaces.size(), 2u);
  EXPECT_EQ(lost_contact(blocks).size(), 2u);
}

}  // namespace
}  // namespace rockfold
