// The one predicate: on which side of a plane lies the meeting point of three others.
#include <random>
#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/exact/exact_oracle.hpp"

namespace rockfold::test {
namespace {

class Side : public testing::Test {
 protected:
  std::mt19937 random{20261121};
  std::normal_distribution<Real> gauss;
  std::uniform_real_distribution<Real> unit{-1, 1};

  Vec3 any_vector() { return {gauss(random), gauss(random), gauss(random)}; }
  Vec3 any_point(Real size) {
    return {size / 2 * unit(random), size / 2 * unit(random), size / 2 * unit(random)};
  }

  // All four of planes 0 … 3 against the meeting point of the other three.
  int checked = 0;
  void check_quadruple(const Planes& planes, Real size, const char* what) {
    for (Index s = 0; s < 4; ++s) {
      const std::array<Index, 3> p{(s + 1) % 4, (s + 2) % 4, (s + 3) % 4};
      if (dot(planes.exact_planes[p[0]].n,
              cross(planes.exact_planes[p[1]].n, planes.exact_planes[p[2]].n)) == 0)
        continue;
      const Answer expected = rule_five(planes, p, s, size);
      if (!expected.decided) continue;
      IntentCount intent;
      const int found = planes.table.side(planes.table.vertex(p[0], p[1], p[2]), s, intent);
      ++checked;
      ASSERT_EQ(found, expected.side)
          << what << ", plane " << s << ", distance "
          << planes.distance(planes.meeting_point(p), s) / size << " of the size";
    }
  }
};

TEST_F(Side, OfRandomPlanesIsTheExactSign) {
  for (int i = 0; i < 2000; ++i) {
    const Real size = std::pow(10.0, i % 9 - 3);
    const Vec3 centre = i % 3 == 0 ? Vec3{5e6, 4e6, 1e3} : any_point(10);
    Planes planes(centre, size);
    for (int p = 0; p < 4; ++p) planes.add(any_vector(), centre + any_point(size));
    check_quadruple(planes, size, "random");
  }
  EXPECT_EQ(checked, 8000);
}

// Small integers: many quadruples meet in one point exactly, and none nearly.
TEST_F(Side, OfLatticePlanesIsTheExactSign) {
  std::uniform_int_distribution<int> small(-3, 3);
  int concurrent = 0;
  for (int i = 0; i < 4000; ++i) {
    Planes planes({}, 4);
    for (int p = 0; p < 4; ++p) {
      Vec3 n{};
      while (norm(n) == 0) n = {1.0 * small(random), 1.0 * small(random), 1.0 * small(random)};
      planes.add(n, {small(random) / 2.0, small(random) / 2.0, small(random) / 2.0});
    }
    check_quadruple(planes, 4, "lattice");
    const auto& n = planes.exact_planes;
    if (dot(n[0].n, cross(n[1].n, n[2].n)) != 0 &&
        planes.value(planes.meeting_point({0, 1, 2}), 3) == 0)
      ++concurrent;
  }
  EXPECT_GT(concurrent, 30);
}

// Four planes that miss a common point by 1e-9 … 1e-13 of the size, or meet there to rounding, the fourth at a wide angle
// with the others: on one side of the tolerance all are concurrent, on the other all have their exact side.
TEST_F(Side, OfNearlyConcurrentPlanesFollowsTheTolerance) {
  for (int i = 0; i < 3000; ++i) {
    const Real size = std::pow(10.0, i % 7 - 3);
    const Vec3 common = any_point(size);
    Planes planes(any_point(size), size);
    for (int p = 0; p < 3; ++p) planes.add(any_vector(), common);
    const Real miss = i % 6 == 5 ? 0 : std::pow(10.0, -9 - i % 5) * size * (i % 2 ? 1 : -1);
    const Vec3 n = normalized(any_vector());
    planes.add(n, common + miss * n);
    check_quadruple(planes, size, "nearly concurrent");
  }
  EXPECT_GT(checked, 11000);
}

// The fourth plane nearly parallel to one of the others: rule 5's guard. Beyond it (sine ≤ 1e-3) the tolerance shrinks with
// the angle, so that what is taken for one point stays as small.
TEST_F(Side, OfNearlyParallelPlanesIsExactBeyondATighterTolerance) {
  const Real sines[] = {1e-2, 1.01e-3, 0.99e-3, 1e-4, 1e-6, 1e-8, 3e-10};
  for (int i = 0; i < 7000; ++i) {
    const Real size = std::pow(10.0, i % 5 - 2);
    const Vec3 common = any_point(size);
    Planes planes(any_point(size), size);
    Vec3 first{};
    for (int p = 0; p < 3; ++p) {
      const Vec3 n = normalized(any_vector());
      if (p == 0) first = n;
      planes.add(n, common);
    }
    const Vec3 across = normalized(cross(first, any_vector()));
    const Vec3 n = normalized(first + sines[i % 7] * across);
    const Real miss = i % 4 == 3 ? 0 : std::pow(10.0, -8 - i % 8) * size * (i % 2 ? 1 : -1);
    planes.add(n, common + miss * n);
    check_quadruple(planes, size, "nearly parallel");
  }
  EXPECT_GT(checked, 20000);
}

// Three planes through one line to rounding, and one across: every vertex on the line is on the third plane.
TEST_F(Side, OfPlanesThroughOneLineIsOn) {
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point = any_point(100), along = any_vector();
    Planes planes({1, 2, 3}, 100);
    for (int p = 0; p < 3; ++p) planes.add(normalized(cross(along, any_vector())), point);
    planes.add(along, any_point(100));
    if (planes.sine(0, 2) < 0.01 || planes.sine(1, 2) < 0.01 || planes.sine(0, 1) < 0.01) continue;
    IntentCount intent;
    EXPECT_EQ(planes.table.side(planes.table.vertex(0, 1, 3), 2, intent), 0);
  }
}

TEST_F(Side, OfAVertexOnItsOwnPlanesIsOn) {
  Planes planes({}, 1);
  for (int p = 0; p < 3; ++p) planes.add(any_vector(), any_point(1));
  IntentCount intent;
  for (Index p = 0; p < 3; ++p)
    EXPECT_EQ(planes.table.side(planes.table.vertex(2, 0, 1), p, intent), 0);
  EXPECT_EQ(intent.vertices_identified + intent.near_decisions, 0);
}

// Whichever of four nearly concurrent planes is asked about, the answer is the same: on, or not on.
TEST_F(Side, IsOnForAllFourOfNearlyConcurrentPlanesOrForNone) {
  int on = 0, off = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 common = any_point(1);
    Planes planes({}, 1);
    for (int p = 0; p < 4; ++p) {
      const Vec3 n = normalized(any_vector());
      planes.add(n, common + (std::pow(10.0, -11 + i % 5 * 0.5) * gauss(random)) * n);
    }
    Real smallest = 1, determinant = 1;
    for (Index p = 0; p < 4; ++p) {
      for (Index q = 0; q < p; ++q) smallest = std::min(smallest, planes.sine(p, q));
      const auto& t = planes.table;
      determinant =
          std::min(determinant, std::abs(dot(t.normal((p + 1) % 4),
                                             cross(t.normal((p + 2) % 4), t.normal((p + 3) % 4)))));
    }
    if (smallest < 1.1e-3 || determinant < 2e-3)
      continue;  // guarded, or a vertex moved by more than 1e-7
    int zeros = 0;
    IntentCount intent;
    for (Index s = 0; s < 4; ++s)
      zeros += planes.table.side(planes.table.vertex((s + 1) % 4, (s + 2) % 4, (s + 3) % 4), s,
                                 intent) == 0;
    EXPECT_TRUE(zeros == 0 || zeros == 4) << zeros;
    ++(zeros == 0 ? off : on);
  }
  EXPECT_GT(on, 500);
  EXPECT_GT(off, 500);
}

// What is counted: an identification is a miss beyond rounding and within the tolerance; a near decision lies within a
// factor 100 of the tolerance on either side.
TEST_F(Side, CountsWhatIntentDecided) {
  const auto ask = [](Real miss) {
    Planes planes({}, 1);
    planes.add({1, 0, 0}, {});
    planes.add({0, 1, 0}, {});
    planes.add({0, 0, 1}, {});
    planes.add({1, 1, 1}, {0, 0, std::sqrt(3.0) * miss});
    IntentCount intent;
    planes.table.side(planes.table.vertex(0, 1, 2), 3, intent);
    return std::pair{intent.vertices_identified, intent.near_decisions};
  };
  EXPECT_EQ(ask(0), std::pair(0, 0));
  EXPECT_EQ(ask(5e-13), std::pair(1, 0));
  EXPECT_EQ(ask(2e-12), std::pair(1, 1));
  EXPECT_EQ(ask(0.9e-10), std::pair(1, 1));
  EXPECT_EQ(ask(1.1e-10), std::pair(0, 1));
  EXPECT_EQ(ask(0.9e-8), std::pair(0, 1));
  EXPECT_EQ(ask(1.1e-8), std::pair(0, 0));
}

// Among planes known exactly nearness is an accident.
TEST_F(Side, OfExactlyKnownPlanesIsTheExactSign) {
  const auto ask = [](Real miss, Known last) {
    PlaneTable table({}, 1);
    for (int d = 0; d < 3; ++d) {
      Vec3 n{};
      n[d] = 1;
      table.add(plane_through(n, {}), Known::exactly);
    }
    const Index fourth = table.add(plane_through({1, 1, 1}, {0, 0, std::sqrt(3.0) * miss}), last);
    IntentCount intent;
    const int side = table.side(table.vertex(0, 1, 2), fourth, intent);
    return std::tuple{side, intent.vertices_identified, intent.near_decisions};
  };
  EXPECT_EQ(ask(0.5e-10, Known::nearly), std::tuple(0, 1, 1));
  EXPECT_EQ(ask(0.5e-10, Known::exactly), std::tuple(-1, 0, 0));
  EXPECT_EQ(ask(1e-20, Known::exactly), std::tuple(-1, 0, 0));
  EXPECT_EQ(ask(-1e-20, Known::exactly), std::tuple(1, 0, 0));
  EXPECT_EQ(ask(0, Known::exactly), std::tuple(0, 0, 0));
}

// A plane that also stands for one known nearly is known only nearly; planes known exactly are one only where they are equal.
TEST(KnownPlanes, CoincideWhereTheyAreEqual) {
  const ExactPlane first = plane_through({1, 2, 3}, {1, 1, 1});
  const auto after = [&](const ExactPlane& second, Known known) {
    PlaneTable table({0.5, 0.25, 0}, 1);
    const Index id = plane_of(table.find_or_add(first, Known::exactly));
    const bool same = plane_of(table.find_or_add(second, known)) == id;
    return std::pair{same, table.exactly_known(id)};
  };
  const ExactPlane equal = plane_through({2, 4, 6}, {1, 1, 1});
  const ExactPlane near = plane_through({1, 2, 3}, {1, 1, 1 + 1e-11});
  EXPECT_EQ(after(equal, Known::exactly), std::pair(true, true));
  EXPECT_EQ(after(opposite(equal), Known::exactly), std::pair(true, true));
  EXPECT_EQ(after(near, Known::exactly), std::pair(false, true));
  EXPECT_EQ(after(equal, Known::nearly), std::pair(true, false));
  EXPECT_EQ(after(near, Known::nearly), std::pair(true, false));

  PlaneTable table({}, 1);
  const HalfSpaceId nearly = table.find_or_add(near, Known::nearly);
  EXPECT_EQ(table.find_or_add(first, Known::exactly), nearly);
}

}  // namespace
}  // namespace rockfold::test
