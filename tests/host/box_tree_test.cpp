// Boxes found by a tree against all of them tried one by one.
#include "host/box_tree.hpp"

#include <random>

#include <gtest/gtest.h>

namespace rockfold::test {
namespace {

/// Boxes of all sizes off the origin: many overlap, some are flat.
std::vector<Bounds> random_boxes(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> place(3, 13), size(0, 1.5);
  std::vector<Bounds> boxes(count);
  for (int i = 0; i < count; ++i)
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = place(random);
      boxes[i].max[d] = boxes[i].min[d] + (i % 5 == d ? 0 : size(random));
    }
  return boxes;
}

bool holds(const Bounds& box, const Vec3& x) {
  for (int d = 0; d < 3; ++d)
    if (x[d] < box.min[d] || x[d] > box.max[d]) return false;
  return true;
}

TEST(BoxTree, FindsTheBoxesThatHoldAPoint) {
  const std::vector<Bounds> boxes = random_boxes(700);
  const BoxTree tree(boxes);
  std::vector<Vec3> points;
  for (const Bounds& box : boxes) {
    points.push_back(box.min);
    points.push_back(box.max);
    points.push_back({box.min[0], box.max[1], 0.5 * (box.min[2] + box.max[2])});
  }
  for (const Vec3& x : points) {
    std::vector<Index> expected;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (holds(boxes[i], x)) expected.push_back(static_cast<Index>(i));
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(tree.at(x), expected);
  }
}

TEST(BoxTree, FindsTheBoxesThatMeetABox) {
  const std::vector<Bounds> boxes = random_boxes(700);
  const BoxTree tree(boxes);
  const auto meet = [](const Bounds& a, const Bounds& b) {
    for (int d = 0; d < 3; ++d)
      if (a.max[d] < b.min[d] || b.max[d] < a.min[d]) return false;
    return true;
  };
  std::vector<Index> found;
  for (const Bounds& box : boxes) {
    std::vector<Index> expected;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (meet(box, boxes[i])) expected.push_back(static_cast<Index>(i));
    tree.near(box, found);
    EXPECT_EQ(found, expected);
    // A box that only touches it.
    tree.near({box.max, box.max}, found);
    EXPECT_EQ(found, tree.at(box.max));
  }
}

TEST(BoxTree, FindsNothingBeyondAllBoxes) {
  std::vector<Index> found{1};
  BoxTree(random_boxes(50)).near({{20, 5, 5}, {21, 6, 6}}, found);
  EXPECT_TRUE(found.empty());
  BoxTree().near({{0, 0, 0}, {9, 9, 9}}, found);
  EXPECT_TRUE(found.empty());
  EXPECT_TRUE(BoxTree(random_boxes(50)).at({20, 5, 5}).empty());
  EXPECT_TRUE(BoxTree().at({5, 5, 5}).empty());
}

}  // namespace
}  // namespace rockfold::test
