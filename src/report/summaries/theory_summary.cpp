#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "src/report/names.hpp"
#include "src/report/summaries/keyblock_words.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {

namespace {

std::string joined(const std::vector<std::string>& names) {
  return names.empty() ? "-" : fmt::format("{}", fmt::join(names, ", "));
}

std::string motion(const TheoryBlock& block) {
  return block.movement ? mode_words(block.movement->mode, block.movement->direction) : "stays";
}

/// Whether there is more to it than rounding: where a pyramid touches the section in one corner, or along a side, its largest block is a point, or flat.
bool has_volume(const TheoryBlock& block) {
  const auto& areas = block.shape.joint_area;
  return block.shape.volume >
         1e-12 * std::pow(std::accumulate(areas.begin(), areas.end(), Real{0}), 1.5);
}

std::string safety(const TheoryBlock& block) {
  const Real f = block.movement ? block.movement->factor_of_safety() : 0;
  return block.movement && std::isfinite(f) ? fmt::format("{:.2f}", f) : "-";
}

std::string pyramids_text(const TheoryReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (const PyramidEntry& entry : report.pyramids)
    if (entry.exists)
      rows.push_back({entry.code, fmt::format("{:.3f}", entry.space.solid_angle),
                      motion(entry.unit), joined(entry.unit.planes), safety(entry.unit),
                      joined(entry.removable_from)});
  return fact("joint pyramids", fmt::format("{} of {} are not empty (0 above a joint, 1 below)",
                                            rows.size(), report.pyramids.size())) +
         "\n" +
         table_text({{"pyramid", "", true},
                     {"angle", "sr"},
                     {"its block", "", true},
                     {"on", "", true},
                     {"safety", ""},
                     {"removable from", "", true}},
                    rows);
}

std::string blocks_text(const ExcavationTheory& theory) {
  if (theory.blocks.empty()) return "  no block can move: none is removable\n";
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> without;
  for (const TheoryBlock& block : theory.blocks) {
    if (!has_volume(block)) {
      without.push_back(block.code);
      continue;
    }
    rows.push_back({block.code, fmt::format("{:.3g}", block.shape.volume),
                    fixed_text(block.weight / 1e3, 1), motion(block), joined(block.planes),
                    safety(block), fixed_text(block.support_force / 1e3, 1),
                    fixed_text(block.support_pressure / 1e3, 2)});
  }
  std::string of_none =
      without.empty()
          ? ""
          : fact("no volume", joined(without) + ": the largest block is a point or flat");
  if (rows.empty()) return of_none;
  return table_text({{"largest of", "", true},
                     {"volume", "m3"},
                     {"weight", "kN"},
                     {"it", "", true},
                     {"on", "", true},
                     {"safety", ""},
                     {"support", "kN"},
                     {"pressure", "kPa"}},
                    rows) +
         of_none;
}

std::string scan_text(const ExcavationTheory& theory) {
  const auto entry_text = [&](Index i) {
    const ScanEntry& e = theory.scan->entries[static_cast<std::size_t>(i)];
    return fmt::format("{} {:g}{}: {} key blocks, up to {:.3g} m3 and {:.1f} kN of support",
                       theory.tunnel ? "trend" : "dip direction", e.direction,
                       theory.tunnel ? fmt::format(", plunge {:g}", e.plunge) : "", e.key_blocks,
                       e.largest_volume, e.largest_support / 1e3);
  };
  return fact("best direction", entry_text(theory.scan->best)) +
         fact("worst direction", entry_text(theory.scan->worst));
}

std::string distribution_text(const SampleDistribution& d, Real unit, const char* name) {
  if (d.count == 0) return "-";
  std::string text = fmt::format("mean {:.3g} {}", d.mean / unit, name);
  for (const Quantile& q : d.quantiles)
    if (q.level == 0.5 || q.level == 0.95)
      text += fmt::format(", {:g} % below {:.3g} ({:.3g} … {:.3g})", 100 * q.level, q.value / unit,
                          q.low / unit, q.high / unit);
  return text;
}

std::string monte_carlo_text(const MonteCarloResult& result) {
  return fact("realisations", fmt::format("{} of {:g} m, seed {}", result.realisations,
                                          result.length, result.seed)) +
         fact("key block in", fmt::format("{:.2f} % ({:.2f} … {:.2f} %)", 100 * result.key.value,
                                          100 * result.key.low, 100 * result.key.high)) +
         fact("largest key block", distribution_text(result.largest_volume, 1, "m3")) +
         fact("largest pressure", distribution_text(result.support_pressure, 1e3, "kPa"));
}

}  // namespace

std::string theory_summary(const TheoryReport& report) {
  std::string text = pyramids_text(report);
  for (const ExcavationTheory& theory : report.excavations) {
    text += fmt::format("\n{} {}\n", theory.tunnel ? "Tunnel" : "Slope", theory.name);
    text += blocks_text(theory);
    if (theory.scan) text += scan_text(theory);
    if (theory.monte_carlo) text += monte_carlo_text(*theory.monte_carlo);
  }
  return text;
}

}  // namespace rockfold
