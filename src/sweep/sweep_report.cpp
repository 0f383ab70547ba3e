#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"
#include "src/sweep/sweep_table.hpp"

namespace rockfold::sweep {

namespace {

constexpr std::size_t most_named = 10;

Json number(Real value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Chance chance_in(const SweepTable& table, const Event& event) {
  const std::vector<int> all = happened(table, event);
  const auto met = static_cast<Index>(std::count(all.begin(), all.end(), 1));
  return chance_of(met, met + static_cast<Index>(std::count(all.begin(), all.end(), 0)));
}

std::string share(Real x) {
  return fmt::format("{:.3g} %", 100 * x);
}

std::vector<RunRecord> not_done(const SweepTable& table) {
  std::vector<RunRecord> rows = table.rows;
  std::erase_if(rows, [](const RunRecord& row) { return row.status == "done"; });
  return rows;
}

}  // namespace

Json sweep_document(const SweepTable& table, const std::string& folder) {
  Json document = head_json({"sweep", "", table.spec.seed});
  document["folder"] = folder;
  document["totals"] = {{"runs", table.values.size()},
                        {"done", count_of(table, "done")},
                        {"failed", count_of(table, "failed")},
                        {"limit", count_of(table, "limit")}};
  auto& results = document["results"] = Json::array();
  for (const Result& result : table.spec.results) {
    const std::vector<Real> values = numbers_of(table, result.name);
    const Spread s = spread_of(values);
    Json entry{{"name", result.name}, {"count", s.count}};
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
      ranks[p.key] = number(rank_correlation(numbers_of(table, p.key), values));
    results.push_back(std::move(entry));
  }
  auto& events = document["events"] = Json::array();
  for (const Event& event : table.spec.events) {
    const Chance c = chance_in(table, event);
    events.push_back({{"name", event.name},
                      {"when", event.text},
                      {"count", c.count},
                      {"met", c.met},
                      {"probability", c.count > 0 ? Json(c.probability) : Json()},
                      {"low", c.low},
                      {"high", c.high}});
  }
  auto& failed = document["failed"] = Json::array();
  for (const RunRecord& row : not_done(table))
    failed.push_back({{"run", row.run}, {"status", row.status}, {"error", row.error}});
  return document;
}

std::string sweep_summary(const SweepTable& table, const std::string& folder) {
  const Index done = count_of(table, "done");
  std::string text = fact(
      "runs", fmt::format("{} of {} done, {} failed, {} beyond a limit", done, table.values.size(),
                          count_of(table, "failed"), count_of(table, "limit")));
  std::vector<std::vector<std::string>> rows;
  for (const Result& result : table.spec.results) {
    const Spread s = spread_of(numbers_of(table, result.name));
    if (s.count == 0) continue;
    rows.push_back({result.name, fmt::format("{}", s.count)});
    for (const Real value : {s.mean, s.deviation, s.p5, s.p50, s.p95})
      rows.back().push_back(fmt::format("{:.4g}", value));
  }
  if (!rows.empty())
    text += "\n" + table_text({{"result", "", true},
                               {"runs", ""},
                               {"mean", ""},
                               {"deviation", ""},
                               {"5 %", ""},
                               {"50 %", ""},
                               {"95 %", ""}},
                              rows);
  rows.clear();
  for (const Event& event : table.spec.events) {
    const Chance c = chance_in(table, event);
    rows.push_back({event.name, event.text, fmt::format("{} of {}", c.met, c.count),
                    c.count > 0 ? share(c.probability) : "-",
                    share(c.low) + " … " + share(c.high)});
  }
  if (!rows.empty())
    text += "\n" + table_text({{"event", "", true},
                               {"when", "", true},
                               {"runs", ""},
                               {"probability", ""},
                               {"95 % bounds", ""}},
                              rows);
  rows.clear();
  for (const Result& result : table.spec.results)
    for (const Parameter& p : table.spec.parameters) {
      const Real r = rank_correlation(numbers_of(table, p.key), numbers_of(table, result.name));
      if (std::isfinite(r)) rows.push_back({result.name, p.key, fmt::format("{:+.2f}", r)});
    }
  if (!rows.empty())
    text +=
        "\n" +
        table_text({{"result", "", true}, {"parameter", "", true}, {"rank correlation", ""}}, rows);
  const std::vector<RunRecord> failed = not_done(table);
  if (!failed.empty()) text += "\n";
  for (std::size_t i = 0; i < std::min(failed.size(), most_named); ++i)
    text += fact(fmt::format("run {}", failed[i].run), failed[i].status + ": " + failed[i].error);
  if (failed.size() > most_named)
    text += fact("", fmt::format("and {} more: see the table", failed.size() - most_named));
  return text + "\n" + fact("table", folder + "/sweep.csv, sweep.h5");
}

}  // namespace rockfold::sweep
