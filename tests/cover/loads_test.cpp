// Loads on faces: their totals, what they do to the functions of the elements, and what is refused.
#include "host/cover/points/loads.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "host/cover/points/triangle_rule.hpp"
#include "src/base/error.hpp"
#include "src/space/shape_functions.hpp"
#include "tests/cover/covers.hpp"

namespace rockfold::test {
namespace {

Model jointed_box() {
  Model model = box_model({0, 0, 0}, {5, 4, 3});
  add_joint(model, DipOrientation{35, 110}, {2, 2, 1.5});
  add_joint(model, DipOrientation{80, 10}, {2, 2, 1.5});
  return model;
}

Traction traction(const Region& where, const Vec3& value) {
  Traction t;
  t.where = where;
  t.value = value;
  return t;
}

Traction pressure(const Region& where, Real value, bool follows) {
  Traction t = traction(where, {value, 0, 0});
  t.pressure = true;
  t.follows = follows;
  return t;
}

LoadPoints loads_of(const Covered& c) {
  return load_points(c.blocks.cutting, c.covering, c.model);
}

Vec3 total(const std::vector<Vec3>& values) {
  Vec3 sum{};
  for (const Vec3& v : values) sum += v;
  return sum;
}

void expect_near(const Vec3& a, const Vec3& b, Real tolerance) {
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(a[d], b[d], tolerance);
}

std::string refusal(const Covered& c) {
  try {
    loads_of(c);
    quiet_points(c.blocks.cutting, c.covering, c.model);
    rigid_velocities(c.covering, c.blocks.arrays.block_count(), c.model);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::model);
    return error.diagnostics()[0].place.key + ": " + error.diagnostics()[0].message;
  }
  return "";
}

TEST(TriangleRule, IntegratesMonomialsUpToItsDegree) {
  // ∫ a^i b^j over the triangle / area = 2 i! j! / (i + j + 2)!, a and b barycentric.
  const auto factorial = [](int n) { return std::tgamma(n + 1.0); };
  for (int degree = 0; degree <= 8; ++degree)
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        Real sum = 0;
        for (const auto& [at, weight] : triangle_rule(degree))
          sum += weight * std::pow(at[0], i) * std::pow(at[2], j);
        EXPECT_NEAR(sum, 2 * factorial(i) * factorial(j) / factorial(i + j + 2), 1e-15)
            << degree << " " << i << " " << j;
      }
}

TEST(Tractions, SumToAreaTimesTraction) {
  Model model = jointed_box();
  model.tractions = {traction(FaceRegion{0, {5}}, {1, 2, -3})};
  const Covered c = cover(model, spacing(0.7));
  expect_near(total(loads_of(c).force), {20, 40, -60}, 1e-12);
}

TEST(Tractions, IntegrateTheFunctionsOfTheElementsExactly) {
  // A polynomial of the functions' degree, x^a y^b, integrates over the face as in closed form, for every order.
  for (int order = 0; order <= 2; ++order) {
    Model model = jointed_box();
    model.tractions = {traction(FaceRegion{0, {5}}, {0, 0, 1})};
    Covered c = cover(model, spacing(0.7));
    c.covering.arrays.order = order;
    const LoadPoints loads = loads_of(c);
    for (int a = 0; a <= order + 1; ++a)
      for (int b = 0; a + b <= order + 1; ++b) {
        Real sum = 0;
        for (std::size_t n = 0; n < loads.points.size(); ++n) {
          const Vec3 x = point_position(c.arrays(), loads.points, n);
          EXPECT_NEAR(x[2], 3, 1e-12);
          sum += loads.force[n][2] * std::pow(x[0], a) * std::pow(x[1], b);
        }
        const Real exact = std::pow(5, a + 1) / (a + 1) * std::pow(4, b + 1) / (b + 1);
        EXPECT_NEAR(sum, exact, 1e-12 * exact) << order << " " << a << " " << b;
      }
  }
}

TEST(Tractions, OfAnOrderDoTheWorkOfItsFunctions) {
  // Order 1, u = x y in the covers' own functions: by partition of unity Σ N_a (x y about node a to first order) is not u, but the
  // force vector must give the same work from every rule finer than ours: compare with the points of order 2.
  Model model = jointed_box();
  model.tractions = {traction(FaceRegion{0, {1}}, {1, 0, 0})};
  Covered c = cover(model, spacing(0.9));
  c.covering.arrays.order = 1;
  const LoadPoints loads = loads_of(c);
  c.covering.arrays.order = 2;
  const LoadPoints finer = loads_of(c);
  const Index unknowns = 4 * c.arrays().cover_count();
  std::vector<Real> force(unknowns, 0), same(unknowns, 0);
  const auto add = [&](const LoadPoints& from, std::vector<Real>& to) {
    for (std::size_t n = 0; n < from.points.size(); ++n)
      for (Index i = from.points.begin[n]; i < from.points.begin[n + 1]; ++i)
        if (from.points.unknown[i] < unknowns)
          to[from.points.unknown[i]] += from.points.weight[i] * from.force[n][0];
  };
  add(loads, force);
  add(finer, same);
  for (Index u = 0; u < unknowns; ++u) EXPECT_NEAR(force[u], same[u], 1e-13);
}

TEST(Pressures, ActAlongTheInwardNormal) {
  Model model = jointed_box();
  model.tractions = {pressure(FaceRegion{0, {0}}, 100, false)};
  const Covered c = cover(model, spacing(0.7));
  expect_near(total(loads_of(c).force), {1200, 0, 0}, 1e-9);
}

TEST(Pressures, ThatFollowCarryTheirAreaAndValue) {
  Model model = jointed_box();
  model.tractions = {pressure(FaceRegion{0, {2}}, 7, true)};
  const Covered c = cover(model, spacing(0.7));
  const LoadPoints loads = loads_of(c);
  expect_near(total(loads.area), {0, -15, 0}, 1e-12);
  expect_near(total(loads.force), {}, 0);
  for (const Real p : loads.pressure) EXPECT_EQ(p, 7);
}

TEST(Pressures, InsideAnExcavationPushItsWallsApart) {
  // A box excavated within: the walls are free, six faces of areas 2·2, 2·1 and 2·1 m², and pressures cancel.
  Model model = box_model({0, 0, 0}, {5, 4, 3});
  Excavation hole;
  hole.name = "hole";
  hole.shape = BoxShape{{1.3, 1.1, 1}, {3.3, 3.1, 2}};
  model.excavations.push_back(hole);
  model.tractions = {pressure(FaceRegion{0, {1}, true}, 10, true)};
  Covered c = cover(model, spacing(0.7));
  // Outward of the rock at the hole's face xmax is −x.
  expect_near(total(loads_of(c).area), {-2, 0, 0}, 1e-12);
  c.model.tractions = {pressure(FaceRegion{0, {0, 1, 2, 3, 4, 5}, true}, 10, false)};
  expect_near(total(loads_of(c).force), {}, 1e-12);
  Real area = 0;
  c.model.tractions[0].follows = true;
  for (const Vec3& a : loads_of(c).area) area += norm(a);
  EXPECT_NEAR(area, 2 * (4 + 2 + 2), 1e-12);
}

TEST(Tractions, InAPlaneOrABoxActOnTheFreeFacesThere) {
  Model model = jointed_box();
  model.tractions = {traction(PlaneRegion{{0, 0, 3}, {0, 0, 1}, 1e-9}, {0, 0, 1})};
  Covered c = cover(model, spacing(0.7));
  expect_near(total(loads_of(c).force), {0, 0, 20}, 1e-12);
  // Part of the top, as a flat box; a box that also takes strips of two sides, each 0.5 m high.
  c.model.tractions = {traction(BoxRegion{{1, 1, 3}, {3, 2.5, 3}}, {0, 0, 1})};
  expect_near(total(loads_of(c).force), {0, 0, 3}, 1e-12);
  c.model.tractions = {traction(BoxRegion{{-1, -1, 2.5}, {2, 2, 4}}, {1, 0, 0})};
  expect_near(total(loads_of(c).force), {4 + 1 + 1, 0, 0}, 1e-12);
}

TEST(Tractions, OverTimeAreTablesTimesArea) {
  Model model = jointed_box();
  Traction sheared = traction(FaceRegion{0, {5}}, {});
  sheared.table = {{0, 1}, {{0, 0, 0}, {4, 0, 0}}};
  Traction squeezed = pressure(FaceRegion{0, {0, 1}}, 0, false);
  squeezed.table = {{0, 2}, {{0, 0, 0}, {6, 0, 0}}};
  model.tractions = {sheared, squeezed};
  PointLoad push;
  push.point = {1, 1, 1};
  push.table = {{0}, {{0, 0, 5}}};
  model.point_loads = {push};
  const Covered c = cover(model, spacing(0.7));
  const LoadPoints loads = loads_of(c);
  Vec3 at_end{};
  Real squeeze = 0;
  for (std::size_t n = 0; n < loads.points.size(); ++n) {
    ASSERT_NE(loads.table[n], none);
    const Vec3 force = loads.scale[n] * loads.tables[loads.table[n]].value.back();
    at_end += force;
    if (std::abs(point_position(c.arrays(), loads.points, n)[0]) < 1e-9) squeeze += force[0];
  }
  expect_near(at_end, {80, 0, 5}, 1e-12);
  EXPECT_NEAR(squeeze, 6 * 12, 1e-12);
}

TEST(QuietBoundaries, HaveTheImpedanceOfTheRock) {
  Model model = jointed_box();
  model.quiet_boundaries.push_back({FaceRegion{0, {4}}, {}});
  const Covered c = cover(model, spacing(0.7));
  const QuietPoints quiet = quiet_points(c.blocks.cutting, c.covering, c.model);
  Real normal = 0, shear = 0;
  for (std::size_t n = 0; n < quiet.points.size(); ++n) {
    expect_near(quiet.normal[n], {0, 0, -1}, 1e-15);
    normal += quiet.normal_damping[n];
    shear += quiet.shear_damping[n];
  }
  // E = 30 GPa, ν = 0.25: λ = μ = 12 GPa; c_p² = 36e9 / 2700, c_s² = 12e9 / 2700.
  EXPECT_NEAR(normal, 20 * 2700 * std::sqrt(36e9 / 2700), 1e-3);
  EXPECT_NEAR(shear, 20 * 2700 * std::sqrt(12e9 / 2700), 1e-3);
}

TEST(InitialVelocities, AreOfTheBlockThatHoldsThePointOrOfAll) {
  Model model = jointed_box();
  InitialVelocity one, all;
  one.block_at = Vec3{0.1, 0.1, 0.1};
  one.velocity = {1, 0, 0};
  all.angular_velocity = {0, 0, 2};
  model.initial_velocities = {one, all};
  const Covered c = cover(model, spacing(0.7));
  const auto given = rigid_velocities(c.covering, c.blocks.arrays.block_count(), c.model);
  ASSERT_EQ(given.size(), 2u);
  EXPECT_EQ(given[0].blocks.size(), 1u);
  EXPECT_EQ(given[0].velocity, (Vec3{1, 0, 0}));
  EXPECT_EQ(static_cast<Index>(given[1].blocks.size()), c.blocks.arrays.block_count());
}

TEST(Loads, WhereThereIsNothingAreRefused) {
  Model model = jointed_box();
  // A second box hides the first one's top: no face of it is free.
  Solid lid = model.solids[0];
  lid.name = "lid";
  lid.shape = BoxShape{{0, 0, 3}, {5, 4, 4}};
  model.solids.push_back(lid);
  Covered c = cover(model, spacing(0.7));
  const auto place = [](const char* key) { return Place{"m.toml", 3, 1, key}; };
  c.model.tractions = {traction(FaceRegion{0, {5}}, {1, 0, 0})};
  c.model.tractions[0].place = place("traction[1]");
  EXPECT_EQ(refusal(c), "traction[1].where: holds no free face of the rock");
  c.model.tractions = {};
  c.model.quiet_boundaries = {
      {PlaneRegion{{0, 0, 1}, {0, 0, 1}, 1e-9}, place("quiet_boundary[1]")}};
  EXPECT_EQ(refusal(c), "quiet_boundary[1].where: holds no free face of the rock");
  c.model.quiet_boundaries = {};
  c.model.point_loads.push_back({{0, 0, 9}, {1, 0, 0}, {}, place("point_load[1]")});
  EXPECT_EQ(refusal(c), "point_load[1].point: (0, 0, 9) is not in the rock");
  c.model.point_loads = {};
  c.model.initial_velocities.push_back({Vec3{9, 9, 9}, {}, {}, place("initial_velocity[1]")});
  EXPECT_EQ(refusal(c), "initial_velocity[1].where.block_at: (9, 9, 9) is not in the rock");
}

}  // namespace
}  // namespace rockfold::test
