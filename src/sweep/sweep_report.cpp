#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"
#include "src/sweep/sweep_events.hpp"

namespace rockfold::sweep {

namespace {

constexpr std::size_t most_named = 10;

using Rows = std::vector<std::vector<std::string>>;

Json number(Real value) {
  return std::isfinite(value) ? Json(value) : Json();
}

std::string share(Real x) {
  return fmt::format("{:.3g} %", 100 * x);
}

std::string range_text(const Bounds& bounds) {
  return share(bounds.low) + " … " + share(bounds.high);
}

Json bounds_json(const Bounds& bounds) {
  return {{"low", bounds.low}, {"high", bounds.high}};
}

Json result_json(const SweepTable& table, const Result& result) {
  const std::vector<Real> values = numbers_of(table, result.name);
  const Spread s = spread_of(values);
  Json entry{
      {"name", result.name}, {"count", s.count}, {"null_runs", runs_without(table, result.name)}};
  if (s.count > 0)
    entry.update({{"mean", s.mean},
                  {"standard_deviation", s.deviation},
                  {"min", s.min},
                  {"p5", s.p5},
                  {"p25", s.p25},
                  {"p50", s.p50},
                  {"p75", s.p75},
                  {"p95", s.p95},
                  {"max", s.max}});
  auto& ranks = entry["rank_correlation"] = Json::object();
  for (const Parameter& p : table.spec.parameters)
    if (!is_seed(p)) ranks[p.key] = number(rank_correlation(numbers_of(table, p.key), values));
  return entry;
}

Json event_json(const SweepTable& table, const Event& event) {
  const EventCount count = count_event(table, event);
  const Chance& c = count.chance;
  return {{"name", event.name},
          {"when", event.text},
          {"count", c.count},
          {"met", c.met},
          {"probability", c.count > 0 ? Json(c.probability) : Json()},
          {"low", c.wilson.low},
          {"high", c.wilson.high},
          {"clopper_pearson", bounds_json(c.exact)},
          {"null", null_name(event.null)},
          {"null_runs", count.null_runs}};
}

std::string result_table(const SweepTable& table) {
  Rows rows;
  std::string notes;
  for (const Result& result : table.spec.results) {
    const Spread s = spread_of(numbers_of(table, result.name));
    if (s.count == 0) continue;
    rows.push_back({result.name, fmt::format("{}", s.count)});
    for (const Real value : {s.mean, s.deviation, s.p5, s.p50, s.p95})
      rows.back().push_back(fmt::format("{:.4g}", value));
    if (const Index none = runs_without(table, result.name); none > 0)
      notes += fact(result.name, fmt::format("{} of {} runs have no number: the others are told of",
                                             none, count_of(table, "done")));
  }
  if (rows.empty()) return "";
  return "\n" +
         table_text({{"result", "", true},
                     {"runs", ""},
                     {"mean", ""},
                     {"deviation", ""},
                     {"5 %", ""},
                     {"50 %", ""},
                     {"95 %", ""}},
                    rows) +
         notes;
}

std::string event_table(const SweepTable& table) {
  Rows rows;
  std::string notes;
  for (const Event& event : table.spec.events) {
    const Chance c = count_event(table, event).chance;
    rows.push_back({event.name, event.text, fmt::format("{} of {}", c.met, c.count),
                    c.count > 0 ? share(c.probability) : "-", range_text(c.wilson),
                    range_text(c.exact)});
    if (const std::string note = null_note(table, event); !note.empty())
      notes += fact(event.name, note);
  }
  if (rows.empty()) return "";
  return "\n" +
         table_text({{"event", "", true},
                     {"when", "", true},
                     {"runs", ""},
                     {"probability", ""},
                     {"95 % bounds", "Wilson"},
                     {"95 % bounds", "Clopper-Pearson"}},
                    rows) +
         notes;
}

std::string rank_table(const SweepTable& table) {
  Rows rows;
  for (const Result& result : table.spec.results)
    for (const Parameter& p : table.spec.parameters) {
      if (is_seed(p)) continue;
      const Real r = rank_correlation(numbers_of(table, p.key), numbers_of(table, result.name));
      if (std::isfinite(r)) rows.push_back({result.name, p.key, fmt::format("{:+.2f}", r)});
    }
  if (rows.empty()) return "";
  return "\n" +
         table_text({{"result", "", true}, {"parameter", "", true}, {"rank correlation", ""}},
                    rows);
}

/// The first runs that are not done, by number, and how many more there are.
std::string failed_facts(const SweepTable& table) {
  const std::vector<RunRecord> failed = not_done(table);
  if (failed.empty()) return "";
  std::string text = "\n";
  for (std::size_t i = 0; i < std::min(failed.size(), most_named); ++i)
    text += fact(fmt::format("run {}", failed[i].run), failed[i].status + ": " + failed[i].error);
  if (failed.size() > most_named)
    text += fact("", fmt::format("and {} more: see the table", failed.size() - most_named));
  if (!table.spec.events.empty()) text += fact("", "these runs are counted in no event");
  return text;
}

}  // namespace

std::vector<RunRecord> not_done(const SweepTable& table) {
  std::vector<RunRecord> rows = table.rows;
  std::erase_if(rows, [](const RunRecord& row) { return row.status == "done"; });
  return rows;
}

Json sweep_document(const SweepTable& table, const std::string& folder) {
  Json document = head_json({"sweep", "", table.spec.seed});
  document["folder"] = folder;
  document["totals"] = {{"runs", table.values.size()},
                        {"done", count_of(table, "done")},
                        {"failed", count_of(table, "failed")},
                        {"limit", count_of(table, "limit")}};
  auto& results = document["results"] = Json::array();
  for (const Result& result : table.spec.results) results.push_back(result_json(table, result));
  auto& events = document["events"] = Json::array();
  for (const Event& event : table.spec.events) events.push_back(event_json(table, event));
  auto& failed = document["failed"] = Json::array();
  for (const RunRecord& row : not_done(table))
    failed.push_back({{"run", row.run}, {"status", row.status}, {"error", row.error}});
  return document;
}

std::string sweep_summary(const SweepTable& table, const std::string& folder) {
  const std::string runs =
      fmt::format("{} of {} done, {} failed, {} beyond a limit", count_of(table, "done"),
                  table.values.size(), count_of(table, "failed"), count_of(table, "limit"));
  return fact("runs", runs) + result_table(table) + event_table(table) + rank_table(table) +
         failed_facts(table) + "\n" + fact("table", folder + "/sweep.csv, sweep.h5");
}

}  // namespace rockfold::sweep
