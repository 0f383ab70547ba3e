// Detection against trying everything: random convex bodies that touch, overlap a little or nearly touch, at first and in motion.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "kernels/contact/contact.hpp"
#include "src/base/vector.hpp"
#include "tests/reference/convex_bodies.hpp"

namespace rockfold {
namespace {

using reference::ConvexBody;

ContactOptions looking(Real reach, Real skin = 0.05) {
  ContactOptions o;
  JointLaw law;
  law.normal_stiffness = law.shear_stiffness = 1e9;
  law.friction = law.residual_friction = 0.6;
  o.laws = {law};
  o.search_distance = reach;
  o.skin = skin;
  return o;
}

/// A cluster: each body is put beside an earlier one, at a gap between −0.02 and 0.02, some at none.
std::vector<ConvexBody> cluster(std::mt19937& random, int count) {
  std::uniform_real_distribution<Real> unit(-1, 1);
  std::vector<ConvexBody> bodies{reference::random_body(random, 1)};
  while (static_cast<int>(bodies.size()) < count) {
    ConvexBody next = reference::random_body(random, 1);
    const ConvexBody& beside = bodies[static_cast<std::size_t>(random() % bodies.size())];
    reference::shift(next, beside.vertex[0] + 2.0 * reference::random_direction(random));
    const Real gap = random() % 4 == 0 ? 0 : 0.02 * unit(random);
    // Along the widest gap's direction until the gap is as wanted: a few times, for another direction may become the widest.
    for (int i = 0; i < 20; ++i) {
      const auto s = reference::separation(next, beside);
      if (std::abs(gap - s.gap) < 1e-12) break;
      reference::shift(next, (gap - s.gap) * s.direction);
    }
    bodies.push_back(next);
  }
  return bodies;
}

struct PairPoints {
  Real least = 1e30, area = 0, gap = 0, squared = 0;
  Vec3 normal{};
  int closed = 0;
};

/// By (first block, second block).
std::map<std::pair<Index, Index>, PairPoints> by_pair(const std::vector<ContactPoint>& points,
                                                      const SurfaceArrays& s,
                                                      const std::vector<Vec3>& x) {
  std::map<std::pair<Index, Index>, PairPoints> result;
  for (const ContactPoint& p : points) {
    Vec3 d{};
    for (int k = 0; k < 6; ++k) d += p.weight[k] * x[p.vertex[k]];
    const Vec3 n{p.normal[0], p.normal[1], p.normal[2]};
    const Real gap = dot(n, d) + p.offset;
    PairPoints& pair = result[{s.vertex_block[p.vertex[0]], s.vertex_block[p.vertex[3]]}];
    pair.least = std::min(pair.least, gap);
    pair.closed += gap < 0 ? 1 : 0;
    pair.area += p.area;
    pair.gap += p.area * gap;
    pair.squared += p.area * gap * gap;
    pair.normal = n;
    // the sides are opposite each other: apart along the normal alone
    EXPECT_LT(norm(d - dot(n, d) * n), 3 * s.tolerance);
  }
  return result;
}

void compare_scenes(unsigned seed, int scenes) {
  std::mt19937 random(seed);
  int overlaps = 0, touching = 0, apart = 0;
  for (int scene = 0; scene < scenes; ++scene) {
    const auto bodies = cluster(random, 4);
    SurfaceArrays s = reference::surfaces_of(bodies);
    // The sides of joints carry moments exactly, faces that met at their corners.
    const bool joined = scene % 2 == 1;
    if (joined) std::fill(s.face_joint.begin(), s.face_joint.end(), 0);
    Contacts contacts(s, looking(1e3, 1));
    const auto x = reference::places_of(bodies);
    contacts.detect(x);
    const auto found = by_pair(contacts.points(), s, x);
    for (Index a = 0; a < 4; ++a)
      for (Index b = a + 1; b < 4; ++b) {
        const auto best = reference::separation(bodies[a], bodies[b]);
        const auto at = found.find({a, b});
        if (best.gap > 1e-9) {
          ++apart;
          if (at != found.end()) {
            ASSERT_GT(at->second.least, 0) << scene;
          }
          continue;
        }
        ++(best.gap < -1e-9 ? overlaps : touching);
        if (best.gap >= -1e-9) continue;  // touching: points or none, within rounding
        ASSERT_NE(at, found.end()) << scene << " " << a << b << " " << best.gap;
        const PairPoints& p = at->second;
        // Corners lie within 1e-9 of where they should, on slopes of up to a thousand.
        ASSERT_NEAR(p.least, best.gap, 1e-6) << scene;
        const auto shadow = reference::shadow(bodies[a], bodies[b], p.normal);
        ASSERT_NEAR(p.area, shadow.area, 1e-6) << scene;
        ASSERT_NEAR(p.gap, shadow.gap, 1e-5) << scene;
        if (!joined) continue;
        ASSERT_NEAR(p.squared, shadow.squared, 1e-4) << scene;
      }
  }
  std::printf("%d pairs overlap, %d touch, %d are apart\n", overlaps, touching, apart);
  EXPECT_GT(overlaps, scenes);
}

TEST(Detection, MissesNothingAndInventsNothingInRandomScenes) {
  compare_scenes(1, 50);
}
TEST(SlowDetection, MissesNothingAndInventsNothingInManyRandomScenes) {
  compare_scenes(2026, 1000);
}

TEST(Detection, FollowsBodiesThatMove) {
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> unit(-1, 1);
  int closed = 0;
  for (int scene = 0; scene < 20; ++scene) {
    auto bodies = cluster(random, 4);
    const SurfaceArrays s = reference::surfaces_of(bodies);
    Contacts contacts(s, looking(0.02, 0.04));
    contacts.detect(reference::places_of(bodies));
    contacts.accept(reference::places_of(bodies));
    std::vector<Vec3> axis(4), speed(4);
    for (int b = 0; b < 4; ++b) {
      axis[b] = reference::random_direction(random);
      speed[b] = 2e-4 * reference::random_direction(random);
    }
    for (int step = 0; step < 30; ++step) {
      for (int b = 0; b < 4; ++b)
        reference::move(bodies[b], reference::turn(axis[b], 3e-4), bodies[b].vertex[0], speed[b]);
      const auto x = reference::places_of(bodies);
      contacts.detect(x);
      const auto found = by_pair(contacts.points(), s, x);
      for (Index a = 0; a < 4; ++a)
        for (Index b = a + 1; b < 4; ++b) {
          const Real gap = reference::separation(bodies[a], bodies[b]).gap;
          const auto at = found.find({a, b});
          const int points = at == found.end() ? 0 : at->second.closed;
          if (gap > 1e-9) {
            ASSERT_EQ(points, 0) << scene << " " << step << " " << gap;
          }
          if (gap < -1e-9) {
            ASSERT_GT(points, 0) << scene << " " << step << " " << a << b << " " << gap;
            ++closed;
            // The plane that persists need not be the widest, but the overlap is seen.
            ASSERT_LE(at->second.least, 0.5 * gap);
          }
        }
      contacts.accept(x);
    }
  }
  EXPECT_GT(closed, 500);
}

// Where joints cross, blocks across from each other touch at an edge alone: neither joint is the one between them until they move.
TEST(Detection, OfBlocksThatTouchAtAnEdgeFindsTheFaceTheySlideOn) {
  const std::vector<ConvexBody> bodies{reference::box_body({0, 0, 1}, {1, 1, 2}),
                                       reference::box_body({1, 0, 0}, {2, 1, 1})};
  for (const bool over : {true, false}) {
    SCOPED_TRACE(over ? "over the other's top" : "down the other's side");
    const SurfaceArrays s = reference::surfaces_of(bodies);
    Contacts contacts(s, looking(0.02));
    const auto at = [&](Real slip) {
      auto moved = bodies;
      reference::shift(moved[0], over ? Vec3{slip, 0, -1e-5} : Vec3{1e-5, 0, -slip});
      return reference::places_of(moved);
    };
    contacts.detect(at(0));
    contacts.accept(at(0));
    for (const Real slip : {1e-6, 1e-5, 1e-3, 1e-2}) {
      contacts.detect(at(slip));
      contacts.accept(at(slip));
    }
    const auto found = by_pair(contacts.points(), s, at(1e-2));
    ASSERT_EQ(found.size(), 1U);
    const PairPoints& pair = found.begin()->second;
    EXPECT_NEAR(pair.least, -1e-5, 1e-12);
    EXPECT_NEAR(pair.area, 1e-2, 1e-12);
    EXPECT_NEAR(std::abs(over ? pair.normal[2] : pair.normal[0]), 1, 1e-12);
  }
}

}  // namespace
}  // namespace rockfold
