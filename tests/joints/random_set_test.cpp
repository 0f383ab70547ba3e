// Random sets: what was asked for is what is measured; Baecher's model; spacings; refusals.
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "host/joints/area_in_box.hpp"
#include "host/joints/random_stream.hpp"
#include "tests/joints/intensity.hpp"
#include "tests/joints/placing.hpp"
#include "tests/joints/statistics.hpp"

namespace rockfold::test {
namespace {

using std::numbers::pi;
constexpr Real isotropic = 1e-9;               // κ
const Extent region{{-3, 0, 2}, {9, 10, 10}};  // 12 × 10 × 8
constexpr Real volume = 960;
const RockBounds rock = box_rock(region.min, region.max);

JointSet random_set(Real kappa, Real radius) {
  JointSet set;
  set.name = "R";
  set.orientation = DipOrientation{40, 200};
  set.origin = {1, 4, 5};
  set.radius = radius;
  set.random.emplace();
  set.random->seed = 17;
  set.random->fisher_kappa = kappa;
  return set;
}

PlacedJoints placed(const JointSet& set) {
  Model model;
  model.joint_sets = {set};
  return place_joints(model, rock);
}

Real p32_in(const std::vector<FlatJoint>& joints, const Extent& box) {
  const SamplingRectangle any{box.min, {1, 0, 0}, {0, 1, 0}};
  return measure_intensities(joints, box, {{box.min, box.max}}, any).p32;
}

Vec3 centre_of(const std::vector<Vec3>& corners) {
  Vec3 sum{};
  for (const Vec3& p : corners) sum += p;
  return (1.0 / static_cast<Real>(corners.size())) * sum;
}

// Centres of the discs inside the region.
std::vector<Vec3> centres_inside(const PlacedJoints& joints) {
  std::vector<Vec3> centres;
  for (const PlacedJoint& joint : joints.joints) {
    const Vec3 c = centre_of(joint.polygon);
    bool inside = true;
    for (int d = 0; d < 3; ++d) inside = inside && c[d] >= region.min[d] && c[d] < region.max[d];
    if (inside) centres.push_back(c);
  }
  return centres;
}

TEST(UniformDiscs, HaveAsManyCentresInTheRegionAsAskedFor) {
  JointSet set = random_set(30, 1);
  set.random->count = 321;
  EXPECT_EQ(centres_inside(placed(set)).size(), 321u);
}

TEST(UniformDiscs, LieUniformlyInTheRegion) {
  JointSet set = random_set(30, 1);
  set.random->count = 8000;
  std::vector<Real> in_cell(64);
  for (const Vec3& c : centres_inside(placed(set))) {
    int cell = 0;
    for (int d = 0; d < 3; ++d)
      cell =
          4 * cell + static_cast<int>(4 * (c[d] - region.min[d]) / (region.max[d] - region.min[d]));
    in_cell[cell] += 1;
  }
  // χ² of 63 degrees of freedom: mean 63, deviation √126; 63 + 5·√126 = 119 is passed once in 30,000.
  Real chi_squared = 0;
  for (const Real n : in_cell) chi_squared += (n - 125) * (n - 125) / 125;
  EXPECT_LT(chi_squared, 119);
}

TEST(UniformDiscs, AreAsDenseInTheCornersOfTheRegionAsInItsMiddle) {
  JointSet set = random_set(isotropic, 1);
  set.random->radius = Distribution{Distribution::Kind::log_normal, 1, 0.7};
  set.random->p32 = 100;
  const auto joints = flat_joints(placed(set));
  const std::vector<Extent> parts = {{{1, 3, 4}, {5, 7, 8}},  // 64 m³ each, eight corners in one
                                     {{-3, 0, 2}, {-1, 2, 4}},   {{7, 0, 2}, {9, 2, 4}},
                                     {{-3, 8, 2}, {-1, 10, 4}},  {{7, 8, 2}, {9, 10, 4}},
                                     {{-3, 0, 8}, {-1, 2, 10}},  {{7, 0, 8}, {9, 2, 10}},
                                     {{-3, 8, 8}, {-1, 10, 10}}, {{7, 8, 8}, {9, 10, 10}}};
  Real middle = 0, corners = 0, middle_variance = 0, corner_variance = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const FlatJoint& joint : joints) {
      const Real a = area_in_box(joint.polygon, parts[i]);
      // Areas of a Poisson process: the variance of their sum is the sum of their squares (a disc that meets two corners
      // counts a little less than it should: an upper bound needs (Σa)², and few do).
      (i == 0 ? middle : corners) += a;
      (i == 0 ? middle_variance : corner_variance) += a * a;
    }
  EXPECT_NEAR(middle / 64, 100, 5 * std::sqrt(middle_variance) / 64);
  EXPECT_NEAR(corners / 64, 100, 5 * std::sqrt(corner_variance) / 64);
}

TEST(UniformDiscs, HaveTheirRadiiDistributedAsGivenWhereTheirCentresLieInside) {
  JointSet set = random_set(20, 1);
  set.random->radius = Distribution{Distribution::Kind::exponential, 2};
  set.random->count = 10'000;
  std::vector<Real> radii;
  for (const PlacedJoint& joint : placed(set).joints) {
    const Vec3 c = centre_of(joint.polygon);
    bool inside = true;
    for (int d = 0; d < 3; ++d) inside = inside && c[d] >= region.min[d] && c[d] < region.max[d];
    if (inside) radii.push_back(norm(joint.polygon[0] - c));
  }
  EXPECT_EQ(radii.size(), 10'000u);
  expect_mean(radii, 2, 4);
  expect_distribution(radii, [](Real r) { return 1 - std::exp(-r / 2); });
}

TEST(UniformDiscs, ReachTheP32AskedForWithinHalfADisc) {
  for (const Real p32 : {0.01, 0.3, 2.0}) {
    JointSet set = random_set(10, 1.2);
    set.random->p32 = p32;
    const Real disc = area(placed(set).joints.at(0).polygon);
    EXPECT_NEAR(p32_in(flat_joints(placed(set)), region), p32, 0.5 * disc / volume + 1e-12) << p32;
  }
}

// Lines of a direction through the region, at places drawn from a generator of the test's own.
std::vector<Real> crossings_of_level_lines(const std::vector<FlatJoint>& joints, int lines) {
  std::mt19937_64 engine(99);
  const auto uniform = [&](Real from, Real to) {
    return from + (to - from) * static_cast<Real>(engine() >> 11) * 0x1p-53;
  };
  std::vector<Real> counts;
  for (int i = 0; i < lines; ++i) {
    const Real y = uniform(0, 10), z = uniform(2, 10);
    counts.push_back(crossings(joints, {-3, y, z}, {9, y, z}));
  }
  return counts;
}

// The area that level lines along x see, in the region, over its section: the mean of crossings of all such lines.
Real seen_along_x(const std::vector<FlatJoint>& joints) {
  Real sum = 0;
  for (const FlatJoint& joint : joints)
    sum += area_in_box(joint.polygon, region) * std::abs(joint.normal[0]);
  return sum / 80;
}

TEST(UniformDiscs, ReachTheP10AskedForInTheMeanOfAThousandParallelLines) {
  JointSet set = random_set(25, 1.5);
  set.random->p10 = 1.25;
  set.random->scanline = {{{0, 5, 5}, {2, 5, 5}}};
  const auto joints = flat_joints(placed(set));
  // Over all lines exactly, but for half a disc of 7 m².
  EXPECT_NEAR(seen_along_x(joints) / 12, 1.25, 0.5 * 7 / volume);
  const auto counts = crossings_of_level_lines(joints, 1000);
  expect_mean(counts, 12 * 1.25, variance_of(counts));
}

TEST(Stereology, P10IsHalfOfP32ForIsotropicDiscs) {
  JointSet set = random_set(isotropic, 1);
  set.random->p32 = 2;
  const auto joints = flat_joints(placed(set));
  // |cos θ| has the mean 1/2 and the variance 1/12.
  Real squares = 0;
  for (const FlatJoint& joint : joints) squares += std::pow(area_in_box(joint.polygon, region), 2);
  const Real p32 = p32_in(joints, region);
  EXPECT_NEAR(seen_along_x(joints) / 12, 0.5 * p32, 5 * std::sqrt(squares / 12) / volume);
  const auto counts = crossings_of_level_lines(joints, 1000);
  expect_mean(counts, seen_along_x(joints), variance_of(counts));
}

// P20 and P21 on 300 level sections at places drawn at random, over the region.
std::pair<std::vector<Real>, std::vector<Real>> level_sections(
    const std::vector<FlatJoint>& joints) {
  std::mt19937_64 engine(5);
  std::pair<std::vector<Real>, std::vector<Real>> found;
  for (int i = 0; i < 300; ++i) {
    const Real z = 2 + 8 * static_cast<Real>(engine() >> 11) * 0x1p-53;
    const SamplingRectangle section{{-3, 0, z}, {12, 0, 0}, {0, 10, 0}};
    const Intensities m = measure_intensities(joints, region, {{region.min, region.max}}, section);
    found.first.push_back(m.p20);
    found.second.push_back(m.p21);
  }
  return found;
}

TEST(Stereology, P21IsAQuarterPiOfP32ForIsotropicDiscs) {
  JointSet set = random_set(isotropic, 1);
  set.random->p32 = 2;
  const auto joints = flat_joints(placed(set));
  // A level section sees sin θ of a disc's area: mean π/4, variance 2/3 − π²/16.
  Real squares = 0, seen = 0;
  for (const FlatJoint& joint : joints) {
    const Real a = area_in_box(joint.polygon, region);
    squares += a * a;
    seen += a * std::sqrt(1 - joint.normal[2] * joint.normal[2]) / volume;
  }
  EXPECT_NEAR(seen, pi / 4 * 2,
              5 * std::sqrt(squares * (2.0 / 3 - pi * pi / 16)) / volume + 0.5 * pi / volume);
  const auto p21 = level_sections(joints).second;
  expect_mean(p21, seen, variance_of(p21));
}

TEST(Stereology, P20AndP21OfParallelDiscsFollowFromTheirHeightAndDip) {
  JointSet set = random_set(std::numeric_limits<Real>::infinity(), 1);
  set.orientation = DipOrientation{40, 90};
  set.random->p32 = 2;
  const auto joints = flat_joints(placed(set));
  const auto [p20, p21] = level_sections(joints);
  expect_mean(p21, 2 * std::sin(40 * pi / 180), variance_of(p21));
  // A section meets the discs whose centre lies within r·sin(dip) of it, a height of 2·sin 40°; P30 from P32 and the area.
  const Real height = 2 * std::sin(40 * pi / 180), disc = area(joints[0].polygon);
  // Both the sections and the number of centres near them scatter: that of a Poisson process in the region's volume.
  const Real expected = 2 / disc * height;
  EXPECT_NEAR(mean_of(p20), expected,
              5 * std::sqrt(variance_of(p20) / 300) + 5 * expected / std::sqrt(2 / disc * volume));
}

TEST(RandomPlanes, OfConstantSpacingAreThoseOfTheRegularSet) {
  JointSet regular = random_set(1, 1);
  regular.radius.reset();
  JointSet random = regular;
  regular.random.reset();
  regular.spacing = 0.75;
  random.random->fisher_kappa = std::numeric_limits<Real>::infinity();
  random.random->spacing = Distribution{Distribution::Kind::constant, 0.75};
  const auto offsets = [](const PlacedJoints& joints) {
    std::vector<Real> found;
    for (const FlatJoint& joint : flat_joints(joints)) found.push_back(joint.offset);
    std::sort(found.begin(), found.end());
    return found;
  };
  const auto a = offsets(placed(regular)), b = offsets(placed(random));
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 15u);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-14 * 20);
  random.count = regular.count = 6;
  EXPECT_EQ(placed(random).joints.size(), placed(regular).joints.size());
}

TEST(RandomPlanes, HaveTheSpacingsAskedForOnBothSidesOfTheOrigin) {
  JointSet set = random_set(std::numeric_limits<Real>::infinity(), 1);
  set.radius.reset();
  set.random->spacing = Distribution{Distribution::Kind::exponential, 0.005};
  std::vector<Real> offsets;
  for (const FlatJoint& joint : flat_joints(placed(set))) offsets.push_back(joint.offset);
  std::sort(offsets.begin(), offsets.end());
  std::vector<Real> spacings;
  for (std::size_t i = 1; i < offsets.size(); ++i) spacings.push_back(offsets[i] - offsets[i - 1]);
  ASSERT_GT(spacings.size(), 2000u);
  expect_mean(spacings, 0.005, 0.005 * 0.005);
  expect_distribution(spacings, [](Real s) { return 1 - std::exp(-s / 0.005); });
}

TEST(RandomPlanes, ScatterAboutTheSetsOrientation) {
  JointSet set = random_set(40, 1);
  set.radius.reset();
  set.random->spacing = Distribution{Distribution::Kind::constant, 0.005};
  std::vector<Real> cosines;
  const Vec3 pole = plane_frame(set.orientation).normal;
  for (const FlatJoint& joint : flat_joints(placed(set)))
    cosines.push_back(std::abs(dot(joint.normal, pole)));
  // coth κ = 1 and sinh κ = ∞ to double precision; no normal is turned past 90° (e⁻⁴⁰).
  expect_mean(cosines, 1 - 1.0 / 40, 1.0 / 1600);
}

TEST(RandomPlanes, CountAsCells) {
  Model model;
  for (const DipOrientation& orientation : {DipOrientation{0, 0}, {90, 0}, {90, 90}}) {
    JointSet set = random_set(1000, 1);
    set.orientation = orientation;
    set.radius.reset();
    set.random->spacing = Distribution{Distribution::Kind::exponential, 0.5};
    model.joint_sets.push_back(set);
  }
  const auto sets = place_joints(model, rock).plane_sets;
  ASSERT_EQ(sets.size(), 3u);
  const Vec3 lengths = rock.corners[7] - rock.corners[0];
  const CellEstimate cells = estimate_cells(sets, volume, norm(lengths));
  EXPECT_GT(cells.about, 0.5 * volume / 0.125);
  EXPECT_LT(cells.about, 2 * volume / 0.125);
  EXPECT_GT(cells.least, cells.about / 16);
  EXPECT_LT(cells.least, cells.about / 4);
}

TEST(RandomPlanes, OneSpacingAfterAnotherMayBeCounted) {
  JointSet set = random_set(std::numeric_limits<Real>::infinity(), 1);
  set.orientation = DipOrientation{0, 0};
  set.origin = {1, 5, 5};
  set.radius.reset();
  set.random->spacing = Distribution{Distribution::Kind::exponential, 0.1};
  const auto at = [&](Index count) {
    set.count = count;
    std::vector<Real> heights;
    for (const FlatJoint& joint : flat_joints(placed(set))) heights.push_back(joint.offset - 5);
    return heights;
  };
  const auto above = [](const std::vector<Real>& heights) {
    return std::count_if(heights.begin(), heights.end(), [](Real z) { return z > 0; });
  };
  EXPECT_EQ(at(1), std::vector<Real>{0});
  EXPECT_EQ(at(4).size(), 4u);
  EXPECT_EQ(above(at(4)), 2);
  EXPECT_EQ(above(at(5)), 2);
  EXPECT_EQ(at(5).size(), 5u);
}

TEST(RandomDiscs, OneSpacingAfterAnotherLieOnTheLineThroughTheOrigin) {
  JointSet set = random_set(std::numeric_limits<Real>::infinity(), 1);
  set.random->spacing = Distribution{Distribution::Kind::exponential, 1};
  const Vec3 pole = plane_frame(set.orientation).normal;
  const PlacedJoints joints = placed(set);
  ASSERT_GT(joints.joints.size(), 4u);
  for (const PlacedJoint& joint : joints.joints)
    EXPECT_LT(norm(cross(centre_of(joint.polygon) - set.origin, pole)), 1e-13);
}

TEST(RandomSets, DependOnTheirOwnSeedAndRegionAlone) {
  Model both;
  both.joint_sets = {random_set(5, 1), random_set(5, 2)};
  both.joint_sets[0].random->p32 = 0.5;
  both.joint_sets[1].random->p32 = 0.5;
  both.joint_sets[1].random->seed = 4;
  const PlacedJoints alone = placed(both.joint_sets[1]), together = place_joints(both, rock);
  const std::size_t before = together.joints.size() - alone.joints.size();
  for (std::size_t i = 0; i < alone.joints.size(); ++i)
    EXPECT_EQ(alone.joints[i].polygon, together.joints[before + i].polygon);
  both.joint_sets[1].random->seed = 5;
  EXPECT_NE(placed(both.joint_sets[1]).joints[0].polygon, alone.joints[0].polygon);
}

TEST(RandomSets, HaveCornersOnTheirPlanes) {
  JointSet set = random_set(3, 1);
  set.random->p32 = 0.5;
  for (const FlatJoint& joint : flat_joints(placed(set)))
    for (const Vec3& p : joint.polygon) EXPECT_NEAR(dot(joint.normal, p), joint.offset, 1e-14);
}

void expect_set_refused(const JointSet& set, const std::string& part, const std::string& key) {
  Model model;
  model.joint_sets = {set};
  expect_refusal(model, rock, part, key);
}

TEST(RandomSets, AreRefusedWhereTheyHaveNoAnswer) {
  JointSet set = random_set(10, 1);
  set.random->count = 6'000'000;
  expect_set_refused(set, "about 6e+06 discs", "joint_set[1].random.count");
  set.random->count.reset();
  set.random->p32 = 1e9;
  expect_set_refused(set, "at most 5e+06", "joint_set[1].random.p32");
  set.random->p32 = 1;
  set.radius.reset();
  expect_set_refused(set, "no radius", "joint_set[1].random");
  set.random->radius = Distribution{Distribution::Kind::exponential, 1, 0, 0, 50, 60};
  expect_set_refused(set, "lie in [50, 60]", "joint_set[1].random.radius");
  set.random->radius = Distribution{Distribution::Kind::log_normal, 1, 1e9};
  expect_set_refused(set, "standard deviation", "joint_set[1].random.radius");
}

TEST(RandomSets, AreRefusedWhereTheirPlacesMakeNoSense) {
  JointSet set = random_set(std::numeric_limits<Real>::infinity(), 1);
  set.orientation = DipOrientation{0, 0};
  set.random->p10 = 1;
  set.random->scanline = {{{0, 0, 0}, {1, 0, 0}}};
  expect_set_refused(set, "along the scanline", "joint_set[1].random.scanline");
  set.random->scanline = {};
  expect_set_refused(set, "same point", "joint_set[1].random.scanline");
  set.random->p10.reset();
  set.random->spacing = Distribution{Distribution::Kind::exponential, 1e-9};
  set.radius.reset();
  expect_set_refused(set, "more than 1e+06 joints", "joint_set[1].random.spacing");
  set.random->spacing->max = 1e-15;
  expect_set_refused(set, "of the values", "joint_set[1].random.spacing");
}

}  // namespace
}  // namespace rockfold::test
