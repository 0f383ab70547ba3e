#include "src/arrays/time_table.hpp"

#include <algorithm>

namespace rockfold {
namespace {

/// The first row after t.
std::size_t row_after(const TimeTable& table, Real t) {
  return std::upper_bound(table.time.begin(), table.time.end(), t) - table.time.begin();
}

Vec3 slope_of(const TimeTable& table, std::size_t row) {
  Vec3 slope;
  for (int d = 0; d < 3; ++d)
    slope[d] =
        (table.value[row][d] - table.value[row - 1][d]) / (table.time[row] - table.time[row - 1]);
  return slope;
}

}  // namespace

Vec3 TimeTable::at(Real t) const {
  if (empty()) return {};
  const std::size_t row = row_after(*this, t);
  if (row == 0) return value.front();
  if (row == time.size()) return value.back();
  const Vec3 slope = slope_of(*this, row);
  Vec3 result = value[row - 1];
  for (int d = 0; d < 3; ++d) result[d] += (t - time[row - 1]) * slope[d];
  return result;
}

Vec3 TimeTable::slope_after(Real t) const {
  const std::size_t row = row_after(*this, t);
  return row == 0 || row == time.size() ? Vec3{} : slope_of(*this, row);
}

}  // namespace rockfold
