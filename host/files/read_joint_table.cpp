#include "host/files/read_joint_table.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "host/files/text.hpp"
#include "src/model/strike.hpp"
#include "src/model/text/nearest.hpp"
#include "src/model/text/numbers/decimal_comma.hpp"
#include "src/model/text/numbers/range.hpp"

namespace rockfold {

namespace {

enum Column { dip, dip_direction, x, y, z, radius, material, strike, diameter, column_count };
constexpr std::array<const char*, column_count> column_names = {
    "dip", "dip_direction", "x", "y", "z", "radius", "material", "strike", "diameter"};
constexpr const char* heading = "dip, dip_direction, x, y, z[, radius, material]";

/// What other programs call them, as bare_name() has it.
const std::array<std::vector<std::string_view>, column_count> other_names = {{
    {"dipangle"},
    {"dipdir", "dipdirn", "dipazimuth", "azimuth", "dd"},
    {"centerx", "centrex", "xcenter", "xcentre", "easting", "east"},
    {"centery", "centrey", "ycenter", "ycentre", "northing", "north"},
    {"centerz", "centrez", "zcenter", "zcentre", "elevation", "altitude"},
}};

/// "dipdir" of "Dip dir. (deg)"
std::string bare_name(std::string_view name) {
  std::string bare;
  for (const char c : lower_case(name.substr(0, name.find_first_of("([{"))))
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) bare += c;
  return bare;
}

bool is_called(std::string_view name, std::size_t column) {
  const auto& others = other_names[column];
  const std::string bare = bare_name(name);
  return bare == bare_name(column_names[column]) ||
         std::find(others.begin(), others.end(), bare) != others.end();
}

Range range_of(Column column) {
  if (column == dip) return between(0, 90, "deg");
  if (column == dip_direction || column == strike) return between(0, 360, "deg");
  return column == radius || column == diameter ? length() : coordinate();
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
  TableReader(const JointTable& table, const std::vector<JointMaterial>& materials,
              const Place& place, std::vector<Diagnostic>* warnings)
      : table_(table), faults_(place), place_of_file_(place), warnings_(warnings) {
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
    tell_of_commas();
    faults_.throw_if_any();
    return std::move(rows_);
  }

 private:
  void read_heading(std::string_view line) {
    separator_ = separator_of(line);
    const auto fields = split(line, separator_, line_, faults_);
    if (std::any_of(fields.begin(), fields.end(), is_number))
      faults_.fail(line_, 0, "holds numbers, must be a heading: " + std::string(heading));
    for (std::size_t c = 0; c < column_count; ++c) {
      find_column(fields, c,
                  [&](const Field& field) { return lower_case(field.text) == column_names[c]; });
      if (!place_[c])
        find_column(fields, c, [&](const Field& field) { return is_called(field.text, c); });
    }
    if (place_[dip_direction]) place_[strike].reset();
    if (place_[radius]) place_[diameter].reset();
    require_columns(fields);
    faults_.throw_if_any();
    tell_of_columns(fields);
    fields_in_line_ = fields.size();
  }

  template <typename Wanted>
  void find_column(const std::vector<Field>& fields, std::size_t column, const Wanted& wanted) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (!wanted(fields[i])) continue;
      if (place_[column])
        faults_.add(line_, fields[i].column, fmt::format("two columns {}", column_names[column]));
      else
        place_[column] = i;
    }
  }

  bool is_read(std::size_t field) const {
    return std::find(place_.begin(), place_.end(), field) != place_.end();
  }

  /// A name near to one that is missing is a slip.
  void require_columns(const std::vector<Field>& fields) {
    std::vector<std::string> missing;
    for (const Column c : {dip, dip_direction, x, y, z})
      if (!place_[c] && !(c == dip_direction && place_[strike]))
        missing.emplace_back(column_names[c]);
    auto wanted = missing;
    if (!place_[radius] && !place_[diameter]) wanted.emplace_back(column_names[radius]);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto nearest = nearest_word(fields[i].text, wanted);
      if (!is_read(i) && !nearest.empty())
        faults_.add(line_, fields[i].column,
                    fmt::format("unknown column {}, did you mean \"{}\"?", quoted(fields[i].text),
                                nearest));
    }
    if (!missing.empty())
      faults_.add(line_, 0, fmt::format("the heading has no column {}", fmt::join(missing, ", ")));
  }

  /// One line for all that is not as it stands.
  void tell_of_columns(const std::vector<Field>& fields) {
    std::vector<std::string> passed_over, notes;
    Place place = place_of_file_;
    place.line = line_;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (is_read(i) || fields[i].text.empty()) continue;
      if (passed_over.empty()) place.column = fields[i].column;
      passed_over.push_back(fields[i].text);
    }
    if (!passed_over.empty())
      notes.push_back(fmt::format(
          "{} passed over: {}",
          passed_over.size() == 1 ? "a column is" : counted(passed_over.size(), "column") + " are",
          fmt::join(passed_over, ", ")));
    if (place_[dip_direction] && bare_name(fields[*place_[dip_direction]].text) == "azimuth")
      notes.emplace_back("azimuth is taken for dip_direction");
    if (place_[strike])
      notes.push_back(fmt::format("planes dip to the {} of their strike (rule)",
                                  table_.left_hand ? "left" : "right"));
    if (place_[diameter]) notes.emplace_back("half of diameter is taken for radius");
    if (!place_[radius] && !place_[diameter])
      notes.emplace_back("without a column radius or diameter all joints are through-going");
    if (warnings_ && !notes.empty())
      warnings_->push_back({place, fmt::format("{}", fmt::join(notes, "; "))});
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
    row.orientation.dip = number(fields, dip);
    row.orientation.dip_direction = place_[strike]
                                        ? dip_direction_of(number(fields, strike), table_.left_hand)
                                        : number(fields, dip_direction);
    row.center = {number(fields, x), number(fields, y), number(fields, z)};
    row.radius = radius_of(fields);
    row.material = material_of(fields);
    rows_.push_back(row);
  }

  /// Where fields are parted by something else, commas are those of decimals, if all of the table's numbers have them.
  std::optional<Real> value_of(const Field& field) {
    if (field.text.find('.') != std::string::npos && point_.line == 0)
      point_ = {line_, field.column, field.text};
    if (separator_ == ',' || !has_decimal_comma(field.text)) return parse_number(field.text);
    if (comma_.line == 0) comma_ = {line_, field.column, field.text};
    std::string english = field.text;
    english[english.find(',')] = '.';
    return parse_number(english);
  }

  void tell_of_commas() {
    if (comma_.line == 0) return;
    if (point_.line != 0)
      return faults_.add(comma_.line, comma_.column,
                         fmt::format("decimals stand behind a comma in {}, behind a point in {} "
                                     "(line {}): must be alike in a table",
                                     comma_.text, point_.text, point_.line));
    Place place = place_of_file_;
    place.line = comma_.line;
    place.column = comma_.column;
    if (warnings_ && faults_.empty())
      warnings_->push_back(
          {place, "decimals are taken to stand behind commas, as in " + comma_.text});
  }

  Real number(const std::vector<Field>& fields, Column column) {
    const Field& field = fields[*place_[column]];
    if ((column == radius || column == diameter) && field.text.empty())
      return std::numeric_limits<Real>::infinity();
    const auto value = value_of(field);
    const Range range = range_of(column);
    if (value && range.holds(*value)) return *value + 0.0;
    faults_.add(
        line_, field.column,
        value ? fmt::format("{} {}, is {:g}", column_names[column], range.refusal(*value), *value)
              : fmt::format("{} {}, is {}{}", column_names[column], range.text(),
                            quoted(field.text), decimal_comma_hint(field.text)));
    return 0;
  }

  Real radius_of(const std::vector<Field>& fields) {
    if (place_[diameter]) return number(fields, diameter) / 2;
    return place_[radius] ? number(fields, radius) : std::numeric_limits<Real>::infinity();
  }

  Index material_of(const std::vector<Field>& fields) {
    if (!place_[material]) return table_.material;
    const Field& field = fields[*place_[material]];
    if (field.text.empty()) return table_.material;
    const auto found = std::find(material_names_.begin(), material_names_.end(), field.text);
    if (found != material_names_.end()) return static_cast<Index>(found - material_names_.begin());
    faults_.add(line_, field.column,
                fmt::format("material: no joint material is called {}{}", quoted(field.text),
                            suggestion(field.text, material_names_, "joint materials")));
    return table_.material;
  }

  const JointTable& table_;
  Faults faults_;
  const Place& place_of_file_;
  std::vector<Diagnostic>* warnings_;
  std::vector<std::string> material_names_;
  std::array<std::optional<std::size_t>, column_count> place_;  ///< of each column in a line
  char separator_ = ',';
  std::size_t fields_in_line_ = 0;  ///< 0 = the heading has not been read
  int line_ = 0;
  struct Seen {
    int line = 0, column = 0;  ///< 0 = none
    std::string text;
  };
  Seen comma_, point_;  ///< the first numbers with a decimal comma and with a point
  std::vector<JointTable::Row> rows_;
};

}  // namespace

std::vector<JointTable::Row> read_joint_table(std::string_view text, const JointTable& table,
                                              const std::vector<JointMaterial>& materials,
                                              const Place& place,
                                              std::vector<Diagnostic>* warnings) {
  return TableReader(table, materials, place, warnings).read(text);
}

}  // namespace rockfold
