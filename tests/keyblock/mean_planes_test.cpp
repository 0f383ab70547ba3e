// Normals of facets, parted into the planes that they are.
#include "host/keyblock/mean_planes.hpp"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::radians;
using test::upward;

/// Facets that dip so to the east, of 1 m² each.
std::vector<SurfaceFacet> dipping(const std::vector<Real>& dips) {
  std::vector<SurfaceFacet> facets;
  for (const Real dip : dips) facets.push_back({upward(dip, 90), 1});
  return facets;
}

std::size_t planes_of(const std::vector<SurfaceFacet>& facets, Real flatness) {
  const auto normals = mean_plane_normals(facets, flatness);
  return std::set<Vec3>(normals.begin(), normals.end()).size();
}

TEST(MeanPlanes, OfFacetsWithinTheFlatnessOfTheirMeanAreOne) {
  EXPECT_EQ(planes_of(dipping({30, 35, 40}), 5), 1u);
  EXPECT_EQ(planes_of(dipping({30, 35, 40}), 4.9), 2u);
  EXPECT_LT(norm(mean_plane_normals(dipping({30, 35, 40}), 5)[0] - upward(35, 90)), 1e-15);
  // By area: the mean dips 31, one of the facets 9 more.
  std::vector<SurfaceFacet> uneven = dipping({30, 40});
  uneven[0].area = 9;
  EXPECT_EQ(planes_of(uneven, 8.9), 2u);
  EXPECT_EQ(planes_of(uneven, 9.1), 1u);
}

TEST(MeanPlanes, OfABentSurfaceAreAsFewAsItsBendNeeds) {
  struct Case {
    std::vector<Real> dips;
    std::size_t planes;
  };
  const Case cases[] = {
      {{20, 20, 50, 50, 50}, 2},                 // a bend
      {{20, 25, 30, 35, 40, 45, 50}, 3},         // a listric fault: no plane spans more than 10
      {{20, 22, 24, 26, 28, 30}, 1},             // a gentle one
      {{30, 50, 30, 50, 30, 50}, 2},             // folds: the limbs of one sense are one plane
      {{29, 50, 31, 51, 30, 49}, 2},             // rough folds
      {{0, 9, 18, 27, 36, 45, 54, 63, 72}, 5}};  // pairs, and one alone
  for (const Case& c : cases) EXPECT_EQ(planes_of(dipping(c.dips), 5), c.planes) << c.dips[1];
}

TEST(MeanPlanes, WithoutFlatnessAreThoseOfTheFacets) {
  const auto facets = dipping({30, 30.000001});
  const auto normals = mean_plane_normals(facets, 0);
  EXPECT_EQ(normals[0], facets[0].normal);
  EXPECT_EQ(normals[1], facets[1].normal);
}

TEST(MeanPlanes, AreNotBegunByLessThanATenThousandthOfTheArea) {
  std::vector<SurfaceFacet> facets = dipping({30, 30, 80, 85});
  facets[2].area = facets[3].area = 0.9e-4;
  EXPECT_EQ(planes_of(facets, 5), 1u);
  EXPECT_LT(norm(mean_plane_normals(facets, 5)[3] - upward(30, 90)), 1e-15);
  facets[3].area = 1.2e-4;  // with the other more than the share
  EXPECT_EQ(planes_of(facets, 5), 2u);
}

TEST(MeanPlanes, OfFacetsThatFaceEachOtherAreTwo) {
  EXPECT_EQ(planes_of({{{0, 0, 1}, 2}, {{0, 0, -1}, 2}}, 5), 2u);
}

// Normals within `spread` (deg) of a fold's two limbs; areas over four decades.
std::vector<SurfaceFacet> random_facets(std::mt19937& random, Real spread) {
  std::uniform_real_distribution<Real> uniform(0, 1);
  std::vector<SurfaceFacet> facets;
  const auto count = 2 + static_cast<std::size_t>(100 * uniform(random));
  while (facets.size() < count) {
    const Real tilt = spread * std::sqrt(uniform(random)), about = 360 * uniform(random);
    const Vec3 limb = upward(uniform(random) < 0.3 ? 20 : 55, 90);
    const Vec3 side = normalized(cross(limb, {0, 1, 0}));
    const Vec3 axis = test::rotated(side, limb, about);
    facets.push_back({test::rotated(limb, axis, tilt), std::pow(10, -4 * uniform(random))});
  }
  return facets;
}

TEST(MeanPlanes, HoldNoFacetThatIsFartherFromTheMeanThanTheFlatness) {
  std::mt19937 random(7);
  for (const Real spread : {1.0, 4.0, 8.0, 20.0})
    for (int i = 0; i < 50; ++i) {
      const auto facets = random_facets(random, spread);
      const auto normals = mean_plane_normals(facets, 5);
      Real all = 0, far = 0;
      for (std::size_t k = 0; k < facets.size(); ++k) {
        all += facets[k].area;
        if (dot(normals[k], facets[k].normal) < std::cos(radians(5 + 1e-6))) far += facets[k].area;
      }
      for (std::size_t k = 0; k < facets.size(); ++k) {
        Vec3 sum{};
        Real area = 0;
        for (std::size_t j = 0; j < facets.size(); ++j)
          if (normals[j] == normals[k])
            sum += facets[j].area * facets[j].normal, area += facets[j].area;
        // Facets that begin no plane, up to 1e-4 of all, do not count in the means.
        EXPECT_LT(norm(normalized(sum) - normals[k]), 2e-4 * all / area + 1e-12);
      }
      EXPECT_LT(far, 1e-4 * all);
    }
}

TEST(MeanPlanes, AreTheSameBitForBitWhateverTheOrder) {
  std::mt19937 random(11);
  for (const Real spread : {1.0, 8.0, 20.0})
    for (int i = 0; i < 20; ++i) {
      const auto facets = random_facets(random, spread);
      const auto normals = mean_plane_normals(facets, 5);
      std::vector<std::size_t> order(facets.size());
      for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
      std::shuffle(order.begin(), order.end(), random);
      std::vector<SurfaceFacet> shuffled;
      for (const std::size_t k : order) shuffled.push_back(facets[k]);
      const auto again = mean_plane_normals(shuffled, 5);
      for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(again[k], normals[order[k]]);
    }
}

}  // namespace
}  // namespace rockfold
