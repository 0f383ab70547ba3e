// Joints given one by one: [[joint]], [[joint_mesh]], [[joint_table]]. CGAL's numbers: include in .cpp only.
#pragma once

#include <string>

#include "host/joints/place_joints_exact.hpp"

namespace rockfold {

/// Each appends the joint's origins and its joints to `placed`; what lies off the rock is left out. `key` is the entry's
/// path for messages, e.g. "joint[2]". Throws Error(model) for a joint without area.
void place_joint(const Joint& joint, const RockBounds& rock, const std::string& key,
                 PlacedJoints& placed);
void place_mesh(const JointMesh& mesh, const RockBounds& rock, PlacedJoints& placed);
void place_table(const JointTable& table, const std::vector<JointMaterial>& materials,
                 const RockBounds& rock, const std::string& key, PlacedJoints& placed);

}  // namespace rockfold
