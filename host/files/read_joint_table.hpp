// Tables of joints in memory.
#pragma once

#include <string_view>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

/// Comma- or semicolon-separated values under a heading with the names dip, dip_direction (deg), x, y, z,
/// radius (m; empty = through-going) and, if it likes, material (a joint material's name; empty = that of
/// the table), in any order and case. Fields may be quoted ("…", "" for a quote); blank lines and lines that
/// begin with '#' are passed over.
/// `place` names the file and the key that names it. Throws Error(model) with all that is wrong.
std::vector<JointTable::Row> read_joint_table(std::string_view text, Index default_material,
                                              const std::vector<JointMaterial>& materials,
                                              const Place& place);

}  // namespace rockfold
