// Tables of joints in memory.
#pragma once

#include <string_view>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

/// Values separated by commas, semicolons, tabs or blanks under a heading, in any order and case, with the names that other
/// programs give them: an orientation (dip and dip_direction or strike in degrees or quadrants, both in one as "Dip/DipDir", or
/// a normal nx, ny, nz), a place x, y, z (m), and if it likes what tells how far the joint reaches (radius, or as the diameter of a
/// disc diameter, persistence, extent, trace length, length; m; none = through-going), material (a joint material's name; empty =
/// that of the table) and a name of the set or joint. Or planes A x + B y + C z + D = 0: A, B, C, D, of unit normals without a heading too.
/// A row of units may follow the heading. Fields may be quoted ("…", "" for a quote); blank lines and lines that
/// begin with '#' are passed over, and so are other columns. `warnings`, unless it is null, says so, and what is taken for what.
/// `table` has the material, rule and extents of its rows; `place` names the file and the key that names it.
/// Throws Error(model) with all that is wrong.
std::vector<JointTable::Row> read_joint_table(std::string_view text, const JointTable& table,
                                              const std::vector<JointMaterial>& materials,
                                              const Place& place,
                                              std::vector<Diagnostic>* warnings = nullptr);

}  // namespace rockfold
