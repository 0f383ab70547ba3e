#include "host/files/read_record.hpp"

#include <array>

#include <fmt/format.h>

#include "host/files/text.hpp"
#include "src/model/text/numbers/range.hpp"

namespace rockfold {

namespace {

constexpr std::array<const char*, 4> columns{"t", "ax", "ay", "az"};

bool is_heading(std::string_view line) {
  Words words(line, ",;");
  for (const char* name : columns)
    if (lower_case(words.next()) != name) return false;
  return words.next().empty();
}

/// Adds the row of a line, or what is wrong with it.
void read_row(std::string_view line, int number, TimeTable& table, Faults& faults) {
  Words words(line, ",;");
  std::array<Real, 4> row{};
  for (std::size_t k = 0; k < row.size(); ++k) {
    const auto word = words.next();
    const Range range = any_number(k == 0 ? "s" : "m/s2");
    const auto value = parse_number(word);
    if (!value || !range.holds(*value)) {
      faults.add(number, words.column(),
                 word.empty() ? fmt::format("has {} numbers, must have 4: t, ax, ay, az", k)
                 : value ? fmt::format("{} {}, is {:g}", columns[k], range.refusal(*value), *value)
                         : fmt::format("{} {}, is {}", columns[k], range.text(), quoted(word)));
      return;
    }
    row[k] = *value;
  }
  if (!words.next().empty()) {
    faults.add(number, words.column(), "has more than 4 numbers: t, ax, ay, az");
    return;
  }
  if (!table.empty() && !(row[0] > table.time.back())) {
    faults.add(
        number, 1,
        fmt::format("time {:g} s follows {:g} s, times must ascend", row[0], table.time.back()));
    return;
  }
  table.time.push_back(row[0]);
  table.value.push_back({row[1], row[2], row[3]});
}

}  // namespace

TimeTable read_record(std::string_view text, const Place& place) {
  Faults faults(place);
  TimeTable table;
  bool first = true;
  for (Lines lines(text); lines.next();) {
    const auto line = trimmed(lines.line());
    if (line.empty() || line.front() == '#') continue;
    if (!first || !is_heading(line)) read_row(lines.line(), lines.number(), table, faults);
    first = false;
  }
  if (table.empty() && faults.empty()) faults.add(0, 0, "holds no rows t, ax, ay, az");
  faults.throw_if_any();
  return table;
}

}  // namespace rockfold
