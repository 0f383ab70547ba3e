#include "src/report/summaries/table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace rockfold {

namespace {

std::string padded(const std::string& text, std::size_t width, bool left) {
  const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
  return left ? text + blanks : blanks + text;
}

std::string table_line(const std::vector<Column>& columns, const std::vector<std::size_t>& width,
                       const std::vector<std::string>& entries) {
  std::string line;
  for (std::size_t c = 0; c < columns.size(); ++c)
    line += "  " + padded(entries[c], width[c], columns[c].left);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

std::string table_text(const std::vector<Column>& columns,
                       const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::string> heads, units;
  std::vector<std::size_t> width;
  for (const auto& column : columns) {
    heads.push_back(column.head);
    units.push_back(column.unit);
    width.push_back(std::max(column.head.size(), column.unit.size()));
  }
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());

  std::string text = table_line(columns, width, heads);
  if (std::any_of(units.begin(), units.end(), [](const auto& unit) { return !unit.empty(); }))
    text += table_line(columns, width, units);
  for (const auto& row : rows) text += table_line(columns, width, row);
  return text;
}

std::string fixed_text(double x, int decimals) {
  const bool vanishes = x != 0 && std::abs(x) < 0.5 * std::pow(10, -decimals);
  return vanishes ? fmt::format("{:.2g}", x) : fmt::format("{:.{}f}", x, decimals);
}

}  // namespace rockfold
