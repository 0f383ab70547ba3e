// What bolts and shotcrete bear at the end of a run.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "src/printed/plot.hpp"
#include "src/printed/sections.hpp"

namespace rockfold {

namespace {

constexpr std::size_t most_rows = 40;
constexpr std::size_t most_curves = 8;  // as many as there are colours

/// The most used first.
std::vector<Json> by_use(const Json& bolts) {
  std::vector<Json> sorted(bolts.begin(), bolts.end());
  const auto use = [](const Json& bolt) { return bolt.at("mobilisation").get<Real>(); };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Json& a, const Json& b) { return use(a) > use(b); });
  return sorted;
}

/// Linear between the places of the bolt; NaN beyond its ends.
Real value_at(const std::vector<Real>& places, const std::vector<Real>& values, Real place) {
  const auto next = std::lower_bound(places.begin(), places.end(), place);
  if (next == places.end()) return std::numeric_limits<Real>::quiet_NaN();
  const std::size_t i = next - places.begin();
  if (*next == place) return values[i];
  if (i == 0) return std::numeric_limits<Real>::quiet_NaN();
  const Real share = (place - places[i - 1]) / (places[i] - places[i - 1]);
  return (1 - share) * values[i - 1] + share * values[i];
}

void add_force_plot(Html& html, const std::vector<Json>& bolts) {
  Plot plot{"Force along the bolts most used", "N", {}, {}, "from the collar, m"};
  std::set<Real> places;
  const std::size_t count = std::min(bolts.size(), most_curves);
  for (std::size_t i = 0; i < count; ++i)
    for (const Json& at : bolts[i].at("along").at("at")) places.insert(at.get<Real>());
  plot.at.assign(places.begin(), places.end());
  for (std::size_t i = 0; i < count; ++i) {
    const Json& along = bolts[i].at("along");
    const auto at = along.at("at").get<std::vector<Real>>(),
               force = along.at("force").get<std::vector<Real>>();
    PlotCurve curve{bolts[i].at("name"), {}};
    for (const Real place : plot.at) curve.values.push_back(value_at(at, force, place));
    plot.curves.push_back(std::move(curve));
  }
  if (const std::string svg = plot_svg(plot); !svg.empty()) html.figure(svg, "");
}

std::string states_text(const Json& bolts) {
  std::map<std::string, Index> states;
  for (const Json& bolt : bolts) ++states[bolt.at("state").get<std::string>()];
  std::string text;
  for (const auto& [state, count] : states)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state);
  return text;
}

}  // namespace

void add_bolt_forces(Html& html, const Json& bolts) {
  const std::vector<Json> sorted = by_use(bolts);
  html.heading(3, "What bolts bear");
  html.paragraph("At the end: " + states_text(bolts) + ".");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(sorted.size(), most_rows); ++i) {
    const Json& bolt = sorted[i];
    rows.push_back({bolt.at("name"), bolt.at("state"), digits(bolt.at("force"), 4, 1e3),
                    digits(bolt.at("shear"), 4, 1e3), digits(bolt.at("plate"), 4, 1e3),
                    digits(bolt.at("peak"), 4, 1e3), digits(bolt.at("mobilisation"), 3, 1e-2),
                    digits(bolt.at("broken_at"))});
  }
  html.table(sorted.size() > most_rows
                 ? fmt::format("The {} most used of {}", most_rows, sorted.size())
                 : "",
             {{"bolt", "", true},
              {"state", "", true},
              {"force", "kN"},
              {"across", "kN"},
              {"plate", "kN"},
              {"peak", "kN"},
              {"used", "%"},
              {"broken at", "s"}},
             rows);
  add_force_plot(html, sorted);
}

void add_shotcrete_forces(Html& html, const Json& shotcrete) {
  html.heading(3, "What shotcrete bears");
  html.facts({{"Over joints of", quantity(shotcrete.at("length"), "m")},
              {"Bears all that it can along", quantity(shotcrete.at("yielding"), "m")},
              {"Broken along", quantity(shotcrete.at("broken"), "m")},
              {"Force, in all", quantity(shotcrete.at("force"), "N")}});
}

}  // namespace rockfold
