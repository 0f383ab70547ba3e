// What a run came to, and its histories.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/printed/plot.hpp"
#include "src/printed/sections.hpp"
#include "src/report/documents/met_surfaces.hpp"
#include "src/report/documents/settled.hpp"

namespace rockfold {

namespace {

using Rows = std::vector<std::vector<std::string>>;
constexpr std::size_t most_curves = 8;  // in a plot: as many as there are colours
constexpr std::size_t most_rows = 40;   // of blocks beside their prediction

std::vector<Real> numbers(const Json& list) {
  std::vector<Real> values;
  for (const Json& v : list)
    values.push_back(v.is_number() ? v.get<Real>() : std::numeric_limits<Real>::quiet_NaN());
  return values;
}

std::vector<Real> lengths(const Json& vectors) {
  std::vector<Real> values;
  for (const Json& v : vectors)
    values.push_back(std::hypot(v.at(0).get<Real>(), v.at(1).get<Real>(), v.at(2).get<Real>()));
  return values;
}

/// Of each monitor that has it, one quantity; in plots of at most `most_curves`.
void add_monitor_plots(Html& html, const Json& monitors, const std::string& key,
                       const std::string& title, const std::string& unit) {
  Plot plot{title, unit, {}, {}};
  const auto draw = [&] {
    if (const std::string svg = plot_svg(plot); !svg.empty()) html.figure(svg, "");
    plot.curves.clear();
  };
  for (const Json& m : monitors) {
    if (!m.contains(key) || m.at(key).empty()) continue;
    plot.at = numbers(m.at("time"));
    plot.curves.push_back(
        {m.at("name"), m.at(key).at(0).is_array() ? lengths(m.at(key)) : numbers(m.at(key))});
    if (plot.curves.size() == most_curves) draw();
  }
  draw();
}

/// What never differs from zero beside the others only takes room.
void add_energy_plot(Html& html, const Json& history) {
  Plot plot{"Energy", "J", numbers(history.at("time")), {}};
  Real most = 0;
  const auto peak = [](const PlotCurve& curve) {
    Real largest = 0;
    for (const Real v : curve.values)
      if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    return largest;
  };
  for (const auto& [name, values] : history.items())
    if (name != "time") {
      plot.curves.push_back({name, numbers(values)});
      most = std::max(most, peak(plot.curves.back()));
    }
  std::erase_if(plot.curves, [&](const PlotCurve& curve) { return peak(curve) <= 1e-3 * most; });
  if (plot.curves.size() > most_curves) plot.curves.resize(most_curves);
  if (const std::string svg = plot_svg(plot); !svg.empty())
    html.figure(svg, "Parts that stay below a thousandth of the largest are left out.");
}

void add_contact_plot(Html& html, const Json& history) {
  Plot plot{"Contact points", "", numbers(history.at("time")), {}};
  for (const char* name : {"open", "stick", "slide"})
    plot.curves.push_back({name, numbers(history.at(name))});
  if (const std::string svg = plot_svg(plot); !svg.empty() && !history.at("open").empty())
    html.figure(svg, "");
}

void add_stages(Html& html, const Json& setup) {
  Rows rows;
  for (const Json& s : setup.at("analysis").at("stages"))
    rows.push_back(
        {s.at("name").get<std::string>().empty() ? "analysis" : s.at("name").get<std::string>(),
         s.at("type"), fmt::format("{}", s.at("steps").get<Index>()), digits(s.at("time_step")),
         digits(s.at("dynamic_ratio"))});
  html.table("",
             {{"step", "", true},
              {"type", "", true},
              {"time steps"},
              {"time step", "s"},
              {"dynamic ratio"}},
             rows);
}

std::string largest_text(const Json& largest) {
  if (!largest.is_object()) return "none";
  const Json& blocks = largest.at("blocks");
  return fmt::format("{}, {} between blocks {} and {}", quantity(largest.at("value"), "m"),
                     largest.at("joint").get<std::string>().empty()
                         ? "faces that met"
                         : largest.at("joint").get<std::string>(),
                     blocks.at(0).get<Index>(), blocks.at(1).get<Index>());
}

std::string largest_displacement_text(const Json& totals) {
  const auto block = totals.at("largest_displacement_block").get<Index>();
  if (block == 0) return "none: nothing moved";
  return fmt::format("{}, of block {}", quantity(totals.at("largest_displacement"), "m"), block);
}

void add_excavation(std::vector<std::pair<std::string, std::string>>& facts,
                    const Json& excavation) {
  for (const Json& s : excavation.at("settled")) facts.emplace_back("Excavation", settled_text(s));
  if (excavation.contains("settling"))
    facts.emplace_back("Excavation", settling_text(excavation.at("settling")));
}

void add_totals(Html& html, const Json& answer) {
  const Json& totals = answer.at("totals");
  std::vector<std::pair<std::string, std::string>> facts{
      {"Unknowns", digits(totals.at("dof"), 9)},
      {"Reached", fmt::format("{} s after {} steps", digits(totals.at("time")),
                              totals.at("steps").get<Index>())},
      {"Largest displacement", largest_displacement_text(totals)},
      {"Sum of reactions", vector_text(answer.at("reaction")) + " N"}};
  if (answer.contains("rest")) {
    const Json& rest = answer.at("rest");
    facts.emplace_back(
        "Blocks that moved",
        fmt::format("{} of {}, by more than a hundredth of their size; {}",
                    rest.at("moved_blocks").get<Index>(), totals.at("blocks").get<Index>(),
                    rest.at("at_rest").get<bool>()
                        ? "all at rest since t = " + quantity(rest.at("since"), "s")
                        : "the fastest moves at " + quantity(rest.at("speed"), "m/s")));
    facts.emplace_back("Largest slip", largest_text(rest.at("largest_slip")));
    facts.emplace_back("Largest opening", largest_text(rest.at("largest_opening")));
    if (answer.contains("excavation")) add_excavation(facts, answer.at("excavation"));
    const Json& c = answer.at("contacts");
    facts.emplace_back(
        "Contact points",
        fmt::format("{} open, {} stick, {} slide; deepest penetration {}",
                    c.at("open").get<Index>(), c.at("stick").get<Index>(),
                    c.at("slide").get<Index>(), quantity(c.at("max_penetration"), "m")));
    if (c.contains("met"))  // not in older results
      for (const Json& met : c.at("met")) facts.emplace_back("Faces that met", met_text(met));
  }
  html.facts(facts);
}

/// What monitors show at the end.
void add_monitor_table(Html& html, const Json& monitors) {
  Rows points, joints;
  for (const Json& m : monitors) {
    if (m.at("time").empty()) continue;
    const std::string name = m.at("name");
    if (m.contains("joint")) {
      joints.push_back({name, m.at("joint"), digits(m.at("normal_stress").back(), 4, 1e3),
                        digits(m.at("shear_stress").back(), 4, 1e3),
                        digits(m.at("opening").back(), 4, 1e-3),
                        digits(m.at("slip").back(), 4, 1e-3), m.at("state").back()});
      continue;
    }
    const Json& u = m.at("displacement").back();
    std::vector<std::string> row{name};
    for (const Json& part : u) row.push_back(digits(part, 4, 1e-3));
    row.push_back(digits(lengths(Json::array({u})).front() / 1e-3));
    for (const Json& s : m.at("principal_stress").back()) row.push_back(digits(s, 4, 1e3));
    points.push_back(row);
  }
  if (!points.empty())
    html.table("Monitors of points at the end",
               {{"monitor", "", true},
                {"east", "mm"},
                {"north", "mm"},
                {"up", "mm"},
                {"in all", "mm"},
                {"σ₁", "kPa"},
                {"σ₂", "kPa"},
                {"σ₃", "kPa"}},
               points);
  if (!joints.empty())
    html.table("Monitors of joints at the end",
               {{"monitor", "", true},
                {"joint", "", true},
                {"normal stress", "kPa"},
                {"shear stress", "kPa"},
                {"opening", "mm"},
                {"slip", "mm"},
                {"state", "", true}},
               joints);
}

void add_reduction(Html& html, const Json& reduction) {
  std::vector<Json> trials(reduction.at("trials").begin(), reduction.at("trials").end());
  std::sort(trials.begin(), trials.end(),
            [](const Json& a, const Json& b) { return a.at("factor") < b.at("factor"); });
  Rows rows;
  for (const Json& t : trials)
    rows.push_back({digits(t.at("factor")), t.at("stands").get<bool>() ? "stands" : "fails",
                    digits(t.at("time")), digits(t.at("speed"))});
  std::vector<Index> ids = reduction.at("blocks").get<std::vector<Index>>();
  const std::size_t failing = ids.size();
  ids.resize(std::min(failing, most_rows));
  const auto weaker = reduction.value("loses_strength", std::vector<std::string>{});
  html.heading(3, "Strength reduction");
  html.facts({{"Factor of safety", digits(reduction.at("factor"))},
              {"Joints as they slip",
               weaker.empty() ? "keep their strength"
                              : fmt::format("lose strength: {}", fmt::join(weaker, ", "))},
              {"Blocks that fail",
               fmt::format("{}{}{}", fmt::join(ids, ", "), failing > most_rows ? " …" : "",
                           failing == 0 ? "none" : "")},
              {"Motion shown", "with tan φ and cohesion of the joints divided by " +
                                   digits(reduction.at("shown"))}});
  html.table(
      "Analyses with reduced strength",
      {{"divided by"}, {"the mass", "", true}, {"decided at", "s"}, {"fastest block", "m/s"}},
      rows);
}

std::vector<std::string> confirmed_row(const Json& c) {
  const Json &predicted = c.at("predicted"), &seen = c.at("seen"), &reason = c.at("reason");
  const bool key = !predicted.is_null();
  const bool held = key && predicted.value("held", false);
  return {fmt::format("{}", c.at("block").get<Index>()),
          key ? fmt::format("{}", c.at("batch").get<Index>()) : "–",
          !key   ? "stays"
          : held ? "stays, held"
                 : mode_words(predicted),
          key ? trend_text(predicted.at("direction")) : "–",
          seen.at("mode") == "none" ? "stays" : seen.at("mode").get<std::string>(),
          digits(seen.at("moved")),
          digits(seen.at("off_direction"), 3),
          digits(seen.at("rotation"), 3),
          c.at("agree").get<bool>()
              ? (c.value("other_loads", false) ? "yes, under other loads" : "yes")
              : "no: " + reason.get<std::string>()};
}

/// What block theory says of key blocks, and what they did; then the blocks that moved without being key blocks.
void add_confirmed(Html& html, const Json& confirmed) {
  std::size_t keys = 0, moved = 0, agreed = 0;
  Rows rows;
  for (const Json& c : confirmed) {
    const bool key = !c.at("predicted").is_null();
    keys += key;
    moved += key && c.at("seen").at("mode") != "none";
    agreed += c.at("agree").get<bool>();
    if (rows.size() < most_rows) rows.push_back(confirmed_row(c));
  }
  html.heading(3, "Key blocks in the analysis");
  html.paragraph(fmt::format(
      "{} of {} key blocks moved by more than a hundredth of their size, {} as predicted. "
      "Blocks that moved without being key blocks: {}.",
      moved, keys, agreed, confirmed.size() - keys));
  if (rows.empty()) return;
  html.table(confirmed.size() > most_rows
                 ? fmt::format("The first {} of {}", most_rows, confirmed.size())
                 : "",
             {{"block"},
              {"batch"},
              {"predicted", "", true},
              {"predicted direction", "trend/plunge"},
              {"seen", "", true},
              {"moved", "m"},
              {"off the direction", "°"},
              {"turned", "°"},
              {"as predicted", "", true}},
             rows);
}

/// Blocks under a record of the ground, and Newmark's sliding block beside them.
void add_shaken(Html& html, const Json& shaken) {
  Rows rows;
  for (const Json& s : shaken) {
    if (rows.size() == most_rows) break;
    const bool slides = !s.at("newmark").is_null();
    rows.push_back(
        {fmt::format("{}", s.at("block").get<Index>()),
         s.at("planes").empty()
             ? "–"
             : fmt::format("{}", fmt::join(s.at("planes").get<std::vector<std::string>>(), ", ")),
         digits(s.at("moved")), slides ? digits(s.at("newmark")) : "–"});
  }
  if (rows.empty()) return;
  html.heading(3, "Blocks under the record");
  html.table(shaken.size() > most_rows
                 ? fmt::format("The {} of {} that move furthest", most_rows, shaken.size())
                 : "",
             {{"block"}, {"slides on", "", true}, {"moved", "m"}, {"Newmark's rigid block", "m"}},
             rows);
}

}  // namespace

void add_analysis(Html& html, const ReportSource& source) {
  if (!source.has_run()) return;
  const Json& answer = source.answer;
  html.heading(2, "Analysis", "analysis");
  if (answer.at("setup").contains("analysis")) add_stages(html, answer.at("setup"));
  add_totals(html, answer);
  const Json& monitors = answer.at("monitors");
  if (!monitors.empty()) {
    html.heading(3, "Monitors");
    add_monitor_table(html, monitors);
    add_monitor_plots(html, monitors, "displacement", "Displacement of points", "m");
    add_monitor_plots(html, monitors, "velocity", "Velocity of points", "m/s");
    add_monitor_plots(html, monitors, "slip", "Slip of joints", "m");
    add_monitor_plots(html, monitors, "opening", "Opening of joints", "m");
    add_monitor_plots(html, monitors, "normal_stress", "Normal stress of joints, tension positive",
                      "Pa");
    add_monitor_plots(html, monitors, "shear_stress", "Shear stress of joints", "Pa");
  }
  if (answer.contains("reduction")) add_reduction(html, answer.at("reduction"));
  if (answer.contains("confirmed")) add_confirmed(html, answer.at("confirmed"));
  if (answer.contains("bolts")) add_bolt_forces(html, answer.at("bolts"));
  if (answer.contains("shotcrete")) add_shotcrete_forces(html, answer.at("shotcrete"));
  if (answer.contains("shaken")) add_shaken(html, answer.at("shaken"));
  html.heading(3, answer.contains("rest") ? "Energies and contact" : "Energies");
  add_energy_plot(html, answer.at("energy_history"));
  if (answer.contains("contacts_history")) add_contact_plot(html, answer.at("contacts_history"));
}

}  // namespace rockfold
