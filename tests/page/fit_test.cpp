// The numbers of a page: the motion of blocks from that of their points, and packing.
#include <cmath>

#include <gtest/gtest.h>

#include "src/io/hdf5/deflate.hpp"
#include "src/page/block_motion_fit.hpp"
#include "src/page/page_arrays.hpp"

namespace rockfold {
namespace {

/// A skew tetrahedron far from the origin, and a second one: u = d + G (x − c) with a G without symmetry.
PageSurface two_blocks() {
  PageSurface surface;
  surface.block = {3, 8};
  surface.point_begin = {0, 4, 8};
  surface.point = {{1000, -5, 2}, {1003, -4, 2.5}, {1001, 0, 3}, {999, -6, 7},
                   {-20, 4, 4},   {-18, 4, 5},     {-20, 9, 4},  {-21, 5, 8}};
  return surface;
}

std::vector<float> moved(const PageSurface& surface, const std::vector<Vec3>& middle) {
  const Mat3 gradient{{{0.01, -0.2, 0.03}, {0.2, 0.02, -0.05}, {0.04, 0.06, -0.01}}};
  std::vector<float> u;
  for (std::size_t p = 0; p < surface.point.size(); ++p)
    for (int i = 0; i < 3; ++i) {
      Real value = 0.5 * (i + 1) * (p < 4 ? 1 : -2);
      for (int j = 0; j < 3; ++j)
        value += gradient[i][j] * (surface.point[p][j] - middle[p < 4 ? 0 : 1][j]);
      u.push_back(static_cast<float>(value));
    }
  return u;
}

TEST(BlockMotionFit, FindsAnAffineMotionAndMissesNothing) {
  const PageSurface surface = two_blocks();
  const auto middle = block_middles(surface);
  EXPECT_NEAR(middle[0][0], 1000.75, 1e-12);
  const FittedMotion fitted = fit_block_motions(surface, middle, moved(surface, middle));
  // Single precision of values about 3 m.
  EXPECT_LT(fitted.miss, 1e-6);
  ASSERT_EQ(fitted.block.size(), 2u);
  EXPECT_NEAR(fitted.block[0][1], 1.0, 1e-6);
  EXPECT_NEAR(fitted.block[1][2], -3.0, 1e-6);
  EXPECT_NEAR(fitted.block[1][3 + 1], -0.2, 1e-6);      // G xy
  EXPECT_NEAR(fitted.block[0][3 + 6 + 1], 0.06, 1e-6);  // G zy
}

TEST(BlockMotionFit, TellsHowFarABendingBlockIsMissed) {
  PageSurface surface = two_blocks();
  surface.block = {3};
  surface.point_begin = {0, 5};
  surface.point = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  std::vector<float> u(15, 0.0f);
  u[14] = 0.4f;  // the fifth point goes up: of a flat face no affine motion does that
  const FittedMotion fitted = fit_block_motions(surface, block_middles(surface), u);
  EXPECT_GT(fitted.miss, 0.05);
  EXPECT_LT(fitted.miss, 0.4);
}

TEST(PageArrays, HaveBytesOfEqualSignificanceSideBySide) {
  PageArrays arrays;
  arrays.add("a", std::vector<std::uint16_t>{0x0102, 0x0304});
  arrays.add_smooth("b", std::vector<std::int16_t>{100, 90, -30000});
  ASSERT_EQ(arrays.list().size(), 2u);
  EXPECT_EQ(arrays.list()[0].shuffled, (std::vector<std::uint8_t>{2, 4, 1, 3}));
  EXPECT_EQ(arrays.list()[0].type, "uint16");
  // 100, −10, −30090 in two bytes
  EXPECT_EQ(arrays.list()[1].shuffled, (std::vector<std::uint8_t>{100, 0xF6, 0x76, 0, 0xFF, 0x8A}));
  EXPECT_EQ(arrays.bytes(), 10u);
}

TEST(Base64, OfTheLengthsOfRfc4648) {
  const auto of = [](std::string_view text) {
    return base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace rockfold
