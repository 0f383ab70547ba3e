// A rigid block that moves without turning, in average acceleration with contact at the end of the step: impact, sliding, accounts.
#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "kernels/contact/contact.hpp"
#include "src/base/vector.hpp"
#include "tests/reference/convex_bodies.hpp"

namespace rockfold {
namespace {

/// A cube of 1 m and 2500 kg on a fixed slab, both turned by `slope` about y.
class Block {
 public:
  Block(Real slope, Real height, Real tan_phi, Real restitution)
      : bodies_{reference::box_body({-20, -2, -1}, {20, 2, 0}),
                reference::box_body({0, 0, height}, {1, 1, 1 + height})} {
    for (auto& b : bodies_) reference::move(b, reference::turn({0, 1, 0}, slope), {}, {});
    ContactOptions o;
    JointLaw law;
    law.normal_stiffness = stiffness;
    law.shear_stiffness = stiffness;
    law.friction = law.residual_friction = tan_phi;
    o.laws = {law};
    o.restitution = restitution;
    o.search_distance = 0.2;
    o.skin = 0.5;
    SurfaceArrays surfaces = reference::surfaces_of(bodies_);
    surfaces.block_mass = {1e12, mass};
    contacts_ = std::make_unique<Contacts>(surfaces, o);
    x_ = reference::places_of(bodies_);
    contacts_->detect(x_);
  }

  /// To a new place without motion.
  void put(const Vec3& by) {
    shift(x_, by);
    moved += by;
    contacts_->detect(x_);
    contacts_->accept(x_);
  }

  /// The velocity at the start.
  void launch(const Vec3& v, Real dt) {
    velocity = v;
    contacts_->accept(x_, speeds(v), dt, 2 / dt);
  }

  void step(Real dt) {
    std::vector<Vec3> x = x_;
    Vec3 d = dt * velocity + (0.5 * dt * dt) * gravity;
    shift(x, d);
    for (int outer = 0; outer < 2; ++outer) {
      contacts_->detect(x);
      for (int i = 0; i < 60; ++i)
        if (correct(dt, d, x) < 1e-13) break;
    }
    const Vec3 end = (2 / dt) * d - velocity;
    const auto f = contacts_->evaluate(x, speeds(end), dt, 2 / dt);
    friction += f.energy.friction;
    impact += f.energy.impact;
    elastic = f.energy.elastic;
    least_loss = std::min({least_loss, f.energy.friction, f.energy.impact});
    contacts_->accept(x, speeds(end), dt, 2 / dt);
    x_ = x;
    velocity = end;
    moved += d;
  }

  Real mechanical() const {
    return 0.5 * mass * dot(velocity, velocity) - mass * dot(gravity, moved) + elastic;
  }

  static constexpr Real stiffness = 1e9, mass = 2500;
  const Vec3 gravity{0, 0, -9.81};
  Vec3 velocity{}, moved{};
  Real elastic = 0, friction = 0, impact = 0, least_loss = 0;

 private:
  static void shift(std::vector<Vec3>& x, const Vec3& by) {
    for (std::size_t v = 8; v < 16; ++v) x[v] += by;
  }
  static std::vector<Vec3> speeds(const Vec3& v) {
    std::vector<Vec3> all(16, Vec3{});
    shift(all, v);
    return all;
  }

  /// What is out of balance at a place, N; with the tangent.
  Vec3 residual(Real dt, const Vec3& d, const std::vector<Vec3>& x, Mat3& a) const {
    const Vec3 end = (2 / dt) * d - velocity;
    const auto f = contacts_->evaluate(x, speeds(end), dt, 2 / dt);
    const auto points = contacts_->points();
    Vec3 r = mass * (gravity + (-1 / dt) * (end - velocity));
    a = {};
    for (int i = 0; i < 3; ++i) a[i][i] = 2 * mass / (dt * dt);
    for (std::size_t c = 0; c < points.size(); ++c) {
      const Real sign = points[c].vertex[0] >= 8 ? 1 : -1;
      r += sign * f.force[c];
      for (int i = 0; i < 3; ++i) a[i] += f.tangent[c][i];
    }
    return r;
  }

  /// A Newton iteration with line search; returns by how much d has changed.
  Real correct(Real dt, Vec3& d, std::vector<Vec3>& x) {
    Mat3 a, other;
    const Vec3 r = residual(dt, d, x, a);
    const Vec3 p = cross(a[1], a[2]), q = cross(a[2], a[0]), s = cross(a[0], a[1]);
    const Vec3 way = (1 / dot(a[0], p)) * (r[0] * p + r[1] * q + r[2] * s);
    for (Real share = 1;; share /= 2) {
      const Vec3 by = share * way;
      shift(x, by);
      if (share < 1e-6 || norm(residual(dt, d + by, x, other)) <= (1 - 1e-4 * share) * norm(r)) {
        d += by;
        return norm(by);
      }
      shift(x, -by);
    }
  }

  std::vector<reference::ConvexBody> bodies_;
  std::unique_ptr<Contacts> contacts_;
  std::vector<Vec3> x_;
};

TEST(MovingBlock, SlidesAtTheAccelerationOfStatics) {
  const Real pi = std::acos(-1.0);
  const struct {
    Real slope, friction_angle, acceleration;
  } cases[] = {
      {30, 0, 4.905}, {30, 10, 3.406977}, {30, 20, 1.812815}, {45, 30, 2.931802}, {30, 31, 0}};
  for (const auto& c : cases) {
    const Real a = c.slope * pi / 180;
    Block b(a, 0, std::tan(c.friction_angle * pi / 180), 0);
    const Vec3 n{std::sin(a), 0, std::cos(a)}, down{std::cos(a), 0, -std::sin(a)};
    const Real sunk = Block::mass * 9.81 * std::cos(a) / Block::stiffness;
    const Real held = std::min(std::tan(a), std::tan(c.friction_angle * pi / 180)) * sunk;
    b.put(-sunk * n + held * down);  // in balance, or about to slide
    const Vec3 start = b.moved;
    const Real dt = 0.02;
    for (int i = 0; i < 50; ++i) b.step(dt);
    EXPECT_NEAR(dot(b.moved - start, down), c.acceleration / 2, 5e-4 * c.acceleration + 1e-12);
    EXPECT_GE(b.least_loss, -1e-9);
  }
}

TEST(MovingBlock, ReboundsAndKeepsItsAccounts) {
  for (const Real e : {0.0, 0.5, 1.0})
    for (const Real dt : {1e-4, 1e-3, 5e-3}) {  // ωΔt = 0.06, 0.6 and 3
      Block b(0.3, 0.002, 0, e);                // on a slope, without friction
      const Vec3 n{std::sin(0.3), 0, std::cos(0.3)};
      b.launch(-n, dt);
      const Real begin = b.mechanical();
      Real came = 1, left = 0;
      for (int i = 0; i * dt < 0.012 || i < 4; ++i) {
        b.step(dt);
        came = std::max(came, -dot(b.velocity, n));
        left = std::max(left, dot(b.velocity, n));
        const Real now = b.mechanical() + b.friction + b.impact;
        EXPECT_NEAR(now, begin, 1e-6 * begin) << e << " " << dt << " " << i;
      }
      EXPECT_NEAR(left, e * came, 0.012 + 9.81 * dt) << e << " " << dt;
      EXPECT_GE(b.least_loss, -1e-6 * begin) << e << " " << dt;
    }
}

}  // namespace
}  // namespace rockfold
