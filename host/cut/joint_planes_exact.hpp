// The planes of all joints and joint sets of a model. CGAL's numbers: include in .cpp only.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/exact/plane_exact.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct JointPlane {
  ExactPlane plane;
  /// Unit normal with the upward sense, and offset: an order that the model's own does not enter.
  std::array<Real, 4> key;
  Index origin;  ///< into Complex::origins: joint sets first, then joints
};

/// All planes of joint sets that meet the convex hull of `corners` (the solids'), and of joints, sorted by key.
/// Throws Error(model) for sets with absurdly many planes or cells.
std::vector<JointPlane> joint_planes(const Model& model, const std::vector<Vec3>& corners,
                                     const Vec3& centre);

/// Throws Error(model) with a place in the model file.
[[noreturn]] void refuse(const Place& place, const std::string& key, const std::string& message);

}  // namespace rockfold
