#include "host/direct/front_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "host/direct/order.hpp"

namespace rockfold::host {
namespace {

/// Where the entries of a box of n × n × n rows stand, each coupled to its 26 neighbours.
BlockMatrix box_pattern(Index n, int width) {
  BlockMatrix a;
  a.width = width;
  a.begin = {0};
  for (Index z = 0; z < n; ++z)
    for (Index y = 0; y < n; ++y)
      for (Index x = 0; x < n; ++x) {
        for (Index k = std::max(z - 1, 0); k <= std::min(z + 1, n - 1); ++k)
          for (Index j = std::max(y - 1, 0); j <= std::min(y + 1, n - 1); ++j)
            for (Index i = std::max(x - 1, 0); i <= std::min(x + 1, n - 1); ++i)
              a.column.push_back(i + n * (j + n * k));
        a.begin.push_back(static_cast<Index>(a.column.size()));
      }
  return a;
}

void expect_each_once(std::vector<Index> places, Index count) {
  std::sort(places.begin(), places.end());
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(places, all);
}

TEST(Orders, GiveEachRowAPlace) {
  for (const Index n : {1, 2, 7}) {
    const BlockMatrix a = box_pattern(n, 3);
    expect_each_once(order_by_degree(a), a.rows());
    expect_each_once(order_by_dissection(a), a.rows());
  }
  BlockMatrix apart;  // rows that nothing couples
  apart.width = 3;
  for (Index i = 0; i < 500; ++i) apart.begin.push_back(i), apart.column.push_back(i);
  apart.begin.push_back(500);
  expect_each_once(order_by_dissection(apart), 500);
}

TEST(FrontTree, VisitsEachFrontAfterThoseBelow) {
  const FrontTree tree = make_front_tree(box_pattern(14, 3));
  EXPECT_GT(tree.subtree.size(), 8U);
  std::vector<Index> visited;
  for (const auto& [from, to] : tree.subtree)
    for (Index f = from; f < to; ++f) {
      visited.push_back(f);
      for (Index c = tree.child_begin[f]; c < tree.child_begin[f + 1]; ++c)
        EXPECT_GE(tree.child[c], from);
    }
  EXPECT_TRUE(std::is_sorted(tree.top.begin(), tree.top.end()));
  visited.insert(visited.end(), tree.top.begin(), tree.top.end());
  expect_each_once(visited, tree.fronts());
}

TEST(FrontTree, KnowsWhereRowsStandInTheParent) {
  const FrontTree tree = make_front_tree(box_pattern(8, 3));
  for (Index f = 0; f < tree.fronts(); ++f)
    for (Index m = tree.handed_on(f); m < tree.begin[f + 1]; ++m)
      EXPECT_EQ(tree.row[tree.begin[tree.parent[f]] + tree.in_parent[m]], tree.row[m]);
}

/// Nested dissection of a box takes in proportion to n⁶ (George 1973): twice as wide, 64 times as many, but for what its first levels save.
TEST(FrontTree, OfABoxTakesOperationsAsDissectionDoes) {
  const double small = make_front_tree(box_pattern(10, 3)).operations,
               large = make_front_tree(box_pattern(20, 3)).operations;
  EXPECT_LE(std::log2(large / small), 6.5);
}

}  // namespace
}  // namespace rockfold::host
