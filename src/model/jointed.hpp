// Whether rock is parted into blocks, known before it is cut.
#pragma once

#include <algorithm>

#include "src/model/model.hpp"

namespace rockfold {

/// Joints of any kind, or a solid that an interface parts from the others.
inline bool has_joints(const Model& model) {
  return !model.joints.empty() || !model.joint_sets.empty() || !model.joint_meshes.empty() ||
         !model.joint_tables.empty() ||
         std::any_of(model.solids.begin(), model.solids.end(),
                     [](const Solid& solid) { return solid.interface != none; });
}

}  // namespace rockfold
