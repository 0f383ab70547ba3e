#include "host/files/columns.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "host/files/text.hpp"
#include "src/model/text/numbers/units.hpp"

namespace rockfold {

namespace {

constexpr std::string_view opening = "([{", closing = ")]}";

/// What columns hold, and the unit that it is used in.
struct Quantity {
  const char *name, *wanted;
};
constexpr Quantity quantities[] = {
    {"lengths", "m"}, {"angles", "deg"}, {"times", "s"}, {"accelerations", "m/s2"}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Letters of U+00C0 to U+00FF without their accents; '-' for signs.
constexpr std::string_view latin =
    "aaaaaaaceeeeiiiidnooooo-ouuuuytsaaaaaaaceeeeiiiidnooooo-ouuuuyty";

/// Lower case without accents, of UTF-8 or, where the bytes are none, of Latin-1; other letters are left out.
std::string plain_letters(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    if (byte < 0x80) {
      plain += text[i];
    } else if (byte == 0xC3 && next >= 0x80 && next < 0xC0) {
      plain += latin[next - 0x80];
      ++i;
    } else if (byte >= 0xC0 && (next < 0x80 || next >= 0xC0)) {
      plain += latin[byte - 0xC0];
    }
  }
  return lower_case(plain);
}

/// Other names of units, as plain_unit() finds them. "grad" is a gon, whatever a Grad is in German: what is converted is told.
constexpr std::pair<std::string_view, std::string_view> other_unit_names[] = {
    {"metres", "m"},      {"meters", "m"},
    {"metre", "m"},       {"meter", "m"},
    {"mtr", "m"},         {"mts", "m"},
    {"metros", "m"},      {"feet", "ft"},
    {"foot", "ft"},       {"'", "ft"},
    {"intlft", "ft"},     {"intft", "ft"},
    {"ftus", "usft"},     {"us-ft", "usft"},
    {"us_ft", "usft"},    {"usfeet", "usft"},
    {"usfoot", "usft"},   {"ussurveyft", "usft"},
    {"sft", "usft"},      {"ussurveyfeet", "usft"},
    {"surveyft", "usft"}, {"surveyfeet", "usft"},
    {"yard", "yd"},       {"ussurveyfoot", "usft"},
    {"yards", "yd"},      {"inch", "in"},
    {"inches", "in"},     {"surveyfoot", "usft"},
    {"degrees", "deg"},   {"degree", "deg"},
    {"\xC2\xB0", "deg"},  {"\xB0", "deg"},
    {"radians", "rad"},   {"radian", "rad"},
    {"gons", "gon"},      {"grads", "grad"},
    {"seconds", "s"},     {"second", "s"},
    {"sec", "s"},         {"m/s/s", "m/s2"},
    {"m/sec2", "m/s2"},   {"ms-2", "m/s2"},
    {"mps2", "m/s2"},     {"cm/s/s", "cm/s2"},
    {"cms-2", "cm/s2"},   {"gal", "cm/s2"},
    {"cm/sec2", "cm/s2"}, {"percent", "%"}};

/// Behind a unit of heights, as bare_name() has them: above which level they count.
constexpr std::string_view datums[] = {"ahd", "asl", "amsl", "msl", "od",     "aod",    "rl",
                                       "nn",  "unn", "nhn",  "nap", "navd88", "ngvd29", "slm",
                                       "um",  "snm", "nmm",  "ngf", "nzvd",   "odn"};

/// "m/s2" for "m/s²", "m/s^2", "M / S2"; "" for "".
std::string plain_unit(std::string_view text) {
  std::string unit;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text.substr(i, 2) == "²")
      unit += '2', ++i;
    else if (std::string_view("^ *.\t").find(text[i]) == std::string_view::npos)
      unit += text[i];
  unit = lower_case(unit);
  for (const auto& [from, to] : other_unit_names)
    if (unit == from) return std::string(to);
  return unit;
}

bool is_unit(std::string_view unit) {
  if (unit == "%" || unit == "-") return true;
  return std::any_of(std::begin(quantities), std::end(quantities), [&](const Quantity& quantity) {
    return number_with_unit("1 " + std::string(unit), quantity.wanted).has_value();
  });
}

/// "m" of "mahd", "ft" of "ftnavd88"; as it is where no datum stands behind it.
std::string without_datum(const std::string& unit) {
  const std::string bare = bare_name(unit);
  for (const std::string_view length : {"m", "ft", "usft"})
    if (bare.starts_with(length) && std::find(std::begin(datums), std::end(datums),
                                              bare.substr(length.size())) != std::end(datums))
      return std::string(length);
  return unit;
}

bool is_axis(const std::string& unit) {
  const std::string bare = bare_name(unit);
  return std::any_of(std::begin(name_kinds), std::end(name_kinds),
                     [&](NameKind kind) { return axis_called(bare, kind).has_value(); });
}

using WordList = std::vector<std::string_view>;

const std::array<WordList, 3> axis_words = {
    {{"easting",     "eastings",   "east",        "este",   "leste",   "ost",
      "ostwert",     "rechtswert", "rechts",      "utme",   "utmx",    "xcoord",
      "xcoordinate", "coordx",     "xkoordinate", "koordx", "centerx", "centrex",
      "xcenter",     "xcentre",    "cx",          "posx",   "xm"},
     {"northing", "northings",   "north",  "norte",   "nord",    "nordwert",
      "hochwert", "hoch",        "utmn",   "utmy",    "ycoord",  "ycoordinate",
      "coordy",   "ykoordinate", "koordy", "centery", "centrey", "ycenter",
      "ycentre",  "cy",          "posy",   "ym"},
     {"elevation", "elev",        "altitude",  "altitud",      "altura", "alt",
      "height",    "level",       "rl",        "reducedlevel", "hohe",   "hoehe",
      "cota",      "quota",       "elevacion", "elevacao",     "kote",   "up",
      "zcoord",    "zcoordinate", "coordz",    "zkoordinate",  "koordz", "centerz",
      "centrez",   "zcenter",     "zcentre",   "cz",           "posz",   "zm"}}};
constexpr std::array<std::string_view, 3> axis_names = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> axis_letters = {"e", "n", "h"};

/// Whether digits stand in threes behind the first group, and how many groups follow it; then where they end.
struct Groups {
  std::size_t count = 0, end = 0;
  char mark = 0;
};

Groups groups_of(std::string_view text, std::size_t at) {
  Groups groups;
  std::size_t first = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  if (at == first || at - first > 3) return {};
  for (groups.end = at; at < text.size(); groups.end = at) {
    const char mark = text[at];
    if ((mark != ',' && mark != '\'' && mark != ' ') || (groups.mark && mark != groups.mark)) break;
    const auto digits = text.substr(at + 1, 3);
    if (digits.size() < 3 || !std::all_of(digits.begin(), digits.end(), is_digit)) return {};
    groups.mark = mark;
    ++groups.count;
    at += 4;
  }
  return groups;
}

}  // namespace

char separator_of(std::string_view line) {
  for (const char c : {';', ',', '\t'})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::vector<Field> split_fields(std::string_view line, char separator, int number, Faults& faults) {
  std::vector<Field> fields;
  if (separator == ' ') {
    Words words(line);
    for (auto word = words.next(); !word.empty(); word = words.next())
      fields.push_back({std::string(word), words.column()});
    return fields;
  }
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

std::string bare_name(std::string_view heading) {
  std::string bare;
  for (const char c : plain_letters(heading.substr(0, heading.find_first_of("([{,"))))
    if ((c >= 'a' && c <= 'z') || is_digit(c)) bare += c;
  return bare;
}

std::string unit_in(std::string_view heading) {
  const auto begin = heading.find_first_of(opening);
  if (begin != std::string_view::npos) {
    const auto end = std::min(heading.find_first_of(closing, begin), heading.size());
    return plain_unit(heading.substr(begin + 1, end - begin - 1));
  }
  const auto comma = heading.find_last_of(',');
  if (comma != std::string_view::npos) return plain_unit(heading.substr(comma + 1));
  const auto blank = heading.find_last_of(" \t");
  if (blank == std::string_view::npos) return "";
  const std::string last = plain_unit(heading.substr(blank + 1));
  return is_unit(last) ? last : "";
}

ColumnUnit unit_of_heading(const Field& heading, int line) {
  return {unit_in(heading.text), heading.text, line, heading.column};
}

std::optional<std::string> unit_alone(std::string_view text) {
  if (text.size() > 2 && opening.find(text.front()) != std::string_view::npos &&
      closing.find(text.back()) != std::string_view::npos)
    return plain_unit(text.substr(1, text.size() - 2));
  const std::string unit = plain_unit(text);
  return is_unit(unit) ? std::optional(unit) : std::nullopt;
}

std::optional<Real> unit_factor(const std::string& unit, std::string_view wanted) {
  if (unit.empty()) return 1;
  if (wanted != "m") return number_with_unit("1 " + unit, wanted);
  if (is_axis(unit)) return 1;
  return number_with_unit("1 " + without_datum(unit), wanted);
}

std::string unknown_unit(std::string_view said_in, std::string_view wanted) {
  const auto quantity = std::find_if(std::begin(quantities), std::end(quantities),
                                     [&](const Quantity& q) { return q.wanted == wanted; });
  return fmt::format("the unit of {} is not known: {} are in {}", quoted(said_in),
                     quantity == std::end(quantities) ? "its numbers" : quantity->name,
                     units_of(wanted));
}

Real unit_factor(const ColumnUnit& unit, std::string_view wanted, Faults& faults) {
  const auto factor = unit_factor(unit.text, wanted);
  if (!factor) faults.add(unit.line, unit.column, unknown_unit(unit.said_in, wanted));
  return factor.value_or(1);
}

bool are_units(const std::vector<Field>& fields) {
  const auto is_empty = [](const Field& f) { return f.text.empty(); };
  return !std::all_of(fields.begin(), fields.end(), is_empty) &&
         std::all_of(fields.begin(), fields.end(),
                     [&](const Field& f) { return is_empty(f) || unit_alone(f.text).has_value(); });
}

std::optional<std::size_t> axis_called(std::string_view bare, NameKind kind) {
  for (std::size_t d = 0; d < 3; ++d) {
    const auto& words = axis_words[d];
    if (kind == NameKind::axis     ? bare == axis_names[d]
        : kind == NameKind::letter ? bare == axis_letters[d]
                                   : std::find(words.begin(), words.end(), bare) != words.end())
      return d;
  }
  return {};
}

bool is_geographic(std::string_view bare) {
  constexpr std::string_view names[] = {
      "lat",      "latitude",    "latitud",    "lon",    "long",  "lng",         "longitude",
      "longitud", "breitengrad", "langengrad", "breite", "lange", "laengengrad", "laenge"};
  return std::find(std::begin(names), std::end(names), bare) != std::end(names);
}

std::optional<Real> grouped_number(std::string_view text, bool sure) {
  const std::size_t sign = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const Groups groups = groups_of(text, sign);
  const auto rest = text.substr(std::min(groups.end, text.size()));
  const bool has_point = !rest.empty() && rest.front() == '.';
  if (groups.count == 0 || (!rest.empty() && !has_point)) return {};
  if (sure && groups.mark == ',' && groups.count < 2 && !has_point) return {};
  std::string plain(text);
  plain.erase(std::remove(plain.begin(), plain.end(), groups.mark), plain.end());
  return parse_number(plain);
}

}  // namespace rockfold
