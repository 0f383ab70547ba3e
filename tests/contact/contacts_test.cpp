// Contacts as a time step uses them: area points of joints, tangents, shear that survives, states as bytes, bits that stay.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "kernels/contact/contact.hpp"
#include "src/base/vector.hpp"
#include "tests/reference/convex_bodies.hpp"

namespace rockfold {
namespace {

using reference::box_body;
using reference::ConvexBody;

ContactOptions options(Real reach = 0.05) {
  ContactOptions o;
  JointLaw law;
  law.normal_stiffness = 2e9;
  law.shear_stiffness = 0.7e9;
  law.friction = law.residual_friction = 0.8;
  law.cohesion = law.residual_cohesion = 1e9;  // so that nothing slides
  law.tensile_strength = 1e9;
  JointLaw other = law;
  other.cohesion = other.residual_cohesion = other.tensile_strength = 0;
  o.laws = {law, other};
  o.law_of_pair.assign(9, 1);
  o.search_distance = reach;
  o.skin = 0.1;
  return o;
}

/// Two blocks on the joint z = 1, off the origin; the upper one may be a prism, of any faces.
std::vector<ConvexBody> stack(const ConvexBody& upper) {
  return {box_body({10, 20, 0}, {13, 23, 1}), upper};
}
std::vector<std::vector<Index>> joint_at_top(const std::vector<ConvexBody>& bodies) {
  std::vector<std::vector<Index>> joint;
  for (const ConvexBody& b : bodies) {
    joint.emplace_back();
    for (const auto& f : b.face) {
      bool flat = true;
      for (const Index v : f) flat = flat && std::abs(b.vertex[v][2] - 1) < 1e-12;
      joint.back().push_back(flat ? 0 : none);
    }
  }
  return joint;
}

Vec3 place(const ContactPoint& p, const std::vector<Vec3>& x, int side) {
  Vec3 sum{};
  for (int k = 3 * side; k < 3 * side + 3; ++k) sum += std::abs(p.weight[k]) * x[p.vertex[k]];
  return sum;
}

struct Resultant {
  Vec3 force{}, moment{};
};
/// On the first sides, about a point.
Resultant resultant(const std::vector<ContactPoint>& points, const Contacts::Forces& f,
                    const std::vector<Vec3>& x, const Vec3& about) {
  Resultant r;
  for (std::size_t i = 0; i < points.size(); ++i) {
    r.force += f.force[i];
    r.moment += cross(place(points[i], x, 0) - about, f.force[i]);
  }
  return r;
}

void move_upper(std::vector<ConvexBody>& bodies, const Vec3& by) {
  reference::shift(bodies[1], by);
}

TEST(AreaPoints, OfAJointAreWholeAndTurnAsItsAreaDoes) {
  // a parallelogram, a triangle and a general pentagon as areas
  std::vector<ConvexBody> uppers{box_body({10.2, 20.3, 1}, {11.7, 21.1, 2})};
  for (const int n : {3, 5, 7}) {
    uppers.push_back(reference::prism_body(n, 0.8, 1));
    for (Vec3& v : uppers.back().vertex)
      v = {11.5 + v[0] + 0.3 * v[1], 21.5 + 0.4 * v[1] + 0.2 * v[0] * v[0], 1.5 + v[2]};
  }
  for (const ConvexBody& upper : uppers) {
    auto bodies = stack(upper);
    const SurfaceArrays s = reference::surfaces_of(bodies, joint_at_top(bodies));
    Contacts contacts(s, options());
    contacts.detect(s.vertex);
    const auto points = contacts.points();
    const auto shadow = reference::shadow(bodies[1], bodies[0], {0, 0, 1});
    Real area = 0;
    Vec3 first{};
    Mat3 second{};
    for (const ContactPoint& p : points) {
      EXPECT_EQ(p.memory.broken, 0);
      EXPECT_EQ(p.memory.state, Contact::stick);
      EXPECT_EQ(p.law, 0);
      area += p.area;
      const Vec3 at = place(p, s.vertex, 1) - Vec3{11, 21, 1};
      first += p.area * at;
      for (int i = 0; i < 3; ++i) second[i] += p.area * at[i] * at;
    }
    EXPECT_NEAR(area, shadow.area, 1e-12);
    // The moments of the area by triangles from a corner.
    std::vector<Vec3> polygon;
    for (const auto& f : upper.face) {
      bool flat = true;
      for (const Index v : f) flat = flat && std::abs(upper.vertex[v][2] - 1) < 1e-12;
      if (!flat) continue;
      for (const Index v : f) polygon.push_back(upper.vertex[v] - Vec3{11, 21, 1});
    }
    Vec3 first_exact{};
    Mat3 second_exact{};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const Vec3 &a = polygon[0], &b = polygon[i], &c = polygon[i + 1], m = (1.0 / 3) * (a + b + c);
      const Real t = 0.5 * norm(cross(b - a, c - a));
      first_exact += t * m;
      for (int k = 0; k < 3; ++k)
        second_exact[k] += (t / 12) * (a[k] * a + b[k] * b + c[k] * c) + (0.75 * t * m[k]) * m;
    }
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(first[i], first_exact[i], 1e-12);
      for (int j = 0; j < 2; ++j) EXPECT_NEAR(second[i][j], second_exact[i][j], 1e-6);
    }
    const auto none_yet = contacts.evaluate(s.vertex);
    for (const Vec3& f : none_yet.force) EXPECT_EQ(norm(f), 0);
  }
}

TEST(AreaPoints, PressAndShearWithTheStiffnessOfTheArea) {
  auto bodies = stack(box_body({10.2, 20.3, 1}, {11.7, 21.1, 2}));
  const SurfaceArrays s = reference::surfaces_of(bodies, joint_at_top(bodies));
  Contacts contacts(s, options());
  contacts.detect(s.vertex);
  EXPECT_EQ(contacts.points().size(), 5u);
  move_upper(bodies, {3e-5, -2e-5, -1e-5});
  const auto x = reference::places_of(bodies);
  const auto f = contacts.evaluate(x);
  const auto points = contacts.points();
  const Resultant r = resultant(points, f, x, {10.95, 20.7, 1});
  const bool upper_first = points[0].vertex[0] >= 8;
  const Real sign = upper_first ? 1 : -1, area = 1.5 * 0.8;
  EXPECT_NEAR(sign * r.force[2], 2e9 * 1e-5 * area, 1e-6);
  EXPECT_NEAR(sign * r.force[0], -0.7e9 * 3e-5 * area, 1e-6);
  EXPECT_NEAR(sign * r.force[1], 0.7e9 * 2e-5 * area, 1e-6);
  EXPECT_NEAR(f.energy.elastic, 0.5 * area * (2e9 * 1e-10 + 0.7e9 * 13e-10),
              1e-9);  // places of 20 m to 4e-15, over 1e-5
}

TEST(Contacts, TangentsAreTheDerivativesOfTheForces) {
  std::mt19937 random(4);
  std::uniform_real_distribution<Real> unit(-1, 1);
  auto bodies = stack(box_body({10.2, 20.3, 1}, {11.7, 21.1, 2}));
  const SurfaceArrays s = reference::surfaces_of(bodies, joint_at_top(bodies));
  auto o = options();
  o.laws[0].cohesion = o.laws[0].residual_cohesion = o.laws[0].tensile_strength = 0;
  o.laws[0].dilation = 0.2;
  Contacts contacts(s, o);
  contacts.detect(s.vertex);
  move_upper(bodies, {5e-5, 4e-5, -2e-5});
  const auto x = reference::places_of(bodies);
  const auto points = contacts.points();
  const auto f = contacts.evaluate(x);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec3> way(x.size()), one = x, two = x;
    for (std::size_t v = 0; v < x.size(); ++v) {
      way[v] = {unit(random), unit(random), unit(random)};
      one[v] += 1e-9 * way[v];
      two[v] -= 1e-9 * way[v];
    }
    const auto f1 = contacts.evaluate(one), f2 = contacts.evaluate(two);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Vec3 d{};
      for (int k = 0; k < 6; ++k) d += points[i].weight[k] * way[points[i].vertex[k]];
      for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(dot(f.tangent[i][a], d), -(f1.force[i][a] - f2.force[i][a]) / 2e-9, 2e4);
    }
  }
}

TEST(Contacts, KeepTheShearForceWhileTheOverlapChanges) {
  auto bodies = stack(box_body({10, 20, 1}, {11.5, 21.5, 2}));
  const SurfaceArrays s = reference::surfaces_of(bodies, joint_at_top(bodies));
  Contacts contacts(s, options());
  contacts.detect(s.vertex);
  move_upper(bodies, {2e-5, 1e-5, -1e-5});
  auto x = reference::places_of(bodies);
  contacts.accept(x);
  contacts.detect(x);
  const Vec3 before = resultant(contacts.points(), contacts.evaluate(x), x, {}).force;
  EXPECT_GT(std::abs(before[0]), 1e4);
  // Off the edge of the lower block: corners die and are born. Steps without relative motion carry the force on.
  for (int step = 0; step < 20; ++step) {
    const Vec3 by = step % 2 == 0 ? Vec3{-0.03, -0.02, 0} : Vec3{-0.01, 0.015, 0};
    move_upper(bodies, by);
    x = reference::places_of(bodies);
    contacts.detect(x);
    const auto points = contacts.points();
    const Vec3 after = resultant(points, contacts.evaluate(x), x, {}).force;
    // what the motion itself adds, elastic: k_s · area · by
    Real area = 0;
    for (const ContactPoint& p : points) area += p.area;
    const Real sign = points[0].vertex[0] >= 8 ? 1 : -1;
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(after[d] + sign * 0.7e9 * area * by[d], before[d], 1e-6 * 0.7e9) << step;
    // go back on the same points and forget the motion: the step is dropped
    for (Vec3& v : bodies[1].vertex) v = v - by;
    x = reference::places_of(bodies);
    contacts.detect(x);
  }
}

TEST(Contacts, TurnWithTheRockWithoutForceOfTheirOwn) {
  auto bodies = stack(box_body({10.2, 20.3, 1}, {11.7, 21.1, 2}));
  const SurfaceArrays s = reference::surfaces_of(bodies, joint_at_top(bodies));
  Contacts contacts(s, options());
  contacts.detect(s.vertex);
  move_upper(bodies, {2e-5, 1e-5, -1e-5});
  auto x = reference::places_of(bodies);
  contacts.accept(x);
  contacts.detect(x);
  const Real before = norm(resultant(contacts.points(), contacts.evaluate(x), x, {}).force);
  const Vec3 axis = normalized({1, 2, -0.5});
  Vec3 expected = resultant(contacts.points(), contacts.evaluate(x), x, {}).force;
  for (int step = 0; step < 50; ++step) {
    const Mat3 turn = reference::turn(axis, 0.07);
    for (ConvexBody& b : bodies) reference::move(b, turn, {3, 4, 5}, {0.1, 0, -0.2});
    expected = {dot(turn[0], expected), dot(turn[1], expected), dot(turn[2], expected)};
    x = reference::places_of(bodies);
    contacts.detect(x);
    const Vec3 f = resultant(contacts.points(), contacts.evaluate(x), x, {}).force;
    // 50 steps of rounding places of 30 m: 1e-14 m on 1e9 N/m
    EXPECT_LT(norm(f - expected), 1e-3 + 1e-8 * before) << step;
    contacts.accept(x);
  }
}

TEST(Contacts, ReadAnOverrunAsDeepPenetration) {
  std::vector<ConvexBody> bodies{box_body({0, 0, 0}, {4, 4, 0.1}),
                                 box_body({1, 1, 0.2}, {2, 2, 0.5})};
  const SurfaceArrays s = reference::surfaces_of(bodies);
  Contacts contacts(s, options());
  contacts.detect(s.vertex);
  contacts.accept(s.vertex);
  move_upper(bodies, {0.01, 0, -0.7});  // through the plate and out below
  const auto x = reference::places_of(bodies);
  const DetectReport report = contacts.detect(x);
  EXPECT_NEAR(report.deepest, 0.6, 1e-12);
  EXPECT_GT(report.missed, 0);
}

/// A pile of random bodies, moved; a number of its bits.
std::uint64_t bits_of_a_pile(const std::vector<std::size_t>& order, Real* force = nullptr) {
  std::mt19937 random(12);
  std::vector<ConvexBody> made;
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        ConvexBody b = reference::random_body(random, 0.5);
        reference::shift(b, {1.05 * x, 1.05 * y, 1.05 * z});
        made.push_back(b);
      }
  std::vector<ConvexBody> bodies;
  for (std::size_t i = 0; i < made.size(); ++i)
    bodies.push_back(made[order.empty() ? i : order[i]]);
  const SurfaceArrays s = reference::surfaces_of(bodies);
  Contacts contacts(s, options());
  contacts.detect(s.vertex);
  contacts.accept(s.vertex);
  std::uint64_t hash = 1469598103934665603u;
  Real sum = 0;
  for (int step = 0; step < 10; ++step) {
    for (ConvexBody& body : bodies) reference::shift(body, {0, 0, -1e-4 * body.vertex[0][2]});
    const auto x = reference::places_of(bodies);
    contacts.detect(x);
    const auto f = contacts.evaluate(x);
    contacts.accept(x);
    for (const Vec3& v : f.force) {
      sum += norm(v);
      for (const Real c : v) {
        std::uint64_t u;
        std::memcpy(&u, &c, sizeof u);
        hash = (hash ^ u) * 1099511628211u;
      }
    }
  }
  if (force != nullptr) *force = sum;
  return hash;
}

TEST(Contacts, DoNotDependOnTheNumbersOfBlocks) {
  Real one = 0, two = 0;
  bits_of_a_pile({}, &one);
  std::vector<std::size_t> order(96);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = (i * 35 + 17) % 96;
  bits_of_a_pile(order, &two);
  EXPECT_GT(one, 1e5);
  EXPECT_NEAR(two / one, 1, 1e-9);
}

TEST(Contacts, DISABLED_PrintBits) {
  std::printf("bits %016llx\n", static_cast<unsigned long long>(bits_of_a_pile({})));
}

TEST(Contacts, AreTheSameBitsOnAnyNumberOfThreads) {
  std::string first;
  for (const char* threads : {"1", "2", "4"}) {
    const std::string command = std::string("OMP_PROC_BIND=false OMP_NUM_THREADS=") + threads +
                                " /proc/" + std::to_string(getpid()) +
                                "/exe --gtest_also_run_disabled_tests --gtest_filter=*PrintBits";
    FILE* pipe = popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string bits;
    char line[256];
    while (std::fgets(line, sizeof line, pipe))
      if (std::strncmp(line, "bits ", 5) == 0) bits = line;
    pclose(pipe);
    ASSERT_FALSE(bits.empty());
    if (first.empty()) first = bits;
    EXPECT_EQ(bits, first) << threads;
  }
}

TEST(Contacts, GoOnFromTheirBytesToTheSameBits) {
  auto bodies = stack(box_body({10.2, 20.3, 1}, {11.7, 21.1, 2}));
  const SurfaceArrays s = reference::surfaces_of(bodies, joint_at_top(bodies));
  Contacts one(s, options()), two(s, options());
  one.detect(s.vertex);
  std::vector<Vec3> v(s.vertex.size(), Vec3{0.01, 0, -0.02});
  for (int step = 0; step < 8; ++step) {
    move_upper(bodies, {1e-5, 3e-6, -2e-6});
    const auto x = reference::places_of(bodies);
    one.detect(x);
    one.accept(x, v, 0.01, 200);
    if (step < 3) continue;
    if (step == 3) two.restore(one.bytes());
    if (step > 3) {
      two.detect(x);
      two.accept(x, v, 0.01, 200);
    }
    EXPECT_TRUE(one.bytes() == two.bytes()) << step;
  }
  auto broken = one.bytes();
  broken.pop_back();
  EXPECT_THROW(two.restore(broken), std::invalid_argument);
}

TEST(Contacts, ThatServeOnAfterTheyAreRestoredPressAsBefore) {
  auto bodies = stack(box_body({10.2, 20.3, 1}, {11.7, 21.1, 2}));
  const SurfaceArrays s = reference::surfaces_of(bodies, joint_at_top(bodies));
  ContactOptions o = options();
  o.still = 1e-6;
  Contacts one(s, o), two(s, o);
  one.detect(s.vertex);
  one.accept(s.vertex, std::vector<Vec3>(s.vertex.size()), 0.01, 200);
  two.restore(one.bytes());
  move_upper(bodies, {0, 0, -1e-9});
  const auto x = reference::places_of(bodies);
  one.detect(x);
  EXPECT_TRUE(two.detect(x).served);
  const auto before = one.evaluate(x), after = two.evaluate(x);
  ASSERT_FALSE(after.force.empty());
  EXPECT_EQ(after.force, before.force);
  EXPECT_GT(after.energy.elastic, 0);
}

}  // namespace
}  // namespace rockfold
