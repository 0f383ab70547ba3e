// Grouping is the same on any number of threads.
#include "host/flatten/grouping.hpp"

#include <gtest/gtest.h>
#include <omp.h>

namespace rockfold::test {
namespace {

TEST(Grouping, OfTheHeadersExample) {
  const Index group[] = {1, 0, none, 1};
  const Grouping grouping = group_items(4, 2, [&](Index i) { return group[i]; });
  EXPECT_EQ(grouping.begin, (std::vector<Index>{0, 1, 3}));
  EXPECT_EQ(grouping.item, (std::vector<Index>{1, 0, 3}));
}

TEST(Grouping, KeepsTheOrderOfItemsOnAnyNumberOfThreads) {
  constexpr Index items = 5003, groups = 97;
  const auto group_of = [](Index i) { return i % 5 == 0 ? none : (i * 31 + i / 7) % (groups - 1); };
  std::vector<std::vector<Index>> expected(groups);  // the last one stays empty
  for (Index i = 0; i < items; ++i)
    if (group_of(i) != none) expected[group_of(i)].push_back(i);
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3, 11}) {
    omp_set_num_threads(threads);
    const Grouping grouping = group_items(items, groups, group_of);
    for (Index g = 0; g < groups; ++g)
      EXPECT_EQ(std::vector<Index>(grouping[g].begin(), grouping[g].end()), expected[g]);
  }
  omp_set_num_threads(before);
}

TEST(Grouping, OfNothing) {
  const Grouping grouping = group_items(0, 0, [](Index) { return none; });
  EXPECT_EQ(grouping.begin, std::vector<Index>{0});
  EXPECT_TRUE(grouping.item.empty());
}

}  // namespace
}  // namespace rockfold::test
