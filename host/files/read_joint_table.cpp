#include "host/files/read_joint_table.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "host/files/text.hpp"
#include "src/model/text/decimal_comma.hpp"
#include "src/model/text/nearest.hpp"
#include "src/model/text/range.hpp"

namespace rockfold {

namespace {

enum Column { dip, dip_direction, x, y, z, radius, material, column_count };
constexpr std::array<const char*, column_count> column_names = {
    "dip", "dip_direction", "x", "y", "z", "radius", "material"};
constexpr const char* heading = "dip, dip_direction, x, y, z, radius[, material]";

Range range_of(Column column) {
  if (column == dip) return between(0, 90, "deg");
  if (column == dip_direction) return between(0, 360, "deg");
  return column == radius ? length() : coordinate();
}

struct Field {
  std::string text;
  int column = 0;  ///< in the line, from 1
};

/// The fields of a line; none after a fault, which is added.
std::vector<Field> split(std::string_view line, char separator, int number, Faults& faults) {
  std::vector<Field> fields;
  std::size_t at = 0;
  while (true) {
    while (at < line.size() && line[at] != separator && (line[at] == ' ' || line[at] == '\t')) ++at;
    Field field{"", static_cast<int>(at) + 1};
    std::size_t end = std::min(line.find(separator, at), line.size());
    if (at < line.size() && line[at] == '"') {
      bool closed = false;
      for (++at; at < line.size() && !closed; ++at) {
        closed = line[at] == '"' && line.substr(at + 1, 1) != "\"";
        if (closed) continue;
        if (line[at] == '"') ++at;
        field.text += line[at];
      }
      end = std::min(line.find(separator, at), line.size());
      if (!closed || !trimmed(line.substr(at, end - at)).empty()) {
        faults.add(number, field.column, "a quoted field must end with its quote");
        return {};
      }
    } else {
      field.text = trimmed(line.substr(at, end - at));
    }
    fields.push_back(std::move(field));
    if (end == line.size()) return fields;
    at = end + 1;
  }
}

/// What stands between the fields of a heading.
char separator_of(std::string_view line) {
  for (const char c : {';', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return '\t';
}

bool is_number(const Field& field) {
  return parse_number(field.text) || has_decimal_comma(field.text);
}

class TableReader {
 public:
  TableReader(Index default_material, const std::vector<JointMaterial>& materials, Faults& faults)
      : default_material_(default_material), faults_(faults) {
    for (const auto& entry : materials) material_names_.push_back(entry.name);
  }

  std::vector<JointTable::Row> read(std::string_view text) {
    for (Lines lines(text); lines.next();) {
      const auto line = trimmed(lines.line());
      if (line.empty() || line.front() == '#') continue;
      line_ = lines.number();
      if (fields_in_line_ == 0)
        read_heading(lines.line());
      else
        read_row(lines.line());
    }
    if (fields_in_line_ == 0) faults_.fail("must begin with a heading: " + std::string(heading));
    if (rows_.empty() && faults_.empty()) faults_.add(0, 0, "holds no joints below its heading");
    faults_.throw_if_any();
    return std::move(rows_);
  }

 private:
  void read_heading(std::string_view line) {
    separator_ = separator_of(line);
    const auto fields = split(line, separator_, line_, faults_);
    if (std::any_of(fields.begin(), fields.end(), is_number))
      faults_.fail(line_, 0, "holds numbers, must be a heading: " + std::string(heading));
    const std::vector<std::string> known(column_names.begin(), column_names.end());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto name = lower_case(fields[i].text);
      const auto column =
          static_cast<std::size_t>(std::find(known.begin(), known.end(), name) - known.begin());
      if (column == known.size())
        faults_.add(line_, fields[i].column,
                    fmt::format("unknown column {}{}", quoted(fields[i].text),
                                suggestion(name, known, "columns")));
      else if (place_[column])
        faults_.add(line_, fields[i].column, fmt::format("two columns {}", known[column]));
      else
        place_[column] = i;
    }
    std::string missing;
    for (std::size_t c = 0; c < material; ++c)
      if (!place_[c]) missing += (missing.empty() ? "" : ", ") + known[c];
    if (!missing.empty())
      faults_.add(line_, 0, fmt::format("the heading has no column {}", missing));
    faults_.throw_if_any();
    fields_in_line_ = fields.size();
  }

  void read_row(std::string_view line) {
    const auto fields = split(line, separator_, line_, faults_);
    if (fields.empty()) return;
    if (fields.size() != fields_in_line_) {
      faults_.add(
          line_, 0,
          fmt::format("has {}, the heading {}", counted(fields.size(), "field"), fields_in_line_));
      return;
    }
    JointTable::Row row;
    row.orientation = {number(fields, dip), number(fields, dip_direction)};
    row.center = {number(fields, x), number(fields, y), number(fields, z)};
    row.radius = number(fields, radius);
    row.material = material_of(fields);
    rows_.push_back(row);
  }

  Real number(const std::vector<Field>& fields, Column column) {
    const Field& field = fields[*place_[column]];
    if (column == radius && field.text.empty()) return std::numeric_limits<Real>::infinity();
    const auto value = parse_number(field.text);
    const Range range = range_of(column);
    if (value && range.holds(*value)) return *value + 0.0;
    faults_.add(
        line_, field.column,
        value ? fmt::format("{} {}, is {:g}", column_names[column], range.refusal(*value), *value)
              : fmt::format("{} {}, is {}{}", column_names[column], range.text(),
                            quoted(field.text), decimal_comma_hint(field.text)));
    return 0;
  }

  Index material_of(const std::vector<Field>& fields) {
    if (!place_[material]) return default_material_;
    const Field& field = fields[*place_[material]];
    if (field.text.empty()) return default_material_;
    const auto found = std::find(material_names_.begin(), material_names_.end(), field.text);
    if (found != material_names_.end()) return static_cast<Index>(found - material_names_.begin());
    faults_.add(line_, field.column,
                fmt::format("material: no joint material is called {}{}", quoted(field.text),
                            suggestion(field.text, material_names_, "joint materials")));
    return default_material_;
  }

  Index default_material_;
  Faults& faults_;
  std::vector<std::string> material_names_;
  std::array<std::optional<std::size_t>, column_count> place_;  ///< of each column in a line
  char separator_ = ',';
  std::size_t fields_in_line_ = 0;  ///< 0 = the heading has not been read
  int line_ = 0;
  std::vector<JointTable::Row> rows_;
};

}  // namespace

std::vector<JointTable::Row> read_joint_table(std::string_view text, Index default_material,
                                              const std::vector<JointMaterial>& materials,
                                              const Place& place) {
  Faults faults(place);
  return TableReader(default_material, materials, faults).read(text);
}

}  // namespace rockfold
