#include "host/files/joint_heading.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "host/files/text.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

using Column = JointColumn;
constexpr auto column_count = static_cast<std::size_t>(Column::count);
using WordList = std::vector<std::string_view>;

constexpr std::array<const char*, column_count> column_names = {"dip",
                                                                "dip_direction",
                                                                "strike",
                                                                "x",
                                                                "y",
                                                                "z",
                                                                "radius",
                                                                "diameter",
                                                                "persistence",
                                                                "extent",
                                                                "trace_length",
                                                                "length",
                                                                "material",
                                                                "nx",
                                                                "ny",
                                                                "nz",
                                                                "d",
                                                                "weight",
                                                                "distance",
                                                                "scanline_trend",
                                                                "scanline_plunge"};

/// What other programs and languages call them, as bare_name() has it; of x, y and z see axis_called().
const std::array<WordList, column_count> other_names = {{
    {"dipangle", "fallwinkel", "einfallwinkel", "buzamiento", "pendage"},
    {"dipdir", "dipdirn", "dipazimuth", "azimuth", "dd", "fallrichtung", "einfallrichtung",
     "direccionbuzamiento", "direcciondebuzamiento", "azimutbuzamiento", "azimutpendage"},
    {"strikerhr", "streichen", "rumbo"},
    {},
    {},
    {},
    {"discradius", "radio", "rayon"},
    {"discdiameter", "durchmesser", "diametro", "diametre"},
    {"persistenz", "persistencia", "persistance"},
    {"extension", "ausdehnung"},
    {"trace", "tracelen", "spurlange", "longueurtrace", "longitudtraza"},
    {"jointlength", "fracturelength", "longueur"},
    {},
    {"normalx", "xnormal"},
    {"normaly", "ynormal"},
    {"normalz", "znormal"},
    {},
    {"quantity", "anzahl", "cantidad", "quantite"},
    {"chainage", "measureddepth", "distanz", "distancia"},
    {"traversetrend", "linetrend", "boreholetrend", "holetrend"},
    {"traverseplunge", "lineplunge", "boreholeplunge", "holeplunge"},
}};

bool is_place(Column column) {
  return column == Column::x || column == Column::y || column == Column::z;
}

std::size_t axis_of(Column column) {
  return static_cast<std::size_t>(column) - static_cast<std::size_t>(Column::x);
}

bool is_called(const std::string& bare, Column column) {
  const auto c = static_cast<std::size_t>(column);
  const auto& others = other_names[c];
  return bare == bare_name(column_names[c]) ||
         std::find(others.begin(), others.end(), bare) != others.end();
}

bool is_orientation(const std::string& bare) {
  return is_called(bare, Column::dip) || is_called(bare, Column::dip_direction) ||
         is_called(bare, Column::strike);
}

/// "Dip" and "DipDir" of "Dip/DipDir": an orientation in one field.
std::optional<std::array<Field, 2>> two_in_one(const Field& field) {
  const std::string_view text = field.text;
  const auto name = text.substr(0, text.find_first_of("([{"));
  const auto slash = name.find('/');
  if (slash == std::string_view::npos) return {};
  std::array<Field, 2> parts{{{std::string(trimmed(text.substr(0, slash))), field.column},
                              {std::string(trimmed(text.substr(slash + 1))), field.column}}};
  for (const Field& part : parts)
    if (!is_orientation(bare_name(part.text))) return {};
  return parts;
}

}  // namespace

const char* unit_of(JointColumn column) {
  if (column == Column::dip || column == Column::dip_direction || column == Column::strike)
    return "deg";
  if (column == Column::line_trend || column == Column::line_plunge) return "deg";
  const bool is_length = column >= Column::x && column <= Column::length;
  return is_length || column == Column::distance ? "m" : "";
}

Range range_of(JointColumn column) {
  if (column == Column::dip) return between(0, 90, "deg");
  if (column == Column::dip_direction || column == Column::strike) return between(0, 360, "deg");
  if (column == Column::line_trend) return between(0, 360, "deg");
  if (column == Column::line_plunge) return between(-90, 90, "deg");
  if (column >= Column::nx && column <= Column::d) return any_number("");
  if (column == Column::weight) return positive("");
  return column >= Column::radius && column <= Column::length ? length() : coordinate();
}

void JointHeading::read(std::vector<Field> fields, int line, Faults& faults) {
  line_ = line;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (auto parts = two_in_one(fields[i])) {
      double_.push_back(i);
      std::move(parts->begin(), parts->end(), std::back_inserter(fields_));
    } else {
      fields_.push_back(std::move(fields[i]));
    }
  for (const Field& field : fields_) unit_.push_back(unit_of_heading(field, line));
  find_columns(faults);
  find_plane_equation();
  find_names();
  drop_what_others_say();
  require_columns(faults);
}

void JointHeading::take_for_planes() {
  std::size_t at = 0;
  for (const Column column : {Column::nx, Column::ny, Column::nz, Column::d}) place(column) = at++;
}

void JointHeading::read_units(const std::vector<Field>& fields, int line) {
  for (std::size_t i = 0; i < std::min(fields.size(), unit_.size()); ++i)
    if (unit_[i].text.empty() && !fields[i].text.empty())
      unit_[i] = {unit_alone(fields[i].text).value_or(""), fields[i].text, line, fields[i].column};
}

bool JointHeading::find(JointColumn column, const auto& wanted, Faults& faults) {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (!wanted(fields_[i].text)) continue;
    if (has(column))
      faults.add(
          line_, fields_[i].column,
          fmt::format("two columns {}: {} and {}", column_names[static_cast<std::size_t>(column)],
                      quoted(fields_[*at(column)].text), quoted(fields_[i].text)));
    else
      place(column) = i;
  }
  return has(column);
}

void JointHeading::find_columns(Faults& faults) {
  const auto end =
      use_ == TableUse::survey ? column_count : static_cast<std::size_t>(Column::weight);
  for (std::size_t c = 0; c < end; ++c) {
    const auto column = static_cast<Column>(c);
    const std::string name = column_names[c];
    if (column != Column::d &&
        find(
            column, [&](const std::string& text) { return lower_case(text) == name; }, faults))
      continue;
    if (is_place(column)) {
      for (const NameKind kind : name_kinds)
        if (find(
                column,
                [&](const std::string& text) {
                  return axis_called(bare_name(text), kind) == axis_of(column);
                },
                faults))
          break;
    } else if (column != Column::d) {
      find(
          column, [&](const std::string& text) { return is_called(bare_name(text), column); },
          faults);
    }
  }
}

/// A, B, C and D, or a normal and D, where nothing says a place.
void JointHeading::find_plane_equation() {
  std::array<std::optional<std::size_t>, 4> letters;
  for (std::size_t i = 0; i < fields_.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      if (bare_name(fields_[i].text) == std::string_view("abcd").substr(k, 1)) letters[k] = i;
  if (!letters[3] || has(Column::x) || has(Column::dip)) return;
  if (!has(Column::nx) && letters[0] && letters[1] && letters[2]) {
    place(Column::nx) = letters[0];
    place(Column::ny) = letters[1];
    place(Column::nz) = letters[2];
  }
  if (has(Column::nx) && has(Column::ny) && has(Column::nz)) place(Column::d) = letters[3];
}

/// The column that groups joints most goes before one that numbers them.
void JointHeading::find_names() {
  for (const std::string_view name : {"set", "jointset", "setname", "joint", "jointname", "name",
                                      "label", "type", "jointtype", "id", "jointid"})
    for (std::size_t i = 0; i < fields_.size() && !name_; ++i)
      if (!is_read(i) && bare_name(fields_[i].text) == name) name_ = i;
}

void JointHeading::drop_what_others_say() {
  if (has(Column::dip_direction)) place(Column::strike).reset();
  const bool by_dip = has(Column::dip) && (has(Column::dip_direction) || has(Column::strike));
  const bool by_normal = has(Column::nx) && has(Column::ny) && has(Column::nz);
  const auto drop = [&](std::initializer_list<Column> columns) {
    for (const Column column : columns) place(column).reset();
  };
  if (by_dip || !by_normal)
    drop({Column::nx, Column::ny, Column::nz, Column::d});
  else
    drop({Column::dip, Column::dip_direction, Column::strike});
}

/// A name near to one that is missing is a slip.
void JointHeading::require_columns(Faults& faults) {
  std::vector<std::string> missing;
  const auto need = [&](Column column) {
    if (!has(column)) missing.emplace_back(column_names[static_cast<std::size_t>(column)]);
  };
  if (!has(Column::nx)) {
    need(Column::dip);
    if (!has(Column::strike)) need(Column::dip_direction);
  }
  if (!is_planes() && use_ == TableUse::joints)
    for (const Column column : {Column::x, Column::y, Column::z}) need(column);
  const auto geographic = std::find_if(fields_.begin(), fields_.end(), [](const Field& field) {
    return is_geographic(bare_name(field.text));
  });
  const bool needs_places = use_ == TableUse::joints && !is_planes();
  if (geographic != fields_.end() && (!has(Column::x) || !has(Column::y)) && needs_places)
    return faults.add(line_, geographic->column, geographic_advice);
  auto wanted = missing;
  bool any_extent = false;
  for (auto c = static_cast<std::size_t>(Column::radius);
       c <= static_cast<std::size_t>(Column::length); ++c)
    any_extent |= place_[c].has_value();
  if (!any_extent) wanted.emplace_back("radius");
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto nearest = nearest_word(fields_[i].text, wanted);
    if (!is_read(i) && !nearest.empty())
      faults.add(
          line_, fields_[i].column,
          fmt::format("unknown column {}, did you mean \"{}\"?", quoted(fields_[i].text), nearest));
  }
  if (missing.empty()) return;
  const bool is_nowhere = missing == std::vector<std::string>{"x", "y", "z"};
  faults.add(line_, 0,
             fmt::format("the heading has no column {}{}", fmt::join(missing, ", "),
                         is_nowhere ? ": a table is of joints at known places. Of orientations "
                                      "without a place take each set's mean dip, dip_direction and "
                                      "spacing as a [[joint_set]]"
                                    : ""));
}

void JointHeading::settle(JointTable::Extent extent, Faults& faults) {
  choose_extent(extent, faults);
  settle_units(faults);
}

/// Of the columns that are read.
void JointHeading::settle_units(Faults& faults) {
  for (std::size_t c = 0; c < column_count; ++c) {
    const std::string_view wanted = unit_of(static_cast<Column>(c));
    if (place_[c] && *place_[c] < unit_.size() && !wanted.empty())
      factor_[c] = unit_factor(unit_[*place_[c]], wanted, faults);
  }
}

void JointHeading::choose_extent(JointTable::Extent extent, Faults& faults) {
  const auto drop_others = [&] {
    for (auto c = static_cast<std::size_t>(Column::radius);
         c <= static_cast<std::size_t>(Column::length); ++c)
      if (!extent_ || c != static_cast<std::size_t>(*extent_)) place_[c].reset();
  };
  if (extent == JointTable::Extent::through_going) return drop_others();
  const std::string unit =
      has(Column::persistence) ? unit_[*at(Column::persistence)].text : std::string();
  const bool is_share = unit == "%" || unit == "-" || unit == "1";
  if (!unit.empty() && unit_factor(unit, "m")) extent_ = Column::persistence;
  if (has(Column::radius) || has(Column::diameter)) extent_.reset();
  for (const Column column :
       {Column::radius, Column::diameter, Column::extent, Column::trace_length, Column::length})
    if (!extent_ && has(column)) extent_ = column;
  if (!extent_ && has(Column::persistence) && use_ == TableUse::joints) {
    extent_ = Column::persistence;
    if (is_share) faults.add(line_, fields_[*at(Column::persistence)].column, share_fault());
  }
  drop_others();
}

std::string JointHeading::share_fault() const {
  return fmt::format(
      "{} is a share of the plane, not an extent in metres: give a column radius, diameter or "
      "trace length (m), or the model extents = \"through_going\" if joints go through",
      fields_[*at(Column::persistence)].text);
}

bool JointHeading::may_be_share() const {
  return extent_ == Column::persistence && !has_unit(Column::persistence);
}

std::vector<Field> JointHeading::expanded(std::vector<Field> fields, int line,
                                          Faults& faults) const {
  if (double_.empty()) return fields;
  std::vector<Field> all;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (std::find(double_.begin(), double_.end(), i) == double_.end()) {
      all.push_back(std::move(fields[i]));
      continue;
    }
    const std::string_view text = fields[i].text;
    const auto slash = text.find('/');
    if (slash == std::string_view::npos || text.find('/', slash + 1) != std::string_view::npos) {
      faults.add(line, fields[i].column,
                 fmt::format("must be two values parted by '/', as 060/35, is {}", quoted(text)));
      return {};
    }
    all.push_back({std::string(trimmed(text.substr(0, slash))), fields[i].column});
    all.push_back({std::string(trimmed(text.substr(slash + 1))),
                   fields[i].column + static_cast<int>(slash) + 1});
  }
  return all;
}

std::string JointHeading::name_of(JointColumn column) const {
  return has(column) && *at(column) < fields_.size()
             ? fields_[*at(column)].text
             : column_names[static_cast<std::size_t>(column)];
}

bool JointHeading::has_unit(JointColumn column) const {
  return has(column) && *at(column) < unit_.size() && !unit_[*at(column)].text.empty();
}

bool JointHeading::is_read(std::size_t field) const {
  return name_ == field || std::find(place_.begin(), place_.end(), field) != place_.end();
}

std::string JointHeading::passed_over(int& column) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (is_read(i) || fields_[i].text.empty()) continue;
    if (names.empty()) column = fields_[i].column;
    names.push_back(fields_[i].text);
  }
  if (names.empty()) return "";
  return fmt::format("{} passed over: {}",
                     names.size() == 1 ? "a column is" : counted(names.size(), "column") + " are",
                     fmt::join(names, ", "));
}

std::vector<std::string> JointHeading::converted() const {
  struct Factor {
    Real factor;
    std::string unit, names;
    int count;
  };
  std::vector<Factor> found;
  for (std::size_t c = 0; c < column_count; ++c) {
    if (!place_[c] || factor_[c] == 1) continue;
    const auto column = static_cast<Column>(c);
    const auto same = std::find_if(found.begin(), found.end(), [&](const Factor& f) {
      return f.factor == factor_[c] && f.unit == unit_of(column);
    });
    if (same == found.end())
      found.push_back({factor_[c], unit_of(column), name_of(column), 1});
    else
      same->names += ", " + name_of(column), ++same->count;
  }
  std::vector<std::string> lines;
  for (const Factor& f : found)
    lines.push_back(fmt::format("{} {} converted, times {:.8g} {}", f.names,
                                f.count == 1 ? "is" : "are", f.factor, f.unit));
  return lines;
}

}  // namespace rockfold
