// Joints that lie beside the rock and cut nothing: of another coordinate system, or with slips in their numbers.
#pragma once

#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

/// A warning for each [[joint]], [[joint_set]] that is not random, and [[joint_table]] of which some, and each [[joint_mesh]] of which
/// all, lie off the box around the rock (or around the solid that they stay within), and how many. Files have been read before
/// (host/files). Throws what shape_geometry throws.
std::vector<Diagnostic> joints_beside_rock(const Model& model);

}  // namespace rockfold
