#include "src/sweep/sweep_page.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "src/printed/format.hpp"
#include "src/printed/html.hpp"
#include "src/printed/print_style.hpp"
#include "src/sweep/sweep_events.hpp"

namespace rockfold::sweep {

namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t most_failed = 200;  // that are named
constexpr std::size_t most_rows = 2000;   // of the table; what is longer is read in the CSV

constexpr const char* head =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
    "'unsafe-inline'\">\n";

std::string with_unit(const Result& result) {
  const std::string unit = unit_at(result.path);
  return result.name + (unit.empty() ? "" : " (" + unit + ")");
}

void add_results(Html& html, const SweepTable& table) {
  Rows rows;
  for (const Result& result : table.spec.results) {
    const Spread s = spread_of(numbers_of(table, result.name));
    if (s.count == 0) continue;
    rows.push_back({with_unit(result), std::to_string(s.count)});
    for (const Real v : {s.mean, s.deviation, s.min, s.p5, s.p25, s.p50, s.p75, s.p95, s.max})
      rows.back().push_back(digits(v));
  }
  if (rows.empty()) return;
  html.heading(2, "Results");
  html.table("",
             {{"Result", "", true},
              {"Runs"},
              {"Mean"},
              {"Deviation"},
              {"Least"},
              {"5 %"},
              {"25 %"},
              {"50 %"},
              {"75 %"},
              {"95 %"},
              {"Greatest"}},
             rows);
}

std::string range_text(const Bounds& bounds) {
  return digits(100 * bounds.low, 3) + " … " + digits(100 * bounds.high, 3);
}

void add_events(Html& html, const SweepTable& table) {
  Rows rows;
  std::vector<std::string> notes;
  for (const Event& event : table.spec.events) {
    const Chance c = count_event(table, event).chance;
    rows.push_back({event.name, event.text, fmt::format("{} of {}", c.met, c.count),
                    c.count > 0 ? digits(100 * c.probability, 3) : "–", range_text(c.wilson),
                    range_text(c.exact)});
    if (const std::string note = null_note(table, event); !note.empty())
      notes.push_back(event.name + ": " + note + ".");
  }
  if (rows.empty()) return;
  html.heading(2, "Events");
  html.table("",
             {{"Event", "", true},
              {"When", "", true},
              {"Runs"},
              {"Probability", "%"},
              {"95 % bounds", "%, Wilson"},
              {"95 % bounds", "%, Clopper–Pearson"}},
             rows);
  for (const std::string& note : notes) html.paragraph(note, "note");
  if (const auto failed = not_done(table).size(); failed > 0)
    html.paragraph(
        fmt::format("Counted are the {} runs that are done; {} that failed or met a limit are in "
                    "no event.",
                    count_of(table, "done"), failed),
        "note");
}

const char* sign(Condition::Operator op) {
  using Operator = Condition::Operator;
  switch (op) {
    case Operator::more:
      return ">";
    case Operator::at_least:
      return "≥";
    case Operator::less:
      return "<";
    case Operator::at_most:
      return "≤";
    case Operator::equal:
      return "=";
    case Operator::other:
      return "≠";
  }
  return "";
}

ResultPlot plot_of(const SweepTable& table, const Result& result) {
  ResultPlot plot{result.name, unit_at(result.path), numbers_of(table, result.name)};
  for (const Event& event : table.spec.events)
    for (const auto& comparisons : event.when.any_of_all)
      for (const auto& comparison : comparisons)
        if (comparison.name == result.name)
          plot.marks.push_back({event.name, sign(comparison.op), comparison.number});
  return plot;
}

/// "of 132 of 200 runs; 68 have no number": whom a drawing is of.
std::string runs_text(const SweepTable& table, const Result& result) {
  const Index done = count_of(table, "done"), none = runs_without(table, result.name);
  if (none == 0) return fmt::format("of {} runs", done);
  return fmt::format("of the {} of {} runs that have a number", done - none, done);
}

void add_tornado(Html& html, const SweepTable& table, const Result& result, Real mean) {
  const std::string tornado =
      tornado_svg(result.name, unit_at(result.path), swings(table, result.name), mean);
  if (tornado.empty()) return;
  html.figure(
      tornado,
      "Means of the result over the runs with the lowest third (blue) and the highest third "
      "(orange) of each parameter's values, about the mean of all; r: rank correlation "
      "(Spearman).");
}

void add_plots(Html& html, const SweepTable& table) {
  for (const Result& result : table.spec.results) {
    const ResultPlot plot = plot_of(table, result);
    const std::string histogram = histogram_svg(plot);
    if (histogram.empty()) continue;
    const std::string whose = runs_text(table, result);
    html.heading(2, result.name);
    html.figure(histogram, "Histogram " + whose + ". Dashed: the mean; dotted: 5, 50 and 95 %" +
                               (plot.marks.empty() ? "." : "; red: what events compare it with."));
    html.figure(cumulated_svg(plot), "Cumulated curve (empirical distribution) " + whose +
                                         ", with its median, 5 and 95 %.");
    add_tornado(html, table, result, spread_of(plot.values).mean);
  }
  const auto& parameters = table.spec.parameters;
  const auto seeds = std::count_if(parameters.begin(), parameters.end(), is_seed);
  if (seeds > 0)
    html.paragraph(
        "Seeds of random numbers have no size that a result could rise or fall with: "
        "they stand in no diagram of what results depend on.",
        "note");
}

void add_failed(Html& html, const SweepTable& table) {
  Rows rows;
  const std::vector<RunRecord> failed = not_done(table);
  for (std::size_t i = 0; i < std::min(failed.size(), most_failed); ++i)
    rows.push_back({std::to_string(failed[i].run), failed[i].status, failed[i].error});
  if (rows.empty()) return;
  html.heading(2, "Runs that failed");
  html.table("", {{"Run"}, {"Status", "", true}, {"Error", "", true}}, rows);
  if (failed.size() > most_failed)
    html.paragraph(
        fmt::format("The first {} of {}; sweep.csv has all.", most_failed, failed.size()), "note");
}

/// A key that may go on in another line after each of its words: the table has many columns.
std::string breakable(const std::string& key) {
  std::string text;
  for (const char c : key) {
    text += c;
    if (c == '.' || c == '_') text += "\u200b";  // a blank of no width
  }
  return text;
}

void add_runs(Html& html, const SweepTable& table) {
  html.heading(2, "Runs");
  std::vector<HtmlColumn> columns{{"Run"}, {"Status", "", true}, {"Time", "s"}};
  std::vector<std::vector<Real>> results;
  std::vector<std::vector<int>> events;
  for (const Parameter& p : table.spec.parameters) columns.push_back({breakable(p.key)});
  for (const Result& r : table.spec.results) {
    columns.push_back({r.name});
    results.push_back(numbers_of(table, r.name));
  }
  for (const Event& e : table.spec.events) {
    columns.push_back({e.name});
    events.push_back(happened(table, e));
  }
  Rows rows;
  for (std::size_t i = 0; i < std::min(table.rows.size(), most_rows); ++i) {
    const RunRecord& run = table.rows[i];
    auto& row = rows.emplace_back();
    row = {std::to_string(run.run), run.status, fmt::format("{:.2f}", run.seconds)};
    for (const std::string& value : table.values[run.run - 1]) row.push_back(value);
    for (const auto& column : results) row.push_back(digits(column[i]));
    for (const auto& column : events)
      row.emplace_back(column[i] < 0 ? "–" : column[i] != 0 ? "yes" : "no");
  }
  html.table("", columns, rows);
  if (table.rows.size() > most_rows)
    html.paragraph(
        fmt::format("The first {} of {} runs; sweep.csv has all.", most_rows, table.rows.size()),
        "note");
}

}  // namespace

std::string page_path(const std::string& folder) {
  return (std::filesystem::path(folder) / "sweep.html").string();
}

std::vector<Swing> swings(const SweepTable& table, const std::string& result) {
  const std::vector<Real> value = numbers_of(table, result);
  std::vector<Swing> all;
  for (const Parameter& p : table.spec.parameters) {
    if (is_seed(p)) continue;
    const std::vector<Real> given = numbers_of(table, p.key);
    std::vector<Real> sorted;
    for (std::size_t i = 0; i < given.size(); ++i)
      if (std::isfinite(given[i]) && std::isfinite(value[i])) sorted.push_back(given[i]);
    std::sort(sorted.begin(), sorted.end());
    if (sorted.empty() || sorted.front() == sorted.back()) continue;
    const std::size_t third = (sorted.size() - 1) / 3;
    const Real low_end = sorted[third], high_end = sorted[sorted.size() - 1 - third];
    Real low = 0, high = 0, lows = 0, highs = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (!std::isfinite(given[i]) || !std::isfinite(value[i])) continue;
      if (given[i] <= low_end) low += value[i], ++lows;
      if (given[i] >= high_end) high += value[i], ++highs;
    }
    all.push_back({p.key, low / lows, high / highs, rank_correlation(given, value)});
  }
  std::stable_sort(all.begin(), all.end(), [](const Swing& a, const Swing& b) {
    return std::abs(a.high - a.low) > std::abs(b.high - b.low);
  });
  return all;
}

void write_page(const SweepTable& table, const std::string& folder) {
  Html html;
  html.heading(1, "Sweep " + std::filesystem::path(table.spec.path).filename().string());
  constexpr const char* samplings[] = {"all combinations", "Latin hypercube", "Monte Carlo"};
  html.facts(
      {{"model", table.spec.model},
       {"command", table.spec.command},
       {"sampling", fmt::format("{}, seed {}", samplings[static_cast<int>(table.spec.sampling)],
                                table.spec.seed)},
       {"runs",
        fmt::format("{} of {} done, {} failed, {} beyond a limit", count_of(table, "done"),
                    table.values.size(), count_of(table, "failed"), count_of(table, "limit"))}});
  add_results(html, table);
  add_events(html, table);
  add_plots(html, table);
  add_failed(html, table);
  add_runs(html, table);
  write_text(page_path(folder), std::string(head) + "<title>Sweep</title>\n<style>" + print_style +
                                    "</style>\n</head>\n<body>\n" + html.text() +
                                    "</body>\n</html>\n");
}

}  // namespace rockfold::sweep
