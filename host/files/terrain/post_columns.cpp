#include "host/files/terrain/post_columns.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace rockfold {

namespace {

constexpr std::array<const char*, 3> axis_texts = {"x (east)", "y (north)", "z (up)"};

/// The fields that name the axis in the surest way that any does.
std::vector<std::size_t> fields_of_axis(const std::vector<Field>& names, std::size_t axis) {
  std::vector<std::size_t> found;
  for (const NameKind kind : name_kinds) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (axis_called(bare_name(names[i].text), kind) == axis) found.push_back(i);
    if (!found.empty()) break;
  }
  return found;
}

bool any_called(const std::vector<Field>& names, const auto& wanted) {
  return std::any_of(names.begin(), names.end(),
                     [&](const Field& field) { return wanted(bare_name(field.text)); });
}

std::string why_missing(const std::vector<Field>& names, const std::vector<std::string>& missing) {
  if (any_called(names, [](const std::string& bare) { return is_geographic(bare); }))
    return geographic_advice;
  const auto is_depth = [](const std::string& bare) {
    return bare == "depth" || bare == "tiefe" || bare == "profundidad" || bare == "profondeur";
  };
  if (any_called(names, is_depth))
    return "a depth counts downwards from a level that the file does not say: give a column of "
           "elevations";
  return fmt::format("names no column for {}", fmt::join(missing, " and "));
}

}  // namespace

std::size_t PostColumns::last() const {
  return *std::max_element(at.begin(), at.end());
}

bool PostColumns::is_plain() const {
  return at == std::array<std::size_t, 3>{0, 1, 2} &&
         std::all_of(unit.begin(), unit.end(),
                     [](const ColumnUnit& u) { return unit_factor(u.text, "m") == 1; });
}

std::vector<std::string> PostColumns::others() const {
  std::vector<std::string> others;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(at.begin(), at.end(), i) == at.end() && !names[i].text.empty())
      others.push_back(names[i].text);
  return others;
}

std::optional<PostColumns> columns_of_heading(std::vector<Field> names, int line,
                                              std::string& missing) {
  PostColumns columns;
  std::vector<std::string> absent;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto found = fields_of_axis(names, d);
    if (found.empty()) {
      absent.emplace_back(axis_texts[d]);
    } else if (found.size() > 1) {
      missing = fmt::format("names two columns for {}, {} and {}", axis_texts[d],
                            quoted(names[found[0]].text), quoted(names[found[1]].text));
      return {};
    } else {
      columns.at[d] = found.front();
      columns.unit[d] = unit_of_heading(names[found.front()], line);
    }
  }
  if (!absent.empty()) {
    missing = why_missing(names, absent);
    return {};
  }
  columns.names = std::move(names);
  return columns;
}

std::optional<PostColumns> columns_of_model(const std::vector<std::string>& columns,
                                            std::string& missing) {
  std::vector<Field> names;
  for (const std::string& column : columns) names.push_back({column, 0});
  auto found = columns_of_heading(std::move(names), 0, missing);
  if (!found) return {};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto factor = unit_factor(found->unit[d].text, "m");
    if (!factor) {
      missing = unknown_unit(found->unit[d].said_in, "m");
      return {};
    }
    found->factor[d] = *factor;
  }
  return found;
}

void take_units(PostColumns& columns, const std::vector<Field>& units, int line) {
  for (std::size_t d = 0; d < 3; ++d) {
    if (columns.at[d] >= units.size() || !columns.unit[d].text.empty()) continue;
    const Field& field = units[columns.at[d]];
    columns.unit[d] = {unit_alone(field.text).value_or(""), field.text, line, field.column};
  }
}

void settle_units(PostColumns& columns, Faults& faults) {
  for (std::size_t d = 0; d < 3; ++d) columns.factor[d] = unit_factor(columns.unit[d], "m", faults);
}

std::string suggested_columns(std::size_t count) {
  std::string text = "columns = [";
  if (count > 3) text += "\"point\", ";
  text += "\"northing\", \"easting\", \"elevation\"";
  for (std::size_t i = 4; i < std::min<std::size_t>(count, 5); ++i) text += ", \"code\"";
  return text + "]";
}

}  // namespace rockfold
