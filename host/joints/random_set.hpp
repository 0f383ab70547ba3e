// Joints of a random set, drawn (docs/random_joints.md).
#pragma once

#include <string>
#include <vector>

#include "host/joints/disc.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct DrawnJoint {
  Orientation orientation;  ///< the set's own without scatter, else a normal
  Vec3 point{};             ///< m, on the plane; a disc's centre
  Real radius = 0;          ///< m; infinite = through-going
};

/// More discs than this are refused.
constexpr Real max_discs = 5e6;

/// The joints of a set with `random`, in the order in which they are drawn. `region` (its box, for discs that lie
/// uniformly) is the rock or the solid that the set stays within. Discs that do not meet the region's box are left out.
/// They depend on the set and the region alone. Throws Error(model) at the set's place, with `key` ("joint_set[2]") as the
/// start of the key: for distributions with next to nothing in their window, for absurdly many joints, and for discs
/// without a radius.
std::vector<DrawnJoint> draw_joints(const JointSet& set, const std::vector<Vec3>& region,
                                    const std::string& key);

}  // namespace rockfold
