// Networks of consecutive seeds, as --seed draws them: their sets have nothing in common.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "host/joints/area_in_box.hpp"
#include "src/base/seeds.hpp"
#include "tests/joints/placing.hpp"

namespace rockfold::test {
namespace {

constexpr std::uint64_t networks = 200;
const RockBounds rock = box_rock({0, 0, 0}, {6, 6, 6});
const Extent part{{1, 1, 1},
                  {4, 4, 4}};  // of the rock, in which P32 varies from network to network

JointSet discs(std::uint64_t seed) {
  JointSet set;
  set.orientation = DipOrientation{40, 200};
  set.radius = 1;
  set.random.emplace();
  set.random->seed = seed;
  set.random->fisher_kappa = 20;
  set.random->p32 = 0.4;
  return set;
}

std::vector<PlacedJoint> placed(std::uint64_t seed) {
  Model model;
  model.joint_sets = {discs(seed)};
  return place_joints(model, rock).joints;
}

/// [networks] m² of set `set` of each network in the part of the rock.
std::vector<Real> areas(std::size_t set) {
  std::vector<Real> all;
  for (std::uint64_t seed = 1; seed <= networks; ++seed) {
    Real sum = 0;
    for (const PlacedJoint& joint : placed(seed_of_set(seed, set)))
      sum += area_in_box(joint.polygon, part);
    all.push_back(sum);
  }
  return all;
}

/// Pearson's, of x_i with y_(i + lag).
Real correlation(const std::vector<Real>& x, const std::vector<Real>& y, std::size_t lag) {
  const std::size_t n = x.size() - lag;
  Real sx = 0, sy = 0, sxx = 0, syy = 0, sxy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Real a = x[i], b = y[i + lag];
    sx += a, sy += b, sxx += a * a, syy += b * b, sxy += a * b;
  }
  const Real count = static_cast<Real>(n);
  return (sxy - sx * sy / count) / std::sqrt((sxx - sx * sx / count) * (syy - sy * sy / count));
}

TEST(Networks, OfConsecutiveSeedsHaveNoSetInCommon) {
  EXPECT_NE(placed(seed_of_set(1, 2))[0].polygon, placed(seed_of_set(2, 1))[0].polygon);
  EXPECT_EQ(placed(seed_of_set(1, 2))[0].polygon, placed(seed_of_set(1, 2))[0].polygon);
}

TEST(Networks, HaveSetsWhoseIntensitiesAreNotCorrelated) {
  const std::vector<Real> first = areas(1), second = areas(2);
  // Independent samples of n have correlations of deviation 1/√n: four of them are passed once in 16,000.
  const Real bound = 4 / std::sqrt(static_cast<Real>(networks));
  EXPECT_LT(std::abs(correlation(first, second, 0)), bound);
  EXPECT_LT(std::abs(correlation(first, first, 1)), bound);
  // The next network's first set with this one's second: alike where a set's seed is the network's plus its number.
  EXPECT_LT(std::abs(correlation(second, first, 1)), bound);
}

}  // namespace
}  // namespace rockfold::test
