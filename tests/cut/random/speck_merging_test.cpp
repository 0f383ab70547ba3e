// Random planes and discs through nearly one point leave specks: what becomes of them, against a search over the blocks that the
// cutting makes where it keeps them.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <omp.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"
#include "tests/reference/sanitized.hpp"

namespace rockfold::test {
namespace {

constexpr Real limit = 1e-4;

// Planes, or discs of 1 to 5 m, that miss one of three points by up to a centimetre, in a box of 10 m.
Model draw_model(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<Real> gauss;
  std::uniform_real_distribution<Real> unit;
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  if (seed % 3 == 0) model.solids[0].continues[seed % 6] = true;
  std::vector<Vec3> points(3);
  for (Vec3& p : points)
    for (int d = 0; d < 3; ++d) p[d] = 1 + 8 * unit(random);
  const unsigned count = 8 + random() % 9;
  for (unsigned i = 0; i < count; ++i) {
    Vec3 at = points[random() % points.size()];
    for (int d = 0; d < 3; ++d) at[d] += 0.01 * gauss(random);
    add_joint(model, Vec3{gauss(random), gauss(random), gauss(random)}, at);
    if (seed % 2 != 0 && i % 2 != 0) model.joints.back().radius = 1 + 4 * unit(random);
  }
  return model;
}

struct Group {
  Real volume = 0;
  Vec3 first{};
  bool finite = true;
  Index lowest = none;  // block
};

using Pairs = std::map<std::pair<Index, Index>, Real>;

// Blocks of a cutting that keeps specks, as groups that grow: the rule of the guide, word by word, over all pairs again and again.
struct Search {
  std::vector<Group> group;
  std::vector<Index> of;  // [blocks]
  Pairs area;

  explicit Search(const BlockArrays& a) {
    for (Index b = 0; b < a.block_count(); ++b) {
      group.push_back({a.volume[b], a.volume[b] * a.centroid[b], a.finite[b] != 0, b});
      of.push_back(b);
    }
    for (const auto& shared : a.interfaces) area[{shared.block[0], shared.block[1]}] += shared.area;
  }

  // The best of all groups for a speck, or none.
  Index best(Index speck, const Pairs& shared) const {
    Index found = none;
    Real most = 0;
    for (Index g = 0; g < static_cast<Index>(group.size()); ++g) {
      const auto at = shared.find(std::minmax(speck, g));
      if (at == shared.end() || (!group[speck].finite && group[g].finite)) continue;
      if (at->second > most) most = at->second, found = g;
    }
    return found;
  }

  void run() {
    while (true) {
      Pairs shared;
      for (const auto& [pair, size] : area)
        if (of[pair.first] != of[pair.second])
          shared[std::minmax(of[pair.first], of[pair.second])] += size;
      std::vector<std::pair<Index, Index>> choices;
      for (Index g = 0; g < static_cast<Index>(group.size()); ++g)
        if (group[g].volume > 0 && group[g].volume < limit)
          if (const Index other = best(g, shared); other != none) choices.emplace_back(g, other);
      if (choices.empty()) return;
      for (const auto& [speck, other] : choices) join(speck, other);
    }
  }

  void join(Index speck, Index other) {
    const Index one = of[group[speck].lowest], two = of[group[other].lowest];
    if (one == two) return;
    Group &into = group[two], &from = group[one];
    into.volume += from.volume;
    into.first += from.first;
    into.finite = into.finite && from.finite;
    from.volume = 0;
    std::replace(of.begin(), of.end(), one, two);
  }
};

// Compares groups with blocks by where they lie.
void expect_same(Search& search, const BlockArrays& merged) {
  std::vector<Index> block_of(search.group.size(), none);
  Index groups = 0;
  for (std::size_t g = 0; g < search.group.size(); ++g) {
    const Group& group = search.group[g];
    if (group.volume == 0) continue;
    ++groups;
    const Vec3 centroid = (1 / group.volume) * group.first;
    for (Index b = 0; b < merged.block_count(); ++b)
      if (norm(merged.centroid[b] - centroid) < 1e-7 &&
          std::abs(merged.volume[b] - group.volume) < 1e-9)
        block_of[g] = b;
    ASSERT_NE(block_of[g], none) << "no block of " << group.volume << " m3";
    EXPECT_EQ(merged.finite[block_of[g]] != 0, group.finite);
  }
  EXPECT_EQ(groups, merged.block_count());
  Pairs expected, found;
  for (const auto& [pair, area] : search.area) {
    const Index one = block_of[search.of[pair.first]], two = block_of[search.of[pair.second]];
    if (one != two) expected[std::minmax(one, two)] += area;
  }
  for (const auto& shared : merged.interfaces)
    found[{shared.block[0], shared.block[1]}] += shared.area;
  EXPECT_EQ(expected.size(), found.size());
  for (const auto& [pair, area] : expected) EXPECT_NEAR(found[pair], area, 1e-9);
}

// Each side of a face on a joint leans on others all over.
void expect_whole_contacts(const BlockArrays& a) {
  std::vector<Real> in_touch(a.face_area.size(), 0);
  for (const auto& shared : a.interfaces)
    for (const Index f : shared.face) in_touch[f] += shared.area;
  for (std::size_t f = 0; f < a.face_area.size(); ++f) {
    const bool on_joint = a.origins[a.face_origin[f]].kind == FaceOrigin::Kind::joint;
    EXPECT_NEAR(in_touch[f], on_joint ? a.face_area[f] : 0, 1e-8);
  }
}

Blocks cut_on(int threads, const Model& model) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Blocks blocks = cut(model);
  omp_set_num_threads(before);
  return blocks;
}

// Returns how many specks went to others.
std::size_t check_seed(unsigned seed) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Model model = draw_model(seed);
  Search search(cut(model).arrays);
  search.run();
  model.cut.specks = Specks::merge;
  model.cut.min_volume = limit;
  const Blocks merged = cut_on(1, model);
  expect_same(search, merged.arrays);
  expect_whole_contacts(merged.arrays);
  EXPECT_EQ(faults_of(merged.complex()), std::vector<std::string>{});
  EXPECT_NEAR(sum(merged.arrays.volume), 1000, 1e-9);

  const Blocks threaded = cut_on(4, model);
  EXPECT_EQ(threaded.arrays.volume, merged.arrays.volume);
  EXPECT_EQ(threaded.arrays.face_area, merged.arrays.face_area);
  EXPECT_EQ(threaded.arrays.corner_vertex, merged.arrays.corner_vertex);

  std::reverse(model.joints.begin(), model.joints.end());
  const Blocks reversed = cut(model);
  EXPECT_EQ(reversed.arrays.block_count(), merged.arrays.block_count());
  for (Index b = 0; b < std::min(reversed.arrays.block_count(), merged.arrays.block_count()); ++b)
    EXPECT_NEAR(reversed.arrays.volume[b], merged.arrays.volume[b], 1e-9);
  return merged.cutting.totals.specks->merged.size();
}

void check_seeds(unsigned first, unsigned count) {
  std::size_t merged = 0;
  for (unsigned seed = first; seed < first + count; ++seed) merged += check_seed(seed);
  EXPECT_GT(merged, 10u * count);
}

TEST(SpeckMerging, DoesWhatTheRuleSaysInRandomModels) {
  check_seeds(0, reference::cases(40u, 4u));
}

TEST(SlowSpeckMerging, DoesWhatTheRuleSaysInRandomModels) {
  check_seeds(1000, 1000);
}

}  // namespace
}  // namespace rockfold::test
