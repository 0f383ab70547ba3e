#include "host/files/read_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "host/files/columns.hpp"
#include "host/files/text.hpp"
#include "src/base/vector.hpp"
#include "src/model/text/numbers/range.hpp"
#include "src/model/text/numbers/units.hpp"

namespace rockfold {

namespace {

constexpr const char* separators = ",;";

/// m/s²: strong shaking, in scaled records too, is more than this, and numbers in g are less.
constexpr Real weak = 1.5;
/// m/s²: no ground shakes by 5 g; numbers in cm/s² are more.
constexpr Real absurd = 50;

enum Column { time, ax, ay, az, one, column_count };
constexpr std::array<const char*, column_count> column_names = {"t", "ax", "ay", "az", "a"};
const std::array<std::vector<std::string_view>, column_count> other_names = {{
    {"time", "zeit", "tiempo", "temps", "tempo"},
    {"accx", "xacc", "accelx", "accelerationx", "x", "ew", "east"},
    {"accy", "yacc", "accely", "accelerationy", "y", "ns", "north"},
    {"accz", "zacc", "accelz", "accelerationz", "z", "ud", "up", "vertical"},
    {"acc", "accel", "acceleration", "beschleunigung", "aceleracion", "accelerazione", "ag"},
}};

/// "acc" of "Acc g", whose unit stands behind a blank.
std::string name_without_unit(std::string_view heading) {
  if (heading.find_first_of("([{") == std::string_view::npos && !unit_in(heading).empty())
    heading = heading.substr(0, heading.find_last_of(" \t"));
  return bare_name(heading);
}

std::optional<Column> column_called(std::string_view heading) {
  const std::string bare = name_without_unit(heading);
  for (std::size_t c = 0; c < column_count; ++c) {
    const auto& others = other_names[c];
    if (bare == column_names[c] || std::find(others.begin(), others.end(), bare) != others.end())
      return static_cast<Column>(c);
  }
  return {};
}

/// The fields of a heading; where blanks part them, a unit in brackets belongs to the name before it.
std::vector<Field> heading_fields(std::string_view line, int number, Faults& faults) {
  std::vector<Field> fields;
  for (Field& field : split_fields(line, separator_of(line), number, faults))
    if (!fields.empty() && separator_of(line) == ' ' && field.text.front() == '(')
      fields.back().text += " " + field.text;
    else
      fields.push_back(std::move(field));
  return fields;
}

class RecordReader {
 public:
  RecordReader(const BaseAcceleration& base, const Place& place, std::vector<Diagnostic>* warnings)
      : base_(base), place_of_file_(place), faults_(place), warnings_(warnings) {}

  TimeTable read(std::string_view text) {
    for (Lines lines(text); lines.next();) {
      const auto line = trimmed(lines.line());
      if (line.empty() || line.front() == '#') continue;
      line_ = lines.number();
      if (width_ == 0)
        begin(lines.line());
      else if (table_.empty() && has_heading_ && is_units(lines.line()))
        continue;
      else
        read_row(lines.line());
    }
    if (table_.empty() && faults_.empty()) faults_.add(0, 0, "holds no rows t, ax, ay, az");
    faults_.throw_if_any();
    tell_of_size();
    return std::move(table_);
  }

 private:
  /// The first line: a heading, or the first row.
  void begin(std::string_view line) {
    const auto fields = heading_fields(line, line_, faults_);
    faults_.throw_if_any();
    if (!parse_number(Words(line, separators).next())) return read_heading(fields);
    Words words(line, separators);
    while (!words.next().empty()) ++width_;
    const bool is_one = width_ == 2;
    if (!is_one) width_ = 4;
    at_[time] = 0;
    if (is_one) at_[one] = 1;
    for (std::size_t d = 0; d < 3 && !is_one; ++d) at_[ax + d] = d + 1;
    check_direction();
    read_row(line);
  }

  void read_heading(const std::vector<Field>& fields) {
    has_heading_ = true;
    width_ = fields.size();
    std::vector<std::string> unknown;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto column = column_called(fields[i].text);
      if (!column) {
        unknown.push_back(fields[i].text);
        continue;
      }
      if (at_[*column])
        faults_.add(line_, fields[i].column, fmt::format("two columns {}", column_names[*column]));
      at_[*column] = i;
      take_unit(*column, unit_of_heading(fields[i], line_));
    }
    if (at_[ax] || at_[ay] || at_[az]) at_[one].reset();
    if (!at_[time]) faults_.add(line_, 0, "the heading names no column for the time: t (s)");
    if (!at_[ax] && !at_[ay] && !at_[az] && !at_[one])
      faults_.add(line_, 0,
                  "the heading names no acceleration: ax, ay and az, or a of a record with one "
                  "component");
    faults_.throw_if_any();
    check_direction();
    tell_of_columns(unknown);
  }

  void take_unit(Column column, const ColumnUnit& unit) {
    if (unit.text.empty()) return;
    if (base_.unit && column != time) {
      const auto factor = unit_factor(unit.text, "m/s2");
      if (factor && *factor != *base_.unit && !contradiction_) contradiction_ = unit;
      return;
    }
    factor_[column] = unit_factor(unit, column == time ? "s" : "m/s2", faults_);
    unit_known_ |= column != time;
  }

  bool is_units(std::string_view line) {
    const auto fields = split_fields(line, separator_of(line), line_, faults_);
    if (!are_units(fields)) return false;
    for (std::size_t c = 0; c < column_count; ++c)
      if (at_[c] && *at_[c] < fields.size())
        if (const auto unit = unit_alone(fields[*at_[c]].text))
          take_unit(static_cast<Column>(c),
                    {*unit, fields[*at_[c]].text, line_, fields[*at_[c]].column});
    return true;
  }

  /// One component acts in the direction that the model gives, three in their own.
  void check_direction() {
    if (at_[one] && !base_.direction)
      faults_.fail(line_, 0,
                   "holds one component of acceleration: the model must say its direction, "
                   "base_acceleration.direction = [x, y, z]");
    if (!at_[one] && base_.direction)
      faults_.fail(line_, 0,
                   "holds components ax, ay, az: base_acceleration.direction is that of a record "
                   "with one component");
  }

  void tell_of_columns(const std::vector<std::string>& unknown) {
    std::vector<std::string> notes;
    if (!unknown.empty())
      notes.push_back(fmt::format(
          "{} passed over: {}",
          unknown.size() == 1 ? "a column is" : counted(unknown.size(), "column") + " are",
          fmt::join(unknown, ", ")));
    for (const Column c : {ax, ay, az})
      if (!at_[c] && !at_[one])
        notes.push_back(fmt::format("without a column {} it is 0", column_names[c]));
    if (!notes.empty()) warn(fmt::format("{}", fmt::join(notes, "; ")), line_);
  }

  void read_row(std::string_view line) {
    Words words(line, separators);
    std::array<Real, column_count> row{};
    for (std::size_t i = 0; i < width_; ++i) {
      const auto word = words.next();
      const auto column = std::find(at_.begin(), at_.end(), i);
      if (word.empty())
        return faults_.add(line_, words.column(),
                           fmt::format("has {} numbers, must have {}: {}", i, width_, names()));
      if (column == at_.end()) continue;
      const auto c = static_cast<std::size_t>(column - at_.begin());
      const Range range = any_number(c == time ? "s" : "m/s2");
      const auto value = parse_number(word);
      if (!value || !range.holds(*value))
        return faults_.add(
            line_, words.column(),
            value ? fmt::format("{} {}, is {:g}", column_names[c], range.refusal(*value), *value)
                  : fmt::format("{} {}, is {}", column_names[c], range.text(), quoted(word)));
      row[c] = *value * (base_.unit && c != time ? *base_.unit : factor_[c]);
    }
    if (!words.next().empty())
      return faults_.add(line_, words.column(),
                         fmt::format("has more than {} numbers: {}", width_, names()));
    add(row);
  }

  void add(const std::array<Real, column_count>& row) {
    if (!table_.empty() && !(row[time] > table_.time.back()))
      return faults_.add(line_, 1,
                         fmt::format("time {:g} s follows {:g} s, times must ascend", row[time],
                                     table_.time.back()));
    table_.time.push_back(row[time]);
    table_.value.push_back(at_[one] ? row[one] * *base_.direction
                                    : Vec3{row[ax], row[ay], row[az]});
  }

  /// The columns of a row, in their order.
  std::string names() const {
    std::string text;
    for (std::size_t i = 0; i < width_; ++i) {
      const auto column = std::find(at_.begin(), at_.end(), i);
      text += i == 0 ? "" : ", ";
      text +=
          column == at_.end() ? "…" : column_names[static_cast<std::size_t>(column - at_.begin())];
    }
    return text;
  }

  /// Without a unit anywhere: whether it is a size that accelerations in m/s² have. With two: what each of them makes of it.
  void tell_of_size() {
    Real largest = 0;
    for (const Vec3& a : table_.value)
      for (const Real component : a) largest = std::max(largest, std::abs(component));
    const Real scaled = largest * std::abs(base_.scale);
    const Real g = *number_with_unit("1 g", "m/s2");
    if (contradiction_)
      warn(fmt::format("{} contradicts base_acceleration.unit, which goes before it: the largest "
                       "acceleration is then {:.3g} g, by the file {:.3g} g. Take the wrong one of "
                       "the two out",
                       quoted(contradiction_->said_in), scaled / g,
                       scaled / g * *unit_factor(contradiction_->text, "m/s2") / *base_.unit),
           contradiction_->line);
    if (base_.unit || unit_known_) return;
    if (scaled > 0 && scaled < weak)
      warn(
          fmt::format("no unit is given, so that the largest acceleration, {:.3g}, is {:.2g} g: "
                      "did you mean {:.3g} g? Then say base_acceleration.unit = \"g\"; \"m/s2\" if "
                      "it is right",
                      largest, scaled / g, scaled),
          0);
    if (scaled > absurd)
      warn(fmt::format(
               "no unit is given, so that the largest acceleration, {:.4g}, is {:.2g} g: "
               "did you mean cm/s2? Then say base_acceleration.unit = \"cm/s2\"; \"m/s2\" if "
               "it is right",
               largest, scaled / g),
           0);
  }

  void warn(std::string message, int line) {
    Place place = place_of_file_;
    place.line = line;
    if (warnings_) warnings_->push_back({std::move(place), std::move(message)});
  }

  const BaseAcceleration& base_;
  const Place& place_of_file_;
  Faults faults_;
  std::vector<Diagnostic>* warnings_;
  std::array<std::optional<std::size_t>, column_count> at_;  ///< of each column in a line
  std::array<Real, column_count> factor_{1, 1, 1, 1, 1};     ///< s, m/s²: one of its numbers
  std::size_t width_ = 0;  ///< columns of a line; 0: none is read yet
  bool has_heading_ = false, unit_known_ = false;
  std::optional<ColumnUnit> contradiction_;  ///< of the file with the model
  int line_ = 0;
  TimeTable table_;
};

}  // namespace

TimeTable read_record(std::string_view text, const BaseAcceleration& base, const Place& place,
                      std::vector<Diagnostic>* warnings) {
  return RecordReader(base, place, warnings).read(text);
}

}  // namespace rockfold
