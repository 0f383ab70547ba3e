// The plane of two parts that touch along parallel edges or at corners: the middle of the cone of all planes that separate them, whatever the
// order of bodies and faces is and however the whole is turned.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "kernels/contact/contact.hpp"
#include "src/base/vector.hpp"
#include "tests/reference/convex_bodies.hpp"

namespace rockfold {
namespace {

using reference::ConvexBody;

constexpr Real degree = std::numbers::pi / 180;

ContactOptions looking() {
  ContactOptions o;
  JointLaw law;
  law.normal_stiffness = law.shear_stiffness = 1e9;
  law.friction = law.residual_friction = 0.5;
  o.laws = {law};
  o.search_distance = 0.02;
  o.skin = 0.05;
  return o;
}

/// A card of 3 × 1 × 0.1 m in x > 0, whose lower edge of its upper end is the y axis; it rises to it at an angle.
ConvexBody card(Real angle) {
  ConvexBody b = reference::box_body({0, 0, 0}, {3, 1, 0.1});
  reference::move(b, reference::turn({0, 1, 0}, angle), {0, 0, 0}, {0, 0, 0});
  return b;
}

/// In x, with faces that still look outward.
ConvexBody mirrored(ConvexBody b) {
  for (Vec3& v : b.vertex) v[0] = -v[0];
  for (auto& f : b.face) std::reverse(f.begin(), f.end());
  return b;
}

/// From the second body to the first; none: they have no points.
std::optional<Vec3> normal_of(const std::vector<ConvexBody>& bodies,
                              const std::vector<std::vector<Index>>& joint = {}) {
  const SurfaceArrays s = reference::surfaces_of(bodies, joint);
  Contacts contacts(s, looking());
  contacts.detect(s.vertex);
  const auto points = contacts.points();
  if (points.empty()) return std::nullopt;
  for (const ContactPoint& p : points)
    for (int d = 0; d < 3; ++d) EXPECT_EQ(p.normal[d], points[0].normal[d]);
  return Vec3{points[0].normal[0], points[0].normal[1], points[0].normal[2]};
}

void turn_all(std::vector<ConvexBody>& bodies, const Vec3& axis, Real angle, const Vec3& shift) {
  for (ConvexBody& b : bodies)
    reference::move(b, reference::turn(axis, angle), {0.3, 0.2, 0.1}, shift);
}

/// `n` whole, in both orders, and turned with the bodies.
void expect_normal(const std::vector<ConvexBody>& bodies, const Vec3& n) {
  const auto is = [&](const std::vector<ConvexBody>& these, const Vec3& expected) {
    const auto found = normal_of(these);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(norm(*found - expected), 0, 1e-8)
        << (*found)[0] << " " << (*found)[1] << " " << (*found)[2];
  };
  is(bodies, n);
  is({bodies[1], bodies[0]}, -1.0 * n);
  auto turned = bodies;
  const Vec3 axis = normalized(Vec3{1, 2, 3});
  turn_all(turned, axis, 0.7, {5, 6, 7});
  const Mat3 by = reference::turn(axis, 0.7);
  is(turned, {dot(by[0], n), dot(by[1], n), dot(by[2], n)});
}

TEST(MiddleOfACone, OfCardsThatLeanOnEachOtherIsUpright) {
  for (const Real angle : {30.0, 44.06, 45.0, 46.0, 50.0, 60.0, 70.0, 85.0}) {
    SCOPED_TRACE(angle);
    const ConvexBody right = card(angle * degree);
    expect_normal({right, mirrored(right)}, {1, 0, 0});
  }
}

/// The narrower of both wedges alone bounds the cone: its middle is that of the wedge.
TEST(MiddleOfACone, OfAKnifeOnABluntEdgeIsTheKnifesOwn) {
  ConvexBody blunt = reference::box_body({-1, 0, -1}, {0, 2, 0});
  reference::move(blunt, reference::turn({0, 1, 0}, -45 * degree), {0, 0, 0}, {0, 0, 0});
  const auto knife = [](Real tilt) {
    ConvexBody b;  // 20° at its edge, which lies on the blunt edge in part
    for (const Real y : {0.5, 1.5})
      for (const Real side : {0.0, -10.0, 10.0}) {
        const Real a = (side + tilt) * degree;
        b.vertex.push_back(side == 0 ? Vec3{0, y, 0} : Vec3{2 * std::sin(a), y, 2 * std::cos(a)});
      }
    b.face = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    return b;
  };
  // Upright, both wedges have one middle. Tilted by 50° the knife touches along planes of −30° to 130°, the edge along those of −45° to 45°.
  expect_normal({knife(0), blunt}, {0, 0, 1});
  const Real low = (50 + 10 - 90) * degree, high = 45 * degree, middle = 0.5 * (low + high);
  expect_normal({knife(50), blunt}, {std::sin(middle), 0, std::cos(middle)});
}

TEST(MiddleOfACone, OfCornersOnEachOtherOrOnAnEdgeIsTheirAxis) {
  // Cubes that stand on a corner, one turned about the upright diagonal.
  ConvexBody upper = reference::box_body({0, 0, 0}, {1, 1, 1});
  const Vec3 diagonal = normalized(Vec3{1, 1, 1});
  const Vec3 axis = normalized(cross(diagonal, Vec3{0, 0, 1}));
  reference::move(upper, reference::turn(axis, std::acos(1 / std::sqrt(3.0))), {0, 0, 0},
                  {0, 0, 0});
  ConvexBody lower = upper;
  reference::move(lower, reference::turn({1, 0, 0}, 180 * degree), {0, 0, 0}, {0, 0, 0});
  reference::move(lower, reference::turn({0, 0, 1}, 17 * degree), {0, 0, 0}, {0, 0, 0});
  const auto found = normal_of({upper, lower});
  ASSERT_TRUE(found.has_value());
  // Of both triple symmetries the common cone has twice three sides.
  EXPECT_NEAR((*found)[2], 1, 1e-8);
  // On the ridge of a roof of 45°, whose planes the cube's cone lies within along the ridge alone.
  ConvexBody roof = reference::box_body({-1, -1, -1}, {0, 1, 0});
  reference::move(roof, reference::turn({0, 1, 0}, -45 * degree), {0, 0, 0}, {0, 0, 0});
  const auto on_ridge = normal_of({upper, roof});
  ASSERT_TRUE(on_ridge.has_value());
  EXPECT_NEAR((*on_ridge)[1], 0, 1e-8);
}

/// Where joints cross, blocks across from each other touch at an edge alone; others lie between them.
TEST(MiddleOfACone, IsNoPlaneWhereJointsCross) {
  const std::vector<ConvexBody> bodies{reference::box_body({0, 0, 1}, {1, 1, 2}),
                                       reference::box_body({1, 0, 0}, {2, 1, 1})};
  const Index lower_face = 4, upper_face = 5;
  std::vector<std::vector<Index>> joint(2, std::vector<Index>(6, none));
  joint[0][lower_face] = joint[1][upper_face] = 0;
  EXPECT_FALSE(normal_of(bodies, joint).has_value());
  EXPECT_TRUE(normal_of(bodies).has_value());
}

/// Along an edge that stays where it is: by elastic shear it lies on the middle, by more on the face that it slides on.
TEST(MiddleOfACone, PersistsUntilAnEdgeHasSlidOntoAFace) {
  const ConvexBody right = card(50 * degree), left = mirrored(right);
  const SurfaceArrays s = reference::surfaces_of({right, left});
  const Vec3 down{std::cos(50 * degree), 0, -std::sin(50 * degree)};  // the right card's underside
  for (const bool presses : {false, true}) {
    SCOPED_TRACE(presses);
    Contacts contacts(s, looking());
    const auto at = [&](Real slip) {
      auto moved = left;
      reference::shift(moved, slip * down + Vec3{presses ? 1e-5 : 0, 0, 0});
      return reference::places_of({right, moved});
    };
    const auto normal_at = [&](Real slip) {
      contacts.detect(at(slip));
      contacts.accept(at(slip));
      const auto points = contacts.points();
      EXPECT_FALSE(points.empty());
      return points.empty() ? Vec3{}
                            : Vec3{points[0].normal[0], points[0].normal[1], points[0].normal[2]};
    };
    for (const Real slip : {0.0, 1e-6, 1e-5, 5e-5})
      EXPECT_NEAR(norm(normal_at(slip) - Vec3{1, 0, 0}), 0, 1e-8) << slip;
    const Vec3 underside{std::sin(50 * degree), 0, std::cos(50 * degree)};
    for (const Real slip : {2e-3, 1e-2})
      EXPECT_NEAR(norm(normal_at(slip) - underside), 0, 1e-8) << slip;
  }
}

}  // namespace
}  // namespace rockfold
