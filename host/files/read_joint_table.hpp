// Tables of joints in memory.
#pragma once

#include <string>
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

/// What a survey's table says beside orientations, extents and names. Lists are empty where the table has no such column.
struct SurveyColumns {
  bool has_places = false;     ///< x, y, z, or planes by their equations
  bool names_sets = false;     ///< the rows' names are those of sets, not of joints
  std::string name_heading;    ///< as the heading calls the column of names; "" without one
  std::vector<Real> weight;    ///< [rows] > 0
  std::vector<Real> distance;  ///< [rows] m along the scanline
  std::vector<Real>
      line_trend;  ///< [rows] deg, of the scanline that crossed the joint; both or none
  std::vector<Real> line_plunge;
};

/// Likewise of a survey: places may be missing (then they are the origin), and materials are passed over. What stands in `columns` is replaced.
std::vector<JointTable::Row> read_survey_table(std::string_view text, const JointTable& table,
                                               const Place& place, SurveyColumns& columns,
                                               std::vector<Diagnostic>* warnings = nullptr);

}  // namespace rockfold
