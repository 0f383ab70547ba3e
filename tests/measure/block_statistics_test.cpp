#include "host/measure/block_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/measure/one_block.hpp"

namespace rockfold::test {
namespace {

/// β as it is defined: over all ordered pairs of chords no shorter than the median.
Real beta_by_pairs(const std::vector<Vec3>& points) {
  std::vector<Vec3> chords;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) chords.push_back(points[j] - points[i]);
  std::sort(chords.begin(), chords.end(),
            [](const Vec3& a, const Vec3& b) { return norm(a) < norm(b); });
  const std::size_t n = chords.size();
  const Real median = 0.5 * (norm(chords[(n - 1) / 2]) + norm(chords[n / 2]));
  Real above = 0, below = 0;
  for (const Vec3& a : chords)
    for (const Vec3& b : chords) {
      if (norm(a) < median * (1 - 1e-12) || norm(b) < median * (1 - 1e-12)) continue;
      above += dot(a, b) * dot(a, b);
      below += dot(a, a) * dot(b, b);
    }
  return 10 * std::pow(above / below, 2);
}

Real alpha_by_chords(const std::vector<Vec3>& points, Real area, Real volume) {
  Real sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) sum += norm(points[j] - points[i]), ++count;
  return area * sum / count / (7.7 * volume);
}

/// By hand: 28 chords, 12 edges, 12 diagonals of faces, 4 of the body; those from the median on are the diagonals.
TEST(BlockShapes, OfACube) {
  const Real chord = (12 + 12 * std::sqrt(2.0) + 4 * std::sqrt(3.0)) / 28;
  for (const Mat3& turned : {identity, oblique()}) {
    const BlockShape shape = block_shapes(box_block({3, 3, 3}, turned, {1e4, -2e4, 500}))[0];
    EXPECT_NEAR(shape.surface_area, 54, 1e-7);
    EXPECT_NEAR(shape.alpha, 6 * chord / 7.7, 1e-9);
    EXPECT_NEAR(shape.beta, 10.0 / 9, 1e-9);
    EXPECT_NEAR(shape.aspect_ratio, 1, 1e-9);
    EXPECT_EQ(shape_class(shape.alpha, shape.beta), ShapeClass::cubic);
  }
}

TEST(BlockShapes, OfARodAndOfAPlate) {
  const BlockShape rod = block_shapes(box_block({1, 1, 100}, oblique(), {0, 0, 0}))[0];
  EXPECT_NEAR(rod.beta, 10, 0.02);
  EXPECT_NEAR(rod.aspect_ratio, 100, 1e-7);
  EXPECT_EQ(shape_class(rod.alpha, rod.beta), ShapeClass::elongated);
  const BlockShape plate = block_shapes(box_block({1, 20, 20}, oblique(), {0, 0, 0}))[0];
  EXPECT_GT(plate.alpha, 5);
  EXPECT_NEAR(plate.beta, 2.5, 0.1);  // all directions of a plane: 10·(1/2)²
  EXPECT_NEAR(plate.aspect_ratio, 20, 1e-8);
  EXPECT_EQ(shape_class(plate.alpha, plate.beta), ShapeClass::platy);
}

/// Irregular and off the origin, against the definition with all pairs of chords.
TEST(BlockShapes, OfIrregularBoxesAreThoseOfTheDefinition) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> size(0.1, 5);
  for (int n = 0; n < 50; ++n) {
    const Vec3 edge{size(random), size(random), size(random)};
    const BlockArrays block = box_block(edge, oblique(), {12, -7, 3});
    const BlockShape shape = block_shapes(block)[0];
    EXPECT_NEAR(shape.beta, beta_by_pairs(block.vertex), 1e-9);
    EXPECT_NEAR(shape.alpha, alpha_by_chords(block.vertex, shape.surface_area, block.volume[0]),
                1e-9 * shape.alpha);
    EXPECT_NEAR(
        shape.aspect_ratio,
        *std::max_element(edge.begin(), edge.end()) / *std::min_element(edge.begin(), edge.end()),
        1e-7);
  }
}

/// A prism over a regular polygon of 3,000 sides has 18 million chords; those of 200 vertices tell as much.
TEST(BlockShapes, OfABlockOfManyVerticesAreSampled) {
  const BlockArrays round = prism_block(3000, 1, 2);
  const BlockShape shape = block_shapes(round)[0];
  std::vector<Vec3> some;
  for (std::size_t v = 0; v < round.vertex.size(); v += 61) some.push_back(round.vertex[v]);
  EXPECT_NEAR(shape.beta, beta_by_pairs(some), 0.04 * shape.beta);
  EXPECT_NEAR(shape.alpha, alpha_by_chords(some, shape.surface_area, round.volume[0]),
              0.04 * shape.alpha);
}

TEST(ShapeClasses, AreThoseOfTheDiagram) {
  EXPECT_EQ(shape_class(1, 1), ShapeClass::cubic);
  EXPECT_EQ(shape_class(2, 3.9), ShapeClass::platy_cubic);
  EXPECT_EQ(shape_class(5, 1), ShapeClass::platy);
  EXPECT_EQ(shape_class(2.9, 4), ShapeClass::cubic_elongated);
  EXPECT_EQ(shape_class(3, 6.9), ShapeClass::elongated_platy);
  EXPECT_EQ(shape_class(1, 7), ShapeClass::elongated);
}

/// Ten blocks of 30 m³ in all: 1 1 1 1 1 1 2 4 8 10.
TEST(BlockStatistics, HavePercentilesByNumberAndByVolume) {
  const BlockArrays blocks = cubes({1, 8, 1, 1, 4, 1, 10, 1, 2, 1});
  const BlockStatistics s = block_statistics(blocks, {});
  EXPECT_DOUBLE_EQ(s.volume, 30);
  EXPECT_DOUBLE_EQ(s.mean_volume, 3);
  EXPECT_EQ(s.volume_by_number, (Percentiles{1, 1, 1, 4, 8, 10}));
  EXPECT_EQ(s.volume_by_volume, (Percentiles{1, 2, 8, 10, 10, 10}));  // sums 6, 8, 12, 20, 30
  for (std::size_t p = 0; p < percentiles.size(); ++p)
    EXPECT_DOUBLE_EQ(s.size_by_volume[p], std::cbrt(s.volume_by_volume[p]));
  EXPECT_TRUE(s.flags.empty());
}

TEST(BlockStatistics, HaveAHistogramThatHoldsEveryBlock) {
  const BlockArrays blocks = cubes({1, 1 - 1e-13, 1.5, 1e-3, 20});
  const BlockStatistics s = block_statistics(blocks, {});
  ASSERT_EQ(s.histogram.size(), 22u);  // 10^(-15/5) … 10^(7/5)
  EXPECT_NEAR(s.histogram.front().from, 1e-3, 1e-15);
  EXPECT_EQ(s.histogram.front().blocks, 1);
  EXPECT_EQ(s.histogram[15].blocks, 3);  // 1 to 1.58; rounding puts no block of 1 m³ below
  EXPECT_NEAR(s.histogram[15].volume, 3.5, 1e-9);
  Index blocks_in_all = 0;
  for (std::size_t k = 0; k < s.histogram.size(); ++k) {
    blocks_in_all += s.histogram[k].blocks;
    if (k > 0) {
      EXPECT_EQ(s.histogram[k].from, s.histogram[k - 1].to);
    }
  }
  EXPECT_EQ(blocks_in_all, 5);
}

TEST(BlockStatistics, FlagWhatTheModelAsksFor) {
  BlockArrays blocks = cubes({0.5, 2, 3});
  CutSpec spec;
  spec.min_volume = 1.0;
  BlockStatistics s = block_statistics(blocks, spec);
  EXPECT_EQ(s.flags, (std::vector<std::uint8_t>{flag_small_volume, 0, 0}));
  EXPECT_EQ(s.small_blocks, 1);
  EXPECT_EQ(s.elongated_blocks, 0);
  spec = {};
  spec.max_aspect_ratio = 5.0;
  s = block_statistics(box_block({1, 1, 5.1}, oblique(), {0, 0, 0}), spec);
  EXPECT_EQ(s.flags, (std::vector<std::uint8_t>{flag_elongated}));
  s = block_statistics(box_block({1, 1, 4.9}, oblique(), {0, 0, 0}), spec);
  EXPECT_EQ(s.flags, (std::vector<std::uint8_t>{0}));
}

/// Four blocks in a row: the first goes at stage 2, the second at 1, the third and fourth stay.
TEST(StageReports, TellWhatGoesAndWhatItLaysOpen) {
  BlockArrays blocks = cubes({1, 2, 3, 4});
  blocks.stage = {2, 1, 0, 0};
  blocks.interfaces = {{{0, 1}, {0, 6}, 10}, {{1, 2}, {7, 12}, 20}, {{2, 3}, {13, 18}, 40}};
  Model model;
  model.excavations.resize(3);
  model.excavations[0].stage = 1;
  model.excavations[1].stage = 2;
  model.excavations[2].stage = 5;  // overlapped by the others
  const auto reports = stage_reports(blocks, model);
  ASSERT_EQ(reports.size(), 3u);
  EXPECT_EQ(reports[0].stage, 1);
  EXPECT_EQ(reports[0].blocks, 1);
  EXPECT_EQ(reports[0].volume, 2);
  EXPECT_EQ(reports[0].new_free_area, 30);
  EXPECT_EQ(reports[1].volume, 1);
  EXPECT_EQ(reports[1].new_free_area, 0);
  EXPECT_EQ(reports[2].stage, 5);
  EXPECT_EQ(reports[2].blocks, 0);
}

TEST(StageReports, AreNoneWithoutExcavations) {
  EXPECT_TRUE(stage_reports(cubes({1, 2}), Model{}).empty());
}

}  // namespace
}  // namespace rockfold::test
