#include "src/model/read/read_value.hpp"

#include <algorithm>
#include <cmath>

#include "src/model/text/numbers/decimal_comma.hpp"
#include "src/model/text/numbers/units.hpp"

namespace rockfold {

namespace {

void wrong(const Value& value, const std::string& path, const std::string& expected,
           Diagnostics& out) {
  out.add(value.spot, path, "found " + described(value) + ", " + expected);
}

}  // namespace

std::string item_path(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index + 1) + "]";
}

std::optional<Real> real_from(const Value& value, const std::string& path, const Range& range,
                              Diagnostics& out) {
  const auto* integer = std::get_if<std::int64_t>(&value.data);
  const auto* real = std::get_if<double>(&value.data);
  const auto* text = std::get_if<std::string>(&value.data);
  const auto with_unit = text ? number_with_unit(*text, range.unit) : std::nullopt;
  if (!integer && !real && !with_unit) {
    const std::string hint = text ? decimal_comma_hint(decimal_comma_number(*text)) : "";
    wrong(value, path,
          "must be a number" + (range.unit.empty() ? "" : " (" + range.unit + ")") +
              (text && hint.empty() ? other_units(range.unit) : hint),
          out);
    return {};
  }
  const Real x = with_unit ? *with_unit : real ? *real : static_cast<Real>(*integer);
  if (range.holds(x)) return x;
  wrong(value, path, range.refusal(x), out);
  return {};
}

std::optional<Index> integer_from(const Value& value, const std::string& path,
                                  const IntegerRange& range, Diagnostics& out) {
  const auto* integer = std::get_if<std::int64_t>(&value.data);
  if (integer && range.holds(*integer)) return static_cast<Index>(*integer);
  if (integer && *integer > range.high) {
    wrong(value, path,
          "must be an integer, " + std::to_string(range.low) + " to " + std::to_string(range.high),
          out);
  } else {
    wrong(value, path, range.text(), out);
  }
  return {};
}

std::optional<bool> boolean_from(const Value& value, const std::string& path, Diagnostics& out) {
  if (const auto* boolean = std::get_if<bool>(&value.data)) return *boolean;
  wrong(value, path, "must be true or false", out);
  return {};
}

std::optional<std::string> text_from(const Value& value, const std::string& path,
                                     Diagnostics& out) {
  if (const auto* text = std::get_if<std::string>(&value.data)) return *text;
  wrong(value, path, "must be a text in quotes", out);
  return {};
}

const Array* array_from(const Value& value, const std::string& path, std::size_t least,
                        const std::string& what, Diagnostics& out) {
  const auto* array = std::get_if<Array>(&value.data);
  if (array && array->size() >= least) return array;
  wrong(value, path, "must be " + what, out);
  return nullptr;
}

std::optional<Vec3> vector_from(const Value& value, const std::string& path, const Range& range,
                                Diagnostics& out) {
  const std::string what =
      "must be 3 numbers [x, y, z]" + (range.unit.empty() ? "" : " (" + range.unit + ")");
  const auto* array = std::get_if<Array>(&value.data);
  if (!array || array->size() != 3) {
    wrong(value, path, what, out);
    return {};
  }
  Vec3 result{};
  bool good = true;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto x = real_from((*array)[d], item_path(path, d), range, out);
    good = good && x;
    if (x) result[d] = *x;
  }
  return good ? std::optional(result) : std::nullopt;
}

std::optional<Vec3> direction_from(const Value& value, const std::string& path, Diagnostics& out) {
  const auto direction = vector_from(value, path, any_number(""), out);
  if (!direction) return {};
  const Real size =
      std::max({std::abs((*direction)[0]), std::abs((*direction)[1]), std::abs((*direction)[2])});
  if (size >= 1 / largest_number) return direction;
  out.add(value.spot, path,
          size == 0 ? "found [0, 0, 0], must not be zero"
                    : "must be longer: at least " + number_text(1 / largest_number));
  return {};
}

std::optional<std::vector<Vec3>> points_from(const Value& value, const std::string& path,
                                             std::size_t least, Diagnostics& out) {
  const auto* array =
      array_from(value, path, least, std::to_string(least) + " or more points [x, y, z] (m)", out);
  if (!array) return {};
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < array->size(); ++i)
    if (const auto point = vector_from((*array)[i], item_path(path, i), coordinate(), out))
      points.push_back(*point);
  return points.size() == array->size() ? std::optional(points) : std::nullopt;
}

std::optional<std::array<Vec3, 2>> two_points_from(const Value& value, const std::string& path,
                                                   const std::string& what, Diagnostics& out) {
  const auto* array = std::get_if<Array>(&value.data);
  if (!array || array->size() != 2) {
    wrong(value, path, "must be 2 " + what + " [[x, y, z], [x, y, z]] (m)", out);
    return {};
  }
  const auto first = vector_from((*array)[0], item_path(path, 0), coordinate(), out);
  const auto second = vector_from((*array)[1], item_path(path, 1), coordinate(), out);
  return first && second ? std::optional(std::array{*first, *second}) : std::nullopt;
}

std::optional<TimeTable> time_table_from(const Value& value, const std::string& path, int width,
                                         const Range& range, Diagnostics& out) {
  const std::string unit = range.unit.empty() ? "" : " (s, " + range.unit + ")";
  const std::string row_text = (width == 1 ? "[t, value]" : "[t, x, y, z]") + unit;
  const auto* rows = array_from(value, path, 1, "a table over time, rows " + row_text, out);
  if (!rows) return {};
  TimeTable table;
  bool good = true;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const std::string row_path = item_path(path, i);
    const auto* row = std::get_if<Array>(&(*rows)[i].data);
    if (!row || static_cast<int>(row->size()) != 1 + width) {
      wrong((*rows)[i], row_path, "must be a row " + row_text, out);
      good = false;
      continue;
    }
    std::array<Real, 4> number{};
    for (int k = 0; k <= width; ++k) {
      const auto x =
          real_from((*row)[k], item_path(row_path, k), k == 0 ? any_number("s") : range, out);
      good = good && x;
      number[k] = x.value_or(0);
    }
    if (good && !table.empty() && !(number[0] > table.time.back())) {
      out.add((*rows)[i].spot, row_path,
              "found time " + number_text(number[0]) + " after " + number_text(table.time.back()) +
                  ", times must ascend (s)");
      good = false;
    }
    table.time.push_back(number[0]);
    table.value.push_back({number[1], number[2], number[3]});
  }
  return good ? std::optional(table) : std::nullopt;
}

std::optional<std::array<Real, 6>> tensor_from(const Value& value, const std::string& path,
                                               const Range& range, Diagnostics& out) {
  const auto* rows = std::get_if<Array>(&value.data);
  if (!rows || rows->size() != 3) {
    wrong(value, path,
          "must be 3 rows [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] (" + range.unit + ")", out);
    return {};
  }
  std::array<Vec3, 3> t{};
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = vector_from((*rows)[i], item_path(path, i), range, out);
    good = good && row;
    if (row) t[i] = *row;
  }
  if (!good) return {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j)
      if (t[i][j] != t[j][i]) {
        out.add(value.spot, path,
                std::string("must be symmetric: ") + "xyz"[j] + "xyz"[i] + " is " +
                    number_text(t[j][i]) + ", but " + "xyz"[i] + "xyz"[j] + " is " +
                    number_text(t[i][j]));
        return {};
      }
  return std::array<Real, 6>{t[0][0], t[1][1], t[2][2], t[0][1], t[1][2], t[2][0]};
}

}  // namespace rockfold
