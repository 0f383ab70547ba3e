// Tables of joints in memory.
#pragma once

#include <string_view>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

/// Values separated by commas, semicolons or tabs under a heading with the names dip, dip_direction or strike (deg), x, y, z
/// and, if it likes, radius (m; none = through-going) and material (a joint material's name; empty = that of
/// the table), in any order and case, or names that other programs give them. Fields may be quoted ("…", "" for a quote); blank lines and lines that
/// begin with '#' are passed over, and so are other columns: `warnings` says so, unless it is null.
/// `table` has the material and rule of its rows; `place` names the file and the key that names it. Throws Error(model) with all that is wrong.
std::vector<JointTable::Row> read_joint_table(std::string_view text, const JointTable& table,
                                              const std::vector<JointMaterial>& materials,
                                              const Place& place,
                                              std::vector<Diagnostic>* warnings = nullptr);

}  // namespace rockfold
