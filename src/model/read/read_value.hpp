// One TOML value → one C++ value. Each function reports what is wrong at `path` and then returns
// nothing.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "src/arrays/time_table.hpp"
#include "src/model/text/diagnostics.hpp"
#include "src/model/text/numbers/range.hpp"
#include "src/model/text/value.hpp"

namespace rockfold {

std::optional<Real> real_from(const Value& value, const std::string& path, const Range& range,
                              Diagnostics& out);
std::optional<Index> integer_from(const Value& value, const std::string& path,
                                  const IntegerRange& range, Diagnostics& out);
std::optional<bool> boolean_from(const Value& value, const std::string& path, Diagnostics& out);
std::optional<std::string> text_from(const Value& value, const std::string& path, Diagnostics& out);

/// Three numbers, each in the range.
std::optional<Vec3> vector_from(const Value& value, const std::string& path, const Range& range,
                                Diagnostics& out);

/// A vector that gives a direction: not zero, and of a length whose square neither over- nor
/// underflows.
std::optional<Vec3> direction_from(const Value& value, const std::string& path, Diagnostics& out);

/// At least `least` points.
std::optional<std::vector<Vec3>> points_from(const Value& value, const std::string& path,
                                             std::size_t least, Diagnostics& out);

/// Exactly two points; `what` names them, e.g. "corners".
std::optional<std::array<Vec3, 2>> two_points_from(const Value& value, const std::string& path,
                                                   const std::string& what, Diagnostics& out);

/// An array with at least `least` values; `what` says of which, e.g. "3 numbers".
const Array* array_from(const Value& value, const std::string& path, std::size_t least,
                        const std::string& what, Diagnostics& out);

/// Rows [t, x] (width 1, y and z are 0) or [t, x, y, z] (3), times ascending; `range` is that of the values.
std::optional<TimeTable> time_table_from(const Value& value, const std::string& path, int width,
                                         const Range& range, Diagnostics& out);

/// A symmetric 3×3 tensor in the order xx yy zz xy yz zx.
std::optional<std::array<Real, 6>> tensor_from(const Value& value, const std::string& path,
                                               const Range& range, Diagnostics& out);

/// "planes[2]" for index 1: paths count from 1.
std::string item_path(const std::string& path, std::size_t index);

}  // namespace rockfold
