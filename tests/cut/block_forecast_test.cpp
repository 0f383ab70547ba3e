// About how many blocks joints make, before they cut.
#include "host/cut/block_forecast.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/cut/ask_about_blocks.hpp"
#include "host/cut/cut.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {
namespace {

ForecastRegion cube(Real size, Real filled = 1) {
  ForecastRegion region;
  region.box.add(Vec3{0, 0, 0});
  region.box.add(Vec3{size, size, size});
  region.volume = filled * size * size * size;
  return region;
}

/// `n` planes across each axis of a cube, evenly.
std::vector<ForecastJoint> grid(int n, Real size) {
  std::vector<ForecastJoint> joints;
  for (const Vec3& normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    for (int i = 1; i <= n; ++i) joints.push_back({normal, size * i / (n + 1)});
  return joints;
}

}  // namespace

/// n planes across each axis cut (n + 1)³ cells.
TEST(BlockForecast, OfAGridIsItsCells) {
  EXPECT_EQ(forecast_blocks({}, {cube(10)}), 1);
  EXPECT_EQ(forecast_blocks(grid(1, 10), {cube(10)}), 8);
  EXPECT_EQ(forecast_blocks(grid(9, 10), {cube(10)}), 1000);
  EXPECT_NEAR(forecast_blocks(grid(99, 10), {cube(10)}), 1e6, 0.03e6) << "drawn, not counted";
}

TEST(BlockForecast, CountsInTheRockAlone) {
  EXPECT_EQ(forecast_blocks(grid(1, 10), {cube(4)}), 1 + 3)
      << "planes, but no lines or points in the rock";
  EXPECT_EQ(forecast_blocks(grid(1, 10), {cube(10, 0.5)}), 1 + 3 + 3 + 0.5);
}

TEST(BlockForecast, CountsDiscsWhereTheyMeet) {
  auto joints = grid(1, 10);
  for (ForecastJoint& joint : joints) {
    joint.middle = {5, 5, 5};
    joint.radius = 1;
  }
  EXPECT_EQ(forecast_blocks(joints, {cube(10)}), 2) << "they meet in one point";
  for (ForecastJoint& joint : joints) joint.middle = {5, 5, 7};
  EXPECT_EQ(forecast_blocks(joints, {cube(10)}), 1);
}

/// Ten thousand discs of which next to none meet: no estimate from a draw or two.
TEST(BlockForecast, OfFewDrawsThatMeetIsSmall) {
  std::mt19937_64 random(3);
  const auto draw = [&](Real size) { return size * static_cast<Real>(random() >> 11) * 0x1p-53; };
  std::vector<ForecastJoint> discs;
  for (int i = 0; i < 10'000; ++i) {
    const Vec3 normal = normalized(Vec3{draw(2) - 1, draw(2) - 1, draw(1)});
    const Vec3 middle{draw(100), draw(100), draw(100)};
    discs.push_back({normal, dot(normal, middle), middle, 2});
  }
  EXPECT_LT(forecast_blocks(discs, {cube(100)}), blocks_without_asking);
}

/// Planes through a cube at random: what the cutting makes of them.
TEST(BlockForecast, IsNearWhatTheCuttingMakes) {
  std::mt19937_64 random(5);
  const auto draw = [&](Real size) { return size * static_cast<Real>(random() >> 11) * 0x1p-53; };
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  JointTable table;
  table.name = "map";
  table.place = {"m.toml", 7, 1, "joint_table[1]"};
  for (int i = 0; i < 40; ++i)
    table.rows.push_back({{draw(90), draw(360)},
                          {draw(10), draw(10), draw(10)},
                          std::numeric_limits<Real>::infinity()});
  model.joint_tables.push_back(table);
  const Blocks blocks = cut(model);
  const auto cells = static_cast<Real>(blocks.cutting.totals.cells);
  ASSERT_GT(cells, 1000);
  try {
    check_cutting(model, {}, 1000);
    FAIL() << "nothing is asked";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::model);
    const Diagnostic& told = error.diagnostics().front();
    EXPECT_EQ(told.place.line, 7);
    EXPECT_EQ(told.place.key, "joint_table[1]");
    EXPECT_NE(told.message.find(about_blocks(cells)), std::string::npos) << told.message << cells;
    for (const char* part : {"40 of the 40 joints are rows of table \"map\"", "--yes",
                             "cut.max_cells", "within", "trace lengths"})
      EXPECT_NE(told.message.find(part), std::string::npos) << told.message;
  }
  EXPECT_NO_THROW(check_cutting(model, {}, 2 * cells));
  EXPECT_NO_THROW(check_cutting(model, {}));
}

TEST(BlockForecast, IsSaidInTwoDigits) {
  EXPECT_EQ(about_blocks(1'088'564), "about 1,100,000");
  EXPECT_EQ(about_blocks(123'456), "about 120,000");
  EXPECT_EQ(about_blocks(7), "about 7");
}

}  // namespace rockfold::test
