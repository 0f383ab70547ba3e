// Which columns of a table of posts are x, y and z.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/files/columns.hpp"

namespace rockfold {

struct PostColumns {
  std::array<std::size_t, 3> at{0, 1, 2};  ///< of x, y and z in a line
  std::array<ColumnUnit, 3> unit;          ///< of x, y and z
  std::array<Real, 3> factor{1, 1, 1};     ///< m, one of the column's numbers; see settle_units()
  std::vector<Field> names;                ///< of all columns; empty: nothing says what they are

  std::size_t last() const;
  /// x, y and z in metres stand first, in this order.
  bool is_plain() const;
  /// Whether a column other than the three stands before the last of them.
  bool has_gap() const { return last() > 2; }
  /// The columns other than the three, as the heading calls them.
  std::vector<std::string> others() const;
};

/// The columns that a heading names; none where it does not name all three. `missing` says what is wrong then.
std::optional<PostColumns> columns_of_heading(std::vector<Field> names, int line,
                                              std::string& missing);

/// Likewise of the key `columns` of a model, whose units must be known.
std::optional<PostColumns> columns_of_model(const std::vector<std::string>& columns,
                                            std::string& missing);

/// A row of units below the heading.
void take_units(PostColumns& columns, const std::vector<Field>& units, int line);

/// Once all units are read. Adds a fault for each that is not known.
void settle_units(PostColumns& columns, Faults& faults);

/// `columns = ["point", "northing", "easting", "elevation", "code"]` for as many columns.
std::string suggested_columns(std::size_t count);

}  // namespace rockfold
