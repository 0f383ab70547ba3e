#include "src/sweep/sweep_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/io/hdf5/hdf5_file.hpp"
#include "src/io/partial_file.hpp"
#include "src/sweep/sweep_events.hpp"

namespace rockfold::sweep {

namespace {

constexpr Real nothing = std::numeric_limits<Real>::quiet_NaN();

/// RFC 4180.
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/// As a cell: words without quotes, nothing for null.
std::string result_cell(const std::string& json) {
  const Json value = Json::parse(json, nullptr, false);
  if (value.is_null() || value.is_discarded()) return "";
  return value.is_string() ? value.get<std::string>() : json;
}

Real number_in(const std::string& text) {
  const Json value = Json::parse(text, nullptr, false);
  if (value.is_number()) return value.get<Real>();
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  return nothing;
}

template <typename List>
std::vector<std::string> names_in(const List& list) {
  std::vector<std::string> names;
  for (const auto& entry : list) names.push_back(entry.name);
  return names;
}

void write_hdf5(const SweepTable& table, const std::string& path) {
  PartialFile target(path);
  hdf5::File file(target.aside(), hdf5::File::Mode::create, path);
  std::vector<Index> run;
  std::vector<std::string> status, error, keys;
  std::vector<Real> seconds;
  for (const RunRecord& row : table.rows) {
    run.push_back(row.run);
    status.push_back(row.status);
    error.push_back(row.error);
    seconds.push_back(row.seconds);
  }
  file.write("/run", run);
  file.write_names("/status", status);
  file.write("/seconds", seconds);
  file.write_names("/error", error);
  for (const Parameter& p : table.spec.parameters) keys.push_back(p.key);
  const auto write = [&](const std::string& group, const std::vector<std::string>& names) {
    file.write_names("/" + group + "/name", names);
    std::vector<Real> all;  // [columns][rows]
    for (const std::string& name : names) {
      const std::vector<Real> column = numbers_of(table, name);
      all.insert(all.end(), column.begin(), column.end());
    }
    if (!all.empty()) file.write_wide("/" + group + "/value", all, std::ssize(table.rows));
  };
  write("parameters", keys);
  write("results", names_in(table.spec.results));
  file.write_names("/events/name", names_in(table.spec.events));
  std::vector<Index> events;
  for (const Event& event : table.spec.events)
    for (const int h : happened(table, event)) events.push_back(h);
  if (!events.empty()) file.write_wide("/events/value", events, std::ssize(table.rows));
  file.close();
  target.take_name();
}

}  // namespace

void write_text(const std::string& path, const std::string& text) {
  PartialFile target(path);
  std::FILE* file = std::fopen(target.aside().c_str(), "wb");
  const bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  if ((file && std::fclose(file) != 0) || !written)
    throw Error(ErrorKind::io, "cannot be written", Place{path, 0, 0, ""});
  target.take_name();
}

Index count_of(const SweepTable& table, const std::string& status) {
  return static_cast<Index>(std::count_if(table.rows.begin(), table.rows.end(),
                                          [&](const auto& row) { return row.status == status; }));
}

std::vector<Real> numbers_of(const SweepTable& table, const std::string& column) {
  std::vector<Real> numbers(table.rows.size(), nothing);
  const auto& parameters = table.spec.parameters;
  const auto& results = table.spec.results;
  for (std::size_t p = 0; p < parameters.size(); ++p)
    if (parameters[p].key == column)
      for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = number_in(table.values[table.rows[i].run - 1][p]);
  for (std::size_t r = 0; r < results.size(); ++r)
    if (results[r].name == column)
      for (std::size_t i = 0; i < numbers.size(); ++i)
        if (r < table.rows[i].results.size()) numbers[i] = number_in(table.rows[i].results[r]);
  return numbers;
}

bool is_answered(const SweepTable& table, const std::string& column) {
  const std::vector<Real> numbers = numbers_of(table, column);
  const auto& results = table.spec.results;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const RunRecord& row = table.rows[i];
    if (row.status != "done") continue;
    if (!std::isnan(numbers[i])) return true;
    for (std::size_t r = 0; r < std::min(results.size(), row.results.size()); ++r)
      if (results[r].name == column && row.results[r] == "null") return true;
  }
  return false;
}

Index runs_without(const SweepTable& table, const std::string& column) {
  const std::vector<Real> numbers = numbers_of(table, column);
  Index count = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    count += table.rows[i].status == "done" && std::isnan(numbers[i]);
  return count;
}

std::string csv_text(const SweepTable& table) {
  const SweepSpec& spec = table.spec;
  std::string text = "run,status,seconds,error";
  for (const auto& p : spec.parameters) text += "," + csv_cell(p.key);
  for (const auto& r : spec.results) text += "," + csv_cell(r.name);
  for (const auto& e : spec.events) text += "," + csv_cell(e.name);
  text += "\n";
  std::vector<std::vector<int>> events;
  for (const Event& event : spec.events) events.push_back(happened(table, event));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const RunRecord& row = table.rows[i];
    text += fmt::format("{},{},{:.3f},{}", row.run, row.status, row.seconds, csv_cell(row.error));
    for (const std::string& value : table.values[row.run - 1]) text += "," + csv_cell(value);
    for (std::size_t r = 0; r < spec.results.size(); ++r)
      text += "," + (r < row.results.size() ? csv_cell(result_cell(row.results[r])) : "");
    for (const auto& event : events)
      text += event[i] < 0 ? "," : event[i] != 0 ? ",true" : ",false";
    text += "\n";
  }
  return text;
}

void write_tables(const SweepTable& table, const std::string& folder) {
  const std::filesystem::path at(folder);
  write_text((at / "sweep.csv").string(), csv_text(table));
  write_hdf5(table, (at / "sweep.h5").string());
}

}  // namespace rockfold::sweep
