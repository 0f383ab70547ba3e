#include "host/files/read_joint_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "host/files/columns.hpp"
#include "host/files/compass.hpp"
#include "host/files/joint_heading.hpp"
#include "host/files/text.hpp"
#include "src/base/vector.hpp"
#include "src/model/strike.hpp"
#include "src/model/text/nearest.hpp"
#include "src/model/text/numbers/decimal_comma.hpp"
#include "src/model/text/numbers/range.hpp"

namespace rockfold {

namespace {

using Column = JointColumn;

constexpr Real infinite = std::numeric_limits<Real>::infinity();
/// Normals of unit length in a table without a heading are rounded to three decimals at least.
constexpr Real unit_normal_tolerance = 2e-3;

/// A little over π/2 and 2π.
constexpr Real most_dip_in_radians = 1.6, most_direction_in_radians = 6.3;

bool is_number(const Field& field) {
  return parse_number(field.text) || has_decimal_comma(field.text);
}

/// Of an upward normal, which may point down and have any length > 0.
DipOrientation orientation_of(Vec3 n) {
  if (n[2] < 0) n = -n;
  constexpr Real degree = std::numbers::pi / 180;
  const Real across = std::hypot(n[0], n[1]);
  return {std::clamp(std::atan2(across, n[2]) / degree, 0.0, 90.0),
          across > 0 ? turned(std::atan2(n[0], n[1]) / degree) : 0};
}

/// "A B C D" of a plane A x + B y + C z + D = 0, in a line without a heading.
bool is_plane_equation(const std::vector<Field>& fields) {
  if (fields.size() != 4) return false;
  Vec3 n{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto value = parse_number(fields[k].text);
    if (!value) return false;
    if (k < 3) n[k] = *value;
  }
  return std::abs(norm(n) - 1) < unit_normal_tolerance;
}

class TableReader {
 public:
  TableReader(const JointTable& table, const std::vector<JointMaterial>& materials,
              const Place& place, std::vector<Diagnostic>* warnings,
              SurveyColumns* survey = nullptr)
      : table_(table),
        faults_(place),
        place_of_file_(place),
        warnings_(warnings),
        survey_(survey),
        heading_(survey ? TableUse::survey : TableUse::joints) {
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
    if (fields_in_line_ == 0)
      faults_.fail("must begin with a heading: " + std::string(joint_heading_text));
    if (!rows_begun_) begin_rows();
    if (rows_.empty() && faults_.empty()) faults_.add(0, 0, "holds no joints below its heading");
    if (heading_.may_be_share() && largest_extent_ > 0 && largest_extent_ <= 1)
      faults_.add(heading_.line(), 0, heading_.share_fault());
    tell_of_columns();
    tell_of_commas();
    tell_of_radians();
    faults_.throw_if_any();
    if (survey_) describe_survey();
    return std::move(rows_);
  }

 private:
  void read_heading(std::string_view line) {
    separator_ = separator_of(line);
    auto fields = split_fields(line, separator_, line_, faults_);
    fields_in_line_ = fields.size();
    if (is_plane_equation(fields)) {
      heading_.take_for_planes();
      without_heading_ = true;
      return read_row(line);
    }
    if (std::any_of(fields.begin(), fields.end(), is_number))
      faults_.fail(line_, 0,
                   "holds numbers, must be a heading: " + std::string(joint_heading_text));
    heading_.read(std::move(fields), line_, faults_);
    faults_.throw_if_any();
  }

  /// Once all that stands before the rows is read.
  void begin_rows() {
    rows_begun_ = true;
    heading_.settle(table_.extent, faults_);
    if (heading_.has(Column::line_trend) != heading_.has(Column::line_plunge))
      faults_.add(heading_.line(), 0,
                  "a scanline has a trend and a plunge: there is a column of one of them alone");
    faults_.throw_if_any();
  }

  /// One line for all that is not as it stands.
  void tell_of_columns() {
    std::vector<std::string> notes;
    Place place = place_of_file_;
    place.line = std::max(heading_.line(), 1);
    if (auto columns = heading_.passed_over(place.column); !columns.empty())
      notes.push_back(std::move(columns));
    if (heading_.has(Column::dip_direction) &&
        bare_name(heading_.name_of(Column::dip_direction)) == "azimuth")
      notes.emplace_back("azimuth is taken for dip_direction");
    if (by_rule_)
      notes.push_back(fmt::format("planes dip to the {} of their strike (rule)",
                                  table_.left_hand ? "left" : "right"));
    if (without_heading_)
      notes.emplace_back(
          "rows of four numbers without a heading, the first three of length 1, are taken for "
          "planes A x + B y + C z + D = 0");
    tell_of_extents(notes);
    for (std::string& line : heading_.converted()) notes.push_back(std::move(line));
    if (warnings_ && !notes.empty())
      warnings_->push_back({place, fmt::format("{}", fmt::join(notes, "; "))});
  }

  void tell_of_extents(std::vector<std::string>& notes) const {
    if (table_.extent == JointTable::Extent::through_going) return;  // the model says so
    if (survey_) return;                                             // nothing is placed
    const auto& extent = heading_.extent();
    if (!extent)
      notes.emplace_back("without a column radius or diameter all joints are through-going");
    else if (*extent == Column::diameter)
      notes.emplace_back("half of diameter is taken for radius");
    else if (*extent != Column::radius)
      notes.push_back(fmt::format(
          "{} is taken for the diameter of discs{}; extents = \"through_going\" takes all joints "
          "as through-going",
          heading_.name_of(*extent), heading_.factor(*extent) == 1 ? " (m)" : ""));
    if (extent && *extent != Column::radius && *extent != Column::diameter && without_extent_ > 0)
      notes.push_back(fmt::format("{} without it {} through-going", counted(without_extent_, "row"),
                                  without_extent_ == 1 ? "is" : "are"));
  }

  void read_row(std::string_view line) {
    auto fields = split_fields(line, separator_, line_, faults_);
    if (fields.empty()) return;
    if (!rows_begun_ && !without_heading_ && are_units(fields)) {
      heading_.read_units(heading_.expanded(std::move(fields), line_, faults_), line_);
      return begin_rows();
    }
    if (!rows_begun_) begin_rows();
    if (fields.size() != fields_in_line_) {
      faults_.add(line_, 0,
                  fmt::format("has {}, the {} {}", counted(fields.size(), "field"),
                              without_heading_ ? "first row" : "heading", fields_in_line_));
      return;
    }
    fields = heading_.expanded(std::move(fields), line_, faults_);
    if (fields.empty()) return;
    JointTable::Row row;
    if (heading_.has(Column::nx)) {
      read_normal(fields, row);
    } else {
      row.orientation = orientation(fields);
      look_at_angles(row.orientation, fields);
    }
    if (!heading_.is_planes() && has_places())
      row.center = {number(fields, Column::x), number(fields, Column::y),
                    number(fields, Column::z)};
    row.radius = radius_of(fields);
    row.material = material_of(fields);
    if (const auto& name = heading_.name_column()) row.name = fields[*name].text;
    rows_.push_back(std::move(row));
    if (survey_) read_survey(fields);
  }

  bool has_places() const {
    return heading_.has(Column::x) && heading_.has(Column::y) && heading_.has(Column::z);
  }

  void read_survey(const std::vector<Field>& fields) {
    const auto add = [&](Column column, std::vector<Real>& list) {
      if (heading_.has(column)) list.push_back(number(fields, column));
    };
    add(Column::weight, survey_->weight);
    add(Column::distance, survey_->distance);
    add(Column::line_trend, survey_->line_trend);
    add(Column::line_plunge, survey_->line_plunge);
  }

  void describe_survey() {
    survey_->has_places = heading_.is_planes() || has_places();
    if (!heading_.name_column()) return;
    survey_->name_heading = heading_.name_heading();
    const std::string name = bare_name(survey_->name_heading);
    survey_->names_sets = name == "set" || name == "jointset" || name == "setname";
  }

  /// The normal, and of an equation the point of the plane nearest to the origin.
  void read_normal(const std::vector<Field>& fields, JointTable::Row& row) {
    const Vec3 n{number(fields, Column::nx), number(fields, Column::ny),
                 number(fields, Column::nz)};
    const Real size = norm(n);
    if (!(size > 0) || !std::isfinite(size) ||
        (without_heading_ && std::abs(size - 1) > unit_normal_tolerance)) {
      const Field& first = fields[*heading_.at(Column::nx)];
      faults_.add(line_, first.column,
                  without_heading_
                      ? fmt::format("the first three numbers must be a normal of length 1, have "
                                    "length {:.4g}: a table without a heading holds planes A x + B "
                                    "y + C z + D = 0",
                                    size)
                      : fmt::format("the normal must have a length > 0, has {:g}", size));
      return;
    }
    row.orientation = orientation_of(n);
    if (!heading_.is_planes()) return;
    const Vec3 foot = (-number(fields, Column::d) / (size * size)) * n;
    row.center = foot + Vec3{};  // no negative zeros
    const Range range = coordinate();
    for (const Real c : foot)
      if (!range.holds(c))
        return faults_.add(
            line_, 0,
            fmt::format("the plane lies {:g} m from the origin: {}", norm(foot), range.refusal(c)));
  }

  /// By angles, or as geologists write them: strike N60E, dip 35SE.
  DipOrientation orientation(const std::vector<Field>& fields) {
    const Field& dip_field = fields[*heading_.at(Column::dip)];
    const auto sided = sided_dip(dip_field.text);
    DipOrientation result;
    result.dip = sided ? in_range(dip_field, Column::dip, sided->dip * heading_.factor(Column::dip))
                       : number(fields, Column::dip);
    if (heading_.has(Column::strike)) {
      result.dip_direction =
          direction_of_strike(fields[*heading_.at(Column::strike)], fields, sided);
      return result;
    }
    const Field& field = fields[*heading_.at(Column::dip_direction)];
    const auto bearing = quadrant_bearing(field.text);
    result.dip_direction = bearing ? *bearing : number(fields, Column::dip_direction);
    if (sided && turn_between(result.dip_direction, sided->side) > widest_side)
      faults_.add(line_, dip_field.column,
                  fmt::format("the dip {} and the dip direction {} name two sides",
                              quoted(dip_field.text), quoted(field.text)));
    return result;
  }

  /// The side that the dip's letters name, or that of the rule for strikes in degrees.
  Real direction_of_strike(const Field& field, const std::vector<Field>& fields,
                           const std::optional<SidedDip>& sided) {
    auto bearing = quadrant_bearing(field.text);
    if (!bearing) bearing = compass_point(field.text);
    const bool by_letters = bearing.has_value();
    const Real strike = by_letters ? *bearing : number(fields, Column::strike);
    if (!sided && by_letters) {
      faults_.add(line_, field.column,
                  fmt::format("the strike {} does not say to which side the plane dips: write the "
                              "dip with its side, as 35SE, the strike in degrees by the right-hand "
                              "rule, or a column dip_direction",
                              quoted(field.text)));
      return 0;
    }
    by_rule_ |= !sided;
    if (!sided) return dip_direction_of(strike, table_.left_hand);
    const Real right = dip_direction_of(strike, false), left = dip_direction_of(strike, true);
    const Real direction =
        turn_between(right, sided->side) < turn_between(left, sided->side) ? right : left;
    if (turn_between(direction, sided->side) > widest_side)
      faults_.add(line_, fields[*heading_.at(Column::dip)].column,
                  fmt::format("the dip {} lies along the strike {}: planes dip across it, to {:g} "
                              "or {:g} deg",
                              quoted(fields[*heading_.at(Column::dip)].text), quoted(field.text),
                              right, left));
    return direction;
  }

  /// Where fields are parted by something else, commas are those of decimals, if all of the table's numbers have them.
  std::optional<Real> value_of(const Field& field) {
    if (const auto grouped = grouped_number(field.text)) return grouped;
    if (field.text.find('.') != std::string::npos && point_.line == 0)
      point_ = {line_, field.column, field.text};
    if (separator_ == ',' || !has_decimal_comma(field.text)) return parse_number(field.text);
    if (comma_.line == 0) comma_ = {line_, field.column, field.text};
    std::string english = field.text;
    english[english.find(',')] = '.';
    return parse_number(english);
  }

  /// All angles are as small as radians, and not all dips whole numbers. A unit in the heading is taken at its word.
  void tell_of_radians() {
    if (heading_.has(Column::nx) || heading_.has_unit(Column::dip) || !warnings_) return;
    if (heading_.has_unit(Column::dip_direction) || heading_.has_unit(Column::strike)) return;
    if (!faults_.empty() || !fractions_ || largest_dip_ == 0 || largest_direction_ == 0) return;
    if (largest_dip_ >= most_dip_in_radians || largest_direction_ >= most_direction_in_radians)
      return;
    Place place = place_of_file_;
    place.line = heading_.line();
    warnings_->push_back(
        {place, fmt::format("no dip is over {:g} deg and no direction over {:g} deg: did you mean "
                            "radians? Then say so in the heading, as {} (rad)",
                            largest_dip_, largest_direction_, heading_.name_of(Column::dip))});
  }

  void look_at_angles(const DipOrientation& plane, const std::vector<Field>& fields) {
    largest_dip_ = std::max(largest_dip_, plane.dip);
    // A strike's own number, not the dip direction that follows from it; quadrants are degrees.
    const Column column = heading_.has(Column::strike) ? Column::strike : Column::dip_direction;
    const auto direction = value_of(fields[*heading_.at(column)]);
    largest_direction_ =
        std::max(largest_direction_, direction.value_or(most_direction_in_radians));
    fractions_ |= plane.dip != std::floor(plane.dip);
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

  Real in_range(const Field& field, Column column, Real value) {
    const Range range = range_of(column);
    if (range.holds(value)) return value + 0.0;
    faults_.add(line_, field.column,
                fmt::format("{} {}, is {:g}", called(column), range.refusal(value), value));
    return 0;
  }

  /// In degrees or metres.
  Real number(const std::vector<Field>& fields, Column column) {
    const Field& field = fields[*heading_.at(column)];
    if (const auto value = value_of(field))
      return in_range(field, column, *value * heading_.factor(column));
    faults_.add(line_, field.column,
                fmt::format("{} {}, is {}{}{}", called(column), range_of(column).text(),
                            quoted(field.text), decimal_comma_hint(field.text),
                            heading_.extent() == column && !has_decimal_comma(field.text)
                                ? "; an empty field is a through-going joint"
                                : ""));
    return 0;
  }

  static std::string called(Column column) { return JointHeading().name_of(column); }

  Real radius_of(const std::vector<Field>& fields) {
    if (!heading_.extent()) return infinite;
    const Column column = *heading_.extent();
    if (fields[*heading_.at(column)].text.empty()) {
      ++without_extent_;
      return infinite;
    }
    const Real value = number(fields, column);
    largest_extent_ = std::max(largest_extent_, value);
    return column == Column::radius ? value : value / 2;
  }

  Index material_of(const std::vector<Field>& fields) {
    if (survey_ || !heading_.has(Column::material)) return table_.material;
    const Field& field = fields[*heading_.at(Column::material)];
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
  SurveyColumns* survey_;  ///< null where joints are read
  std::vector<std::string> material_names_;
  JointHeading heading_;
  char separator_ = ',';
  std::size_t fields_in_line_ = 0;  ///< 0 = the heading has not been read
  bool without_heading_ = false, rows_begun_ = false;
  int line_ = 0;
  bool by_rule_ = false;                          ///< a strike's dip direction is that of the rule
  std::size_t without_extent_ = 0;                ///< rows
  Real largest_extent_ = 0;                       ///< m
  Real largest_dip_ = 0, largest_direction_ = 0;  ///< deg
  bool fractions_ = false;                        ///< a dip is no whole number
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

std::vector<JointTable::Row> read_survey_table(std::string_view text, const JointTable& table,
                                               const Place& place, SurveyColumns& columns,
                                               std::vector<Diagnostic>* warnings) {
  columns = {};
  return TableReader(table, {}, place, warnings, &columns).read(text);
}

}  // namespace rockfold
