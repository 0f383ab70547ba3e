#include "src/report/summaries/design_summary.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/report/design_names.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {

namespace {

constexpr std::size_t most_rows = 20;

std::string safety_text(Real safety) {
  if (std::isnan(safety)) return "-";
  return std::isinf(safety) ? "held" : safety >= 100 ? "> 100" : fmt::format("{:.2f}", safety);
}

std::vector<std::string> support_row(const BlockSupport& support) {
  Real capacity = 0;
  Index bolts = 0;
  for (const BoltCrossing& c : support.crossings) {
    capacity += c.capacity;
    bolts += c.capacity > 0;
  }
  return {block_ids(support.members),
          std::to_string(support.crossings.size()),
          std::to_string(bolts),
          fmt::format("{:.1f}", capacity / 1e3),
          safety_text(support.held.factor_of_safety),
          bolts == 0                ? "-"
          : support.held.in_balance ? fmt::format("{:.0f}", 100 * support.force_mobilisation)
                                    : "over",
          support.held.adequate ? "yes" : "no",
          fmt::format("{:.1f}", support.held.missing_force / 1e3)};
}

/// Those that need most support first, as in the table of key blocks.
std::vector<std::size_t> by_support(const std::vector<Keyblock>& keyblocks) {
  std::vector<std::size_t> order(keyblocks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return keyblocks[a].support_force > keyblocks[b].support_force;
  });
  return order;
}

/// Of the blocks that stay with less than the target factor of safety.
std::string doubtful_text(const BoltingReport& bolting, const KeyblockReport& keyblocks) {
  Index doubtful = 0, held = 0;
  for (std::size_t i = 0; i < keyblocks.stable.size(); ++i) {
    if (!(keyblocks.stable[i].support_force > 0)) continue;
    ++doubtful;
    held += bolting.stable[i].held.adequate;
  }
  return doubtful == 0
             ? ""
             : fmt::format("; of those that stay below the target {} of {}", held, doubtful);
}

std::string shotcrete_fact(const Shotcrete& shotcrete) {
  std::vector<std::string> walls;
  for (const WallFaces& faces : shotcrete.on) walls.push_back(faces.name);
  return fact("shotcrete",
              fmt::format("{:.3g} m on {}", shotcrete.thickness, fmt::join(walls, ", ")));
}

std::string bolting_text(const BoltingReport& bolting, const KeyblockReport& keyblocks,
                         const Model& model) {
  std::string text;
  for (const BoltGroup& group : bolting.groups)
    if (group.is_pattern)
      text += fact("bolts " + group.name,
                   fmt::format("{} on {} ({:.4g} m2)", group.bolts, group.on, group.wall_area));
  text += fact("bolts", fmt::format("{}, {:.6g} m", bolting.bolts.size(), bolting.length));
  if (model.shotcrete) text += shotcrete_fact(*model.shotcrete);
  text += fact("held", fmt::format("{} of {} key blocks; of the first batch {} of {}",
                                   bolting.adequate, bolting.keyblocks.size(),
                                   bolting.first_batch_adequate, bolting.first_batch) +
                           doubtful_text(bolting, keyblocks));
  if (!bolting.disturbed.empty())
    text += fact("disturbed", fmt::format("{} (below the target because of active bolts)",
                                          block_list(bolting.disturbed)));
  std::vector<std::vector<std::string>> rows;
  std::size_t listed = 0;
  for (const std::size_t i : by_support(keyblocks.keyblocks)) {
    if (keyblocks.keyblocks[i].volume < keyblocks.smallest_block) continue;
    if (++listed <= most_rows) rows.push_back(support_row(bolting.keyblocks[i]));
  }
  if (rows.empty()) return text;
  text += "\n" + table_text({{"block", "", false},
                             {"bolts", "", false},
                             {"of use", "", false},
                             {"capacity", "kN", false},
                             {"with support", "", false},
                             {"used", "%", false},
                             {"enough", "", true},
                             {"missing", "kN", false}},
                            rows);
  if (listed > most_rows)
    text += fmt::format("  … {} more: --table keyblocks.csv lists all\n",
                        grouped(static_cast<std::int64_t>(listed - most_rows)));
  return text;
}

std::string search_text(const PatternSearchReport& search, const Model& model) {
  const auto trial_text = [&](const PatternTrial& trial) {
    return fmt::format("{} bolts {} of {:g} m at {:g} m, {:.4g} {}", trial.bolts,
                       model.bolt_types[trial.type].name, trial.length, trial.spacing,
                       search.by_mass ? trial.weight : trial.weight / 1e3,
                       search.by_mass ? "kg" : "kN m");
  };
  if (search.best != none) return fact("lightest pattern", trial_text(search.trials[search.best]));
  std::string text = fact("lightest pattern", fmt::format("none of {} holds all {} key blocks",
                                                          search.patterns, search.wanted));
  if (search.nearest == none) return text;
  const PatternTrial& nearest = search.trials[search.nearest];
  text += fact("  nearest", fmt::format("{} held: {}", nearest.held, trial_text(nearest)));
  if (!search.not_held.empty()) text += fact("  not held", block_list(search.not_held));
  if (!search.disturbed.empty()) text += fact("  disturbed", block_list(search.disturbed));
  return text;
}

std::string classification_text(const ClassificationReport& report) {
  std::string text;
  if (report.q) {
    const QReport& q = *report.q;
    std::string name = q_class(q.value);
    std::replace(name.begin(), name.end(), '_', ' ');
    text += fact("Q", fmt::format("{:.3g}, {} rock; no support up to {:.3g} m of span", q.value,
                                  name, q.unsupported_span));
    text += fact("  roof pressure", fmt::format("{:.3g} kPa", q.roof_pressure / 1e3));
    if (q.roof_bolts) text += fact("  roof bolts", fmt::format("{:.3g} m long", *q.roof_bolts));
  }
  if (report.rmr) {
    const RmrReport& rmr = *report.rmr;
    const auto row = static_cast<std::size_t>(rmr.number - 1);
    text += fact("RMR", fmt::format("{:.3g}, class {}, {}; stands {}", rmr.value, rmr_classes[row],
                                    rmr_rock[row], rmr.stand_up.text));
    if (rmr.roof_pressure)
      text += fact("  roof pressure", fmt::format("{:.3g} kPa", *rmr.roof_pressure / 1e3));
  }
  const BlockTheoryDemand& demand = report.demand;
  text +=
      fact("block theory",
           fmt::format("support pressure {:.3g} kPa at most, {:.3g} kPa in the mean; deepest key "
                       "block {:.3g} m",
                       demand.largest_pressure / 1e3, demand.mean_pressure / 1e3, demand.deepest));
  return text;
}

}  // namespace

std::string design_summary(const Model& model, const KeyblockReport& keyblocks,
                           const SupportDesign& design) {
  std::string text;
  if (design.joint_stress && !design.joint_stress->stages.empty()) {
    const ContinuumFacts& facts = design.joint_stress->stages.back();
    text += "\n" + fact("in-situ stress",
                        fmt::format("elastic round openings: cells of {:.3g} m, {} unknowns",
                                    facts.spacing, grouped(facts.unknowns)));
  }
  if (design.bolting) text += "\n" + bolting_text(*design.bolting, keyblocks, model);
  if (design.search) text += "\n" + search_text(*design.search, model);
  if (design.classification) text += "\n" + classification_text(*design.classification);
  return text;
}

}  // namespace rockfold
