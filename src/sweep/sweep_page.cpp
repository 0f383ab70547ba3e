#include "src/sweep/sweep_page.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "src/printed/format.hpp"
#include "src/printed/html.hpp"
#include "src/printed/plot.hpp"
#include "src/printed/print_style.hpp"
#include "src/report/drawings/svg.hpp"

namespace rockfold::sweep {

namespace {

using Rows = std::vector<std::vector<std::string>>;

// px
constexpr Real width = 680, left = 62, right = 18, top = 34;
constexpr Real bar_height = 22;
constexpr const char* low_colour = "#4477aa";
constexpr const char* high_colour = "#ee7733";
constexpr std::size_t most_bars = 20;    // of a tornado plot
constexpr std::size_t most_rows = 2000;  // of the table; what is longer is read in the CSV

constexpr const char* head =
    "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
    "'unsafe-inline'\">\n";

std::vector<Real> numbers_alone(std::vector<Real> values) {
  std::erase_if(values, [](Real v) { return !std::isfinite(v); });
  return values;
}

/// By Freedman & Diaconis (1981): 2 · interquartile range / ∛n wide, 4 to 40 of them.
std::size_t class_count(const Spread& spread) {
  const Real range = spread.max - spread.min, quartiles = spread.p75 - spread.p25;
  if (!(range > 0)) return 1;
  const Real size = 2 * quartiles / std::cbrt(static_cast<Real>(spread.count));
  return static_cast<std::size_t>(std::clamp(size > 0 ? std::ceil(range / size) : 4.0, 4.0, 40.0));
}

void add_results(Html& html, const SweepTable& table) {
  Rows rows;
  for (const Result& result : table.spec.results) {
    const Spread s = spread_of(numbers_of(table, result.name));
    if (s.count == 0) continue;
    rows.push_back({result.name, std::to_string(s.count)});
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

void add_events(Html& html, const SweepTable& table) {
  Rows rows;
  for (const Event& event : table.spec.events) {
    const std::vector<int> all = happened(table, event);
    const auto met = static_cast<Index>(std::count(all.begin(), all.end(), 1));
    const Chance c =
        chance_of(met, met + static_cast<Index>(std::count(all.begin(), all.end(), 0)));
    rows.push_back({event.name, event.text, fmt::format("{} of {}", c.met, c.count),
                    c.count > 0 ? digits(100 * c.probability, 3) : "–", digits(100 * c.low, 3),
                    digits(100 * c.high, 3)});
  }
  if (rows.empty()) return;
  html.heading(2, "Events");
  html.table("",
             {{"Event", "", true},
              {"When", "", true},
              {"Runs"},
              {"Probability", "%"},
              {"From", "%, 95 % bounds"},
              {"To", "%, 95 % bounds"}},
             rows);
}

void add_plots(Html& html, const SweepTable& table) {
  for (const Result& result : table.spec.results) {
    const std::vector<Real> values = numbers_of(table, result.name);
    const std::string histogram = histogram_svg(result.name, values);
    if (histogram.empty()) continue;
    html.heading(2, result.name);
    html.figure(histogram, "Runs by result; the line is the mean.");
    const std::vector<Swing> all = swings(table, result.name);
    const std::string tornado = tornado_svg(result.name, all, spread_of(values).mean);
    if (!tornado.empty())
      html.figure(
          tornado,
          "Means of the result over the runs with the lowest third (blue) and the highest third "
          "(orange) of each parameter's values, about the mean of all; r: rank correlation "
          "(Spearman).");
  }
}

void add_failed(Html& html, const SweepTable& table) {
  Rows rows;
  for (const RunRecord& row : table.rows)
    if (row.status != "done") rows.push_back({std::to_string(row.run), row.status, row.error});
  if (rows.empty()) return;
  html.heading(2, "Runs that failed");
  html.table("", {{"Run"}, {"Status", "", true}, {"Error", "", true}}, rows);
}

void add_runs(Html& html, const SweepTable& table) {
  html.heading(2, "Runs");
  std::vector<HtmlColumn> columns{{"Run"}, {"Status", "", true}, {"Time", "s"}};
  std::vector<std::vector<Real>> results;
  std::vector<std::vector<int>> events;
  for (const Parameter& p : table.spec.parameters) columns.push_back({p.key});
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

std::string histogram_svg(const std::string& name, const std::vector<Real>& values) {
  const Spread spread = spread_of(values);
  if (spread.count == 0) return "";
  const std::size_t classes = class_count(spread);
  const Real half = spread.max > spread.min ? 0 : std::max(std::abs(spread.min), 1.0) / 2;
  const Real low = spread.min - half, high = spread.max + half;
  std::vector<Index> count(classes, 0);
  for (const Real v : numbers_alone(values)) {
    const auto at = static_cast<std::size_t>((v - low) / (high - low) * static_cast<Real>(classes));
    ++count[std::min(at, classes - 1)];
  }
  const Real most = static_cast<Real>(*std::max_element(count.begin(), count.end()));
  constexpr Real height = 230, bottom = 40;
  const auto x = [&](Real v) { return left + (v - low) / (high - low) * (width - left - right); };
  const auto y = [&](Real n) { return top + (1 - n / most) * (height - top - bottom); };
  Svg svg(width, height);
  svg.text({left, 18}, name, {.size = 13, .bold = true});
  const Pen grid{.stroke = "#dddddd", .width = 0.8}, axis{.stroke = "#333333", .width = 1};
  for (const Real n : axis_ticks(0, most, 5)) {
    if (n != std::floor(n)) continue;  // runs are whole
    svg.line({left, y(n)}, {width - right, y(n)}, grid);
    svg.text({left - 6, y(n) + 4}, digits(n), {.size = 11, .anchor = "end"});
  }
  const Real step = (high - low) / static_cast<Real>(classes);
  for (std::size_t c = 0; c < classes; ++c) {
    const Real a = x(low + static_cast<Real>(c) * step),
               b = x(low + static_cast<Real>(c + 1) * step), up = y(static_cast<Real>(count[c]));
    if (count[c] > 0)
      svg.polygon({{{a, y(0)}, {b, y(0)}, {b, up}, {a, up}}},
                  {.stroke = "#ffffff", .width = 0.8, .fill = low_colour});
  }
  svg.line({left, y(0)}, {width - right, y(0)}, axis);
  for (const Real v : axis_ticks(low, high, 8)) {
    svg.line({x(v), y(0)}, {x(v), y(0) + 4}, axis);
    svg.text({x(v), y(0) + 17}, digits(v, 4), {.size = 11, .anchor = "middle"});
  }
  svg.line({x(spread.mean), top}, {x(spread.mean), y(0)},
           {.stroke = "#222222", .width = 1.4, .dash = "5 3"});
  return svg.document(name);
}

std::vector<Swing> swings(const SweepTable& table, const std::string& result) {
  const std::vector<Real> value = numbers_of(table, result);
  std::vector<Swing> all;
  for (const Parameter& p : table.spec.parameters) {
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

std::string tornado_svg(const std::string& name, const std::vector<Swing>& swings, Real mean) {
  if (swings.empty()) return "";
  const std::size_t bars = std::min(swings.size(), most_bars);
  Real low = mean, high = mean, names = 0;
  for (std::size_t i = 0; i < bars; ++i) {
    low = std::min({low, swings[i].low, swings[i].high});
    high = std::max({high, swings[i].low, swings[i].high});
    names = std::max(names, text_width(swings[i].parameter, 11.5));
  }
  if (!(high > low)) return "";
  const Real begin = std::min(names + 16, width / 2), end = width - 70;
  const Real height = top + static_cast<Real>(bars) * bar_height + 34;
  const auto x = [&](Real v) { return begin + (v - low) / (high - low) * (end - begin); };
  Svg svg(width, height);
  svg.text({begin, 18}, name, {.size = 13, .bold = true});
  const Real bottom = height - 34;
  const Pen axis{.stroke = "#333333", .width = 1};
  for (std::size_t i = 0; i < bars; ++i) {
    const Swing& s = swings[i];
    const Real up = top + static_cast<Real>(i) * bar_height + 3, down = up + bar_height - 6;
    const auto bar = [&](Real to, const char* colour) {
      svg.polygon({{{x(mean), up}, {x(to), up}, {x(to), down}, {x(mean), down}}},
                  {.stroke = "none", .fill = colour});
    };
    bar(s.low, low_colour);
    bar(s.high, high_colour);
    svg.text({begin - 8, down - 3}, s.parameter, {.size = 11.5, .anchor = "end"});
    if (std::isfinite(s.rank_correlation))
      svg.text({width - 8, down - 3}, fmt::format("r {:+.2f}", s.rank_correlation),
               {.size = 11, .anchor = "end"});
  }
  svg.line({x(mean), top - 4}, {x(mean), bottom}, axis);
  svg.line({begin, bottom}, {end, bottom}, axis);
  for (const Real v : axis_ticks(low, high, 6)) {
    svg.line({x(v), bottom}, {x(v), bottom + 4}, axis);
    svg.text({x(v), bottom + 17}, digits(v, 4), {.size = 11, .anchor = "middle"});
  }
  return svg.document(name);
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
