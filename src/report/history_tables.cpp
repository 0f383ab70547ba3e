#include "src/report/history_tables.hpp"

#include <algorithm>
#include <span>

#include "src/report/csv_row.hpp"
#include "src/report/names.hpp"

namespace rockfold {

namespace {

using Column = History::Column;

constexpr const char* vector_parts[] = {" x", " y", " z"};
constexpr const char* stress_parts[] = {" xx", " yy", " zz", " xy", " yz", " zx"};

/// "displacement x m,displacement y m,displacement z m"; underscores are for programs.
void add_heads(std::string& head, const Column& column) {
  std::string name = column.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  for (int part = 0; part < column.width; ++part) {
    const char* suffix = column.width == 1   ? ""
                         : column.width == 3 ? vector_parts[part]
                                             : stress_parts[part];
    head += "," + name + suffix + (column.unit.empty() ? "" : " " + column.unit);
  }
}

void add_values(CsvRow& row, const Column& column, std::size_t time) {
  const auto width = static_cast<std::size_t>(column.width);
  for (const Real value : std::span(column.values).subspan(time * width, width))
    if (column.name == "state")
      row << contact_name(static_cast<Contact>(value));
    else
      row << value;
}

/// One of each name, in the order in which monitors have them.
std::vector<const Column*> all_columns(const std::vector<History>& monitors) {
  std::vector<const Column*> all;
  for (const History& monitor : monitors)
    for (const Column& column : monitor.columns)
      if (std::none_of(all.begin(), all.end(),
                       [&](const Column* c) { return c->name == column.name; }))
        all.push_back(&column);
  return all;
}

const Column* find(const History& history, const std::string& name) {
  const auto found = std::find_if(history.columns.begin(), history.columns.end(),
                                  [&](const Column& c) { return c.name == name; });
  return found == history.columns.end() ? nullptr : &*found;
}

}  // namespace

std::string monitors_table(const std::vector<History>& monitors) {
  const auto columns = all_columns(monitors);
  std::string text = "monitor,joint,time s";
  for (const Column* column : columns) add_heads(text, *column);
  text += "\n";
  for (const History& monitor : monitors)
    for (std::size_t t = 0; t < monitor.time.size(); ++t) {
      CsvRow row;
      row << monitor.name;
      if (monitor.joint.empty())
        row.empty(1);
      else
        row << monitor.joint;
      row << monitor.time[t];
      for (const Column* column : columns)
        if (const Column* own = find(monitor, column->name))
          add_values(row, *own, t);
        else
          row.empty(column->width);
      text += row.line();
    }
  return text;
}

std::string energy_table(const History& energy, const History& contacts) {
  std::string text = "time s";
  for (const History* history : {&energy, &contacts})
    for (const Column& column : history->columns) add_heads(text, column);
  text += "\n";
  for (std::size_t t = 0; t < energy.time.size(); ++t) {
    CsvRow row;
    row << energy.time[t];
    for (const History* history : {&energy, &contacts})
      for (const Column& column : history->columns) add_values(row, column, t);
    text += row.line();
  }
  return text;
}

}  // namespace rockfold
