#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "host/flatten/winding_outline_exact.hpp"

namespace rockfold::test {
namespace {

using Plan = WindingOutline::Plan;

/// A closed loop drawn through vertices in any order.
struct Drawing {
  Plan plan;
  WindingOutline outline;

  Drawing(const std::vector<std::array<int, 2>>& corners, std::size_t bends)
      : outline(plan, bends) {
    std::vector<Plan::Vertex_handle> vertex;
    for (const auto& [x, y] : corners) {
      vertex.push_back(plan.insert(Plan::Point(x, y)));
      vertex.back()->info() = 100 * x + y;
    }
    for (std::size_t i = 0; i < vertex.size() && plan.dimension() == 2; ++i)
      outline.draw(vertex[i], vertex[(i + 1) % vertex.size()], 1);
  }
  std::vector<std::array<Index, 3>> inside() {
    return triangles_above(
        plan, [&](int here, auto face, int k) { return outline.across(here, face, k); });
  }
};

TEST(WindingOutline, CountsHowOftenALoopWindsAround) {
  Drawing twice({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {9, 0}, {9, 9}, {0, 9}}, 0);
  EXPECT_EQ(twice.inside().size(), 2u);
  for (const auto face : twice.plan.finite_face_handles()) EXPECT_EQ(face->info(), 2);
  Drawing reversed({{0, 9}, {9, 9}, {9, 0}, {0, 0}}, 0);
  EXPECT_TRUE(reversed.inside().empty());
  for (const auto face : reversed.plan.finite_face_handles()) EXPECT_EQ(face->info(), -1);
}

TEST(WindingOutline, BendsAnEdgeToTheVertexThatItNearlyMeets) {
  Drawing drawing({{0, 0}, {90, 0}, {90, 90}, {45, -1}, {0, 90}}, 2);
  EXPECT_EQ(drawing.inside().size(), 2u);  // below (45, −1) nothing: both halves end there
}

/// So that the level of a triangle does not depend on the way to it.
TEST(WindingOutline, StaysClosedHoweverManyEdgesCross) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::array<int, 2>> corners(3 + random() % 20);
    for (auto& c : corners) c = {static_cast<int>(random() % 10), static_cast<int>(random() % 10)};
    Drawing drawing(corners, seed % 8);
    drawing.inside();
    if (drawing.plan.dimension() < 2) continue;
    for (const auto face : drawing.plan.all_face_handles())
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(face->neighbor(k)->info(), drawing.outline.across(face->info(), face, k))
            << "seed " << seed;
  }
}

}  // namespace
}  // namespace rockfold::test
