// What the columns of a table of joints are.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/files/columns.hpp"
#include "src/model/model.hpp"
#include "src/model/text/numbers/range.hpp"

namespace rockfold {

/// Columns of a table of joints. Those from `radius` to `length` say how far a joint reaches; normals are (nx, ny, nz), planes
/// nx x + ny y + nz z + d = 0.
enum class JointColumn {
  dip,
  dip_direction,
  strike,
  x,
  y,
  z,
  radius,
  diameter,
  persistence,
  extent,
  trace_length,
  length,
  material,
  nx,
  ny,
  nz,
  d,
  weight,  // of surveys, as are the others from here on
  distance,
  line_trend,
  line_plunge,
  count
};

/// What a table is read for: joints of a model, whose places must be there, or a survey of orientations, whose places may be, and
/// whose columns from `weight` on are read too.
enum class TableUse { joints, survey };

/// The columns of a table by its heading. A heading that gives two values in one, "Dip/DipDir", counts as two fields.
class JointHeading {
 public:
  explicit JointHeading(TableUse use = TableUse::joints) : use_(use) { factor_.fill(1); }
  /// Adds to `faults` what is missing, twice there or near to a name that is missing.
  void read(std::vector<Field> fields, int line, Faults& faults);
  /// Of rows A B C D without a heading, whose planes are A x + B y + C z + D = 0.
  void take_for_planes();
  /// A row of units below the heading.
  void read_units(const std::vector<Field>& fields, int line);
  /// Once all units are read: decides what says how far joints reach. Adds a fault where that is a share, not an extent, and for
  /// each unit that is not known.
  void settle(JointTable::Extent extent, Faults& faults);

  /// Two fields of each that the heading gives in one; others as they are. Adds a fault where a field is not two.
  std::vector<Field> expanded(std::vector<Field> fields, int line, Faults& faults) const;

  /// Where the column stands, counted in expanded fields.
  const std::optional<std::size_t>& at(JointColumn column) const {
    return place_[static_cast<std::size_t>(column)];
  }
  bool has(JointColumn column) const { return at(column).has_value(); }
  /// As the heading calls it; its name where there is no heading.
  std::string name_of(JointColumn column) const;
  /// One of the column's numbers in deg or m.
  Real factor(JointColumn column) const { return factor_[static_cast<std::size_t>(column)]; }
  /// Whether the file says what the column's numbers are in.
  bool has_unit(JointColumn column) const;
  /// The column that names sets or joints.
  const std::optional<std::size_t>& name_column() const { return name_; }
  /// As the heading calls that column; there must be one.
  const std::string& name_heading() const { return fields_[*name_].text; }
  /// The column of extents that counts.
  const std::optional<JointColumn>& extent() const { return extent_; }
  /// Extents that may be a share: persistences without a unit.
  bool may_be_share() const;
  std::string share_fault() const;
  bool is_planes() const { return has(JointColumn::d); }
  int line() const { return line_; }

  /// "2 columns are passed over: RMS, Surface"; "" if all are read. `column` is that of the first, from 1.
  std::string passed_over(int& column) const;
  /// "x (ft), y (ft) are converted, times 0.3048 m", a line for each factor.
  std::vector<std::string> converted() const;

 private:
  void find_columns(Faults& faults);
  void choose_extent(JointTable::Extent extent, Faults& faults);
  void settle_units(Faults& faults);
  bool find(JointColumn column, const auto& wanted, Faults& faults);
  void find_plane_equation();
  void find_names();
  void drop_what_others_say();
  void require_columns(Faults& faults);
  bool is_read(std::size_t field) const;
  std::optional<std::size_t>& place(JointColumn column) {
    return place_[static_cast<std::size_t>(column)];
  }

  TableUse use_;
  std::vector<Field> fields_;        ///< of the heading, expanded
  std::vector<ColumnUnit> unit_;     ///< [fields]
  std::vector<std::size_t> double_;  ///< fields of a line that are two
  std::array<std::optional<std::size_t>, static_cast<std::size_t>(JointColumn::count)> place_;
  std::array<Real, static_cast<std::size_t>(JointColumn::count)> factor_;
  std::optional<std::size_t> name_;
  std::optional<JointColumn> extent_;
  int line_ = 0;
};

/// What a table begins with, for messages.
constexpr const char* joint_heading_text = "dip, dip_direction, x, y, z[, radius, material]";

/// The unit that a column's numbers are used in: "deg", "m", "".
const char* unit_of(JointColumn column);
Range range_of(JointColumn column);

}  // namespace rockfold
