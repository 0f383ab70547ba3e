// Contours on grids: areas of closed forms, and levels that read well.
#include "src/report/drawings/contours.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace rockfold {
namespace {

/// Positive where a loop turns to the left, y up.
Real area_of(const std::vector<Point2>& loop) {
  Real twice = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Point2 &p = loop[k], &q = loop[(k + 1) % loop.size()];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

template <class Function>
ContourGrid grid_of(std::size_t size, Real step, const Function& f) {
  ContourGrid grid{size, {-1, -2}, step, {}};
  for (std::size_t j = 0; j < size; ++j)
    for (std::size_t i = 0; i < size; ++i)
      grid.value.push_back(f(-1 + step * static_cast<Real>(i), -2 + step * static_cast<Real>(j)));
  return grid;
}

}  // namespace

/// A ring with radii 0.5 and 0.8 about (0.1, −0.9): an outer loop to the left, an inner one to the right. The distance is not linear
/// on an edge of length h, so that its crossing is off by less than h²/8 over the inner radius: 1.3e-5 m of 0.5 m.
TEST(Contours, AroundARingHaveItsAreas) {
  const ContourGrid grid = grid_of(301, 0.0072, [](Real x, Real y) {
    return 0.15 - std::abs(std::hypot(x - 0.1, y + 0.9) - 0.65);
  });
  auto loops = contour_loops(grid, 0);
  ASSERT_EQ(loops.size(), 2u);
  if (area_of(loops[0]) < 0) std::swap(loops[0], loops[1]);
  EXPECT_NEAR(area_of(loops[0]), std::numbers::pi * 0.64, 1e-3);
  EXPECT_NEAR(area_of(loops[1]), -std::numbers::pi * 0.25, 1e-3);
}

/// Two high corners across a square: apart where the mean is low, joined where it is high.
TEST(Contours, JoinOppositeCornersByTheirMean) {
  const auto loops_with = [](Real high) {
    ContourGrid grid{4, {0, 0}, 1, std::vector<Real>(16, 0)};
    grid.value[5] = grid.value[10] = high;
    return contour_loops(grid, 1).size();
  };
  EXPECT_EQ(loops_with(1.5), 2u);
  EXPECT_EQ(loops_with(3), 1u);
}

TEST(ContourLevels, AreRoundAndFew) {
  EXPECT_EQ(contour_levels(13.2), (std::vector<Real>{2, 4, 6, 8, 10, 12}));
  EXPECT_EQ(contour_levels(7.5), (std::vector<Real>{1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(contour_levels(1.9), (std::vector<Real>{0.5, 1, 1.5}));
  EXPECT_TRUE(contour_levels(0).empty());
}

}  // namespace rockfold
