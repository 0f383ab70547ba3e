// Names of joints in results: "map.J1" of row "J1" of table "map".
#pragma once

#include <string>

namespace rockfold {

/// Whether a joint of this name is one that `given` means: that joint, or any of the table of that name.
inline bool is_joint_of(const std::string& joint, const std::string& given) {
  return joint == given ||
         (joint.starts_with(given + ".") && joint != given + ".interface");  // that of a solid
}

}  // namespace rockfold
