// A barrel vault of voussoirs in running bond, turned off the axes, as a file with rounded coordinates would give it.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold::test {

struct Vault {
  Real radius = 3, thickness = 0.25, width = 0.6;  ///< m
  int courses = 23, along = 8;
  int decimals = 5;

  /// Counter-clockwise from outside, of the corners of a voussoir: 0 … 3 in front, 4 … 7 behind, from below outwards.
  static std::vector<std::vector<int>> quadrilaterals() {
    return {{0, 1, 2, 3}, {7, 6, 5, 4}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  }

  /// The eight corners of each voussoir, m.
  std::vector<std::vector<Vec3>> voussoirs() const {
    std::vector<std::vector<Vec3>> bodies;
    for (int i = 0; i < courses; ++i) {
      std::vector<Real> joint{0};
      for (int k = 1; k <= 2 * along; ++k)
        if (k % 2 == i % 2 && k < 2 * along) joint.push_back(0.5 * k * width);
      joint.push_back(along * width);
      for (std::size_t j = 0; j + 1 < joint.size(); ++j)
        bodies.push_back(voussoir(i, joint[j], joint[j + 1]));
    }
    return bodies;
  }

  Model model() const {
    Model model;
    model.joint_materials.resize(1);
    model.joint_materials[0].name = "mortar";
    model.joint_materials[0].friction_angle = 35;
    for (const auto& corners : voussoirs()) {
      TriangleSurface surface;
      surface.vertices = corners;
      surface.last_digit = std::pow(10.0, -decimals);
      for (const auto& q : quadrilaterals()) {
        surface.triangles.push_back({q[0], q[1], q[2]});
        surface.triangles.push_back({q[0], q[2], q[3]});
      }
      Solid solid;
      solid.name = "v" + std::to_string(model.solids.size());
      solid.shape = MeshShape{"vault.obj", std::make_shared<TriangleSurface>(std::move(surface))};
      solid.material = none;
      solid.continues.assign(1, false);
      solid.interface = 0;
      model.solids.push_back(std::move(solid));
    }
    return model;
  }

 private:
  Real rounded(Real x) const {
    const Real unit = std::pow(10.0, decimals);
    return std::round(x * unit) / unit;
  }

  std::vector<Vec3> voussoir(int course, Real front, Real behind) const {
    constexpr Real turn = 0.3;
    const Real low = std::numbers::pi * course / courses,
               high = std::numbers::pi * (course + 1) / courses;
    const Real outside = radius + thickness;
    std::vector<Vec3> corners;
    for (const Real y : {front, behind})
      for (const auto& [angle, r] :
           {std::pair{low, radius}, {low, outside}, {high, outside}, {high, radius}}) {
        const Real x = r * std::cos(angle);
        corners.push_back({rounded(x * std::cos(turn) - y * std::sin(turn)),
                           rounded(x * std::sin(turn) + y * std::cos(turn)),
                           rounded(r * std::sin(angle))});
      }
    return corners;
  }
};

}  // namespace rockfold::test
