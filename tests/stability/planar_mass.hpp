// Masses of rigid prisms in a vertical plane, one metre wide: what closed forms and published tables speak of.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/stability/rigid_mass.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

using Point2 = std::array<Real, 2>;  ///< x and z, m

constexpr Real degree = std::numbers::pi / 180;

class PlanarMass {
 public:
  /// N/m³; as shares of it the pull along x.
  explicit PlanarMass(Real unit_weight = 25e3, Real seismic = 0)
      : unit_weight_(unit_weight), seismic_(seismic) {}

  /// A block with these corners, counter-clockwise; its number.
  Index add_block(const std::vector<Point2>& corner) {
    Real area = 0, x = 0, z = 0;
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const Point2 &a = corner[i], &b = corner[(i + 1) % corner.size()];
      const Real part = (a[0] * b[1] - b[0] * a[1]) / 2;
      area += part;
      x += part * (a[0] + b[0]) / 3;
      z += part * (a[1] + b[1]) / 3;
    }
    return add_block(area, {x / area, z / area});
  }
  /// A block of this area, m², and centre.
  Index add_block(Real area, const Point2& centre) {
    const Index number = static_cast<Index>(mass_.bodies.size());
    const Real weight = unit_weight_ * area;
    mass_.bodies.push_back(
        {number, {centre[0], 0.5, centre[1]}, {seismic_ * weight, 0, -weight}, {}});
    return number;
  }

  /// An area from a to b between two blocks (none: held rock); seen along the way the first lies on the left.
  void add_contact(Index first, Index second, const Point2& a, const Point2& b, Real friction,
                   Real cohesion = 0, Real tension = 0) {
    const Vec3 along{b[0] - a[0], 0, b[1] - a[1]};
    ContactArea area;
    area.body = {first, second};
    area.normal = normalized(cross(Vec3{0, -1, 0}, along));
    area.corner = {{a[0], 0, a[1]}, {b[0], 0, b[1]}, {b[0], 1, b[1]}, {a[0], 1, a[1]}};
    area.friction = friction;
    area.cohesion = cohesion;
    area.tension = tension;
    area.joint = "joint";
    mass_.contacts.push_back(area);
  }

  const RigidMass& mass() const { return mass_; }

 private:
  Real unit_weight_, seismic_;
  RigidMass mass_;
};

/// A flat block on a plane that dips by `dip` towards +x: it cannot tip over.
inline RigidMass block_on_plane(Real dip, Real friction, Real cohesion = 0, Real tension = 0) {
  const Point2 along{std::cos(dip), -std::sin(dip)}, up{std::sin(dip), std::cos(dip)};
  const auto at = [&](Real s, Real t) {
    return Point2{s * along[0] + t * up[0], s * along[1] + t * up[1]};
  };
  PlanarMass planar;
  planar.add_block({at(0, 0), at(4, 0), at(4, 1), at(0, 1)});
  planar.add_contact(0, none, at(0, 0), at(4, 0), friction, cohesion, tension);
  return planar.mass();
}

/// An active wedge on 55° pushes a passive one out along 15°; the joint between them is upright.
inline RigidMass bilinear_slope(Real friction) {
  PlanarMass planar;
  const Point2 toe{0, 0}, kink{-10, 2.679491924}, foot{-11.147152873, 4.317796013};
  const Point2 crest{-11.147152873, 20}, behind{-22.12795032, 20}, ahead{-10, 20};
  planar.add_block({toe, ahead, crest, foot, kink});
  planar.add_block({foot, crest, behind});
  planar.add_contact(0, none, kink, toe, friction);
  planar.add_contact(0, none, foot, kink, friction);
  planar.add_contact(1, none, behind, foot, friction);
  planar.add_contact(0, 1, crest, foot, friction);
  return planar.mass();
}

/// By statics of the two wedges, each at its limit.
inline Real two_wedge_factor(Real friction) {
  const Real active = 25e3 * 0.5 * (22.12795032 - 11.147152873) * (20 - 4.317796013);
  const RigidMass slope = bilinear_slope(friction);
  const Real passive = -slope.bodies[0].force[2];
  const Real s1 = std::sin(55 * degree), c1 = std::cos(55 * degree);
  const Real s2 = std::sin(15 * degree), c2 = std::cos(15 * degree);
  // What is missing for the balance of the passive wedge along its plane.
  const auto excess = [&](Real factor) {
    const Real m = friction / factor;
    // N (s1 − m c1) = E and N (c1 + m s1) + m E = W of the active wedge.
    const Real normal = active / (c1 + m * s1 + m * (s1 - m * c1));
    const Real push = normal * (s1 - m * c1);
    const Real weight = passive + m * push;
    return (weight * s2 + push * c2) - m * (weight * c2 - push * s2);
  };
  Real low = 0.2, high = 5;
  for (int i = 0; i < 100; ++i) (excess((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
  return low;
}

}  // namespace rockfold::test
