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

}  // namespace rockfold::test
