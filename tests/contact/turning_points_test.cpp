// The points of faces that turn in their plane while they slide: area, second moments and the torque of a uniform pressure.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "kernels/contact/contact.hpp"
#include "src/base/vector.hpp"
#include "tests/reference/convex_bodies.hpp"

namespace rockfold {
namespace {

using reference::ConvexBody;

ContactOptions options() {
  ContactOptions o;
  JointLaw law;
  law.normal_stiffness = law.shear_stiffness = 1e9;
  law.friction = law.residual_friction = 0.5;
  o.laws = {law};
  o.search_distance = 0.02;
  o.skin = 0.05;
  return o;
}

constexpr Real step = 0.01, turn_of_step = 0.02, pressed = 1e-4;

/// A plate on z = 1, off the middle of a block's top and turned on it, and how it moves.
struct Spinning {
  ConvexBody plate;
  Vec3 centre;
  bool joined;
  Vec3 slides{};  ///< m in a step

  std::vector<ConvexBody> bodies(int steps) const {
    ConvexBody moved = plate;
    reference::move(moved, reference::turn({0, 0, 1}, steps * turn_of_step), centre,
                    steps * slides + Vec3{0, 0, steps > 0 ? -pressed : 0});
    return {reference::box_body({0, 0, 0}, {5, 4, 1}), moved};
  }
  SurfaceArrays surfaces() const {
    std::vector<std::vector<Index>> joint;
    for (const ConvexBody& b : bodies(0)) {
      joint.emplace_back();
      for (const auto& f : b.face) {
        bool flat = joined;
        for (const Index v : f) flat = flat && std::abs(b.vertex[v][2] - 1) < 1e-12;
        joint.back().push_back(flat ? 0 : none);
      }
    }
    return reference::surfaces_of(bodies(0), joint);
  }
  std::vector<Vec3> speeds(const SurfaceArrays& s, const std::vector<Vec3>& x) const {
    std::vector<Vec3> v(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      if (s.vertex_block[i] == 1)
        v[i] = (1 / step) * (slides + turn_of_step * cross(Vec3{0, 0, 1}, x[i] - centre));
    return v;
  }
};

struct Moments {
  std::size_t points = 0;
  Real area = 0, arm = 0, second = 0;  ///< m², m³, m⁴
};

/// After one step that presses and turns the plate, and another that turns it on; about its axis.
Moments moments(const Spinning& spinning) {
  const SurfaceArrays s = spinning.surfaces();
  Contacts contacts(s, options());
  contacts.detect(s.vertex);
  contacts.accept(s.vertex);
  const auto first = reference::places_of(spinning.bodies(1));
  contacts.detect(first);
  contacts.accept(first, spinning.speeds(s, first), step, 2 / step);
  const auto x = reference::places_of(spinning.bodies(2));
  contacts.detect(x);
  Moments m;
  for (const ContactPoint& p : contacts.points()) {
    Vec3 place{};
    for (int k = 3; k < 6; ++k) place += -p.weight[k] * x[p.vertex[k]];
    Vec3 r = place - spinning.centre;
    r[2] = 0;
    ++m.points;
    m.area += p.area;
    m.arm += p.area * norm(r);
    m.second += p.area * dot(r, r);
  }
  return m;
}

ConvexBody square(const Vec3& centre) {
  ConvexBody b = reference::box_body(centre - Vec3{0.5, 0.5, 0}, centre + Vec3{0.5, 0.5, 0.1});
  reference::move(b, reference::turn({0, 0, 1}, 0.4), centre, {});
  return b;
}

const Vec3 middle{2.3, 1.9, 1};
const Real square_arm = (std::sqrt(2.0) + std::log(1 + std::sqrt(2.0))) / 6;

TEST(TurningFaces, HaveTheirAreaItsSecondMomentsAndItsArm) {
  const int n = 32;
  const Real a = std::numbers::pi / n, c = std::cos(a), r = 0.8,
             polygon = 0.5 * n * r * r * std::sin(2 * a);
  ConvexBody disc = reference::prism_body(n, r, 0.2);
  reference::shift(disc, middle + Vec3{0, 0, 0.1});
  const Real disc_arm =
      r / 3 * (1 + c * c / std::sin(a) * std::log(std::tan(std::numbers::pi / 4 + a / 2)));
  for (const bool joined : {true, false}) {
    SCOPED_TRACE(joined);
    const Moments of_square = moments({square(middle), middle, joined});
    EXPECT_NEAR(of_square.area, 1, 1e-9);
    EXPECT_NEAR(of_square.arm, square_arm, 1e-9);
    EXPECT_NEAR(of_square.second, 1.0 / 6, 1e-9);
    const Moments of_disc = moments({disc, middle, joined});
    EXPECT_NEAR(of_disc.area, polygon, 1e-9);
    EXPECT_NEAR(of_disc.arm, disc_arm * polygon, 1e-9);
    // A regular polygon's share of the corners is a double root: known to the root of rounding.
    EXPECT_NEAR(of_disc.second, r * r * (1 + 2 * c * c) / 6 * polygon, 1e-7);
  }
}

/// Faces that slide without turning have a joint's five points, or four corners.
TEST(TurningFaces, AloneHaveMorePoints) {
  for (const bool joined : {true, false})
    for (const bool turning : {true, false}) {
      Spinning s{square(middle), middle, joined, {turning ? 0.01 : 0.4, 0, 0}};
      EXPECT_EQ(moments(s).points, turning ? 9U : joined ? 5U : 4U) << joined << turning;
    }
}

}  // namespace
}  // namespace rockfold
