#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "src/report/names.hpp"
#include "src/report/progress_line.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {

namespace {

/// Rows of the table of joints; a network of thousands of named joints would hide the rest.
constexpr std::size_t most_origins = 12;

std::string size_table(const BlockStatistics& blocks) {
  std::vector<Column> columns{{"block sizes", "", true}};
  for (const int p : percentiles) columns.push_back({fmt::format("D{}", p), "", false});
  const auto row = [](const std::string& name, const Percentiles& values) {
    std::vector<std::string> entries{name};
    for (const Real v : values) entries.push_back(fmt::format("{:.3g}", v));
    return entries;
  };
  return table_text(columns, {row("m3, by number", blocks.volume_by_number),
                              row("m3, by volume", blocks.volume_by_volume),
                              row("m, by volume", blocks.size_by_volume)});
}

/// "71 % cubic, 20 % platy-cubic": classes by their share of the volume, those of at least a half per cent.
std::string class_shares(const BlockStatistics& blocks) {
  std::array<int, shape_class_count> order{};
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return blocks.of_class[a].volume > blocks.of_class[b].volume;
  });
  std::string text;
  for (const int c : order) {
    const Real share = 100 * blocks.of_class[c].volume / blocks.volume;
    if (share < 0.5) continue;
    std::string name = shape_name(static_cast<ShapeClass>(c));
    std::replace(name.begin(), name.end(), '_', '-');
    text += fmt::format("{}{:.0f} % {}", text.empty() ? "" : ", ", share, name);
  }
  return text;
}

std::string rqd_text(const RockMeasures& measures) {
  Real length = 0;
  for (const auto& line : measures.lines) length += line.length_in_rock;
  if (!std::isfinite(measures.rqd)) return "no scanline meets rock";
  return fmt::format("{:.1f} % along {:.4g} m of {} {}", 100 * measures.rqd, length,
                     measures.lines.size(), measures.lines.size() == 1 ? "line" : "lines");
}

std::vector<std::string> joint_row(const OriginIntensity& i) {
  return {i.name,
          grouped(i.joints),
          fmt::format("{:.5g}", i.area),
          fmt::format("{:.3g}", i.p10),
          fmt::format("{:.3g}", i.p21),
          fmt::format("{:.3g}", i.p32)};
}

std::string joint_table(const RockMeasures& measures) {
  const std::vector<Column> columns{{"joints", "", true},   {"in rock", "", false},
                                    {"area", "m2", false},  {"P10", "1/m", false},
                                    {"P21", "m/m2", false}, {"P32", "m2/m3", false}};
  std::vector<std::vector<std::string>> rows;
  for (const auto& i : measures.intensities)
    if (rows.size() < most_origins) rows.push_back(joint_row(i));
  if (rows.size() < measures.intensities.size())
    rows.push_back({fmt::format("and {} more", measures.intensities.size() - rows.size()), "", "",
                    "", "", ""});
  if (measures.intensities.size() > 1) rows.push_back(joint_row(measures.all_joints));
  return table_text(columns, rows);
}

std::string stage_table(const std::vector<StageReport>& stages) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& stage : stages)
    rows.push_back({std::to_string(stage.stage), grouped(stage.blocks),
                    fmt::format("{:.5g}", stage.volume),
                    fmt::format("{:.5g}", stage.new_free_area)});
  return table_text({{"stage", "", false},
                     {"blocks", "", false},
                     {"removed", "m3", false},
                     {"laid open", "m2", false}},
                    rows);
}

}  // namespace

std::string measure_summary(const RockMeasures& measures) {
  const BlockStatistics& blocks = measures.blocks;
  std::string text = size_table(blocks) + "\n";
  text += fact("shapes", fmt::format("{} of the volume", class_shares(blocks)));
  text += fact("joint count Jv", fmt::format("{:.3g} joints/m3", measures.volumetric_joint_count));
  text += fact("RQD", rqd_text(measures));
  if (!blocks.flags.empty())
    text += fact("flagged", fmt::format("{} small, {} elongated", grouped(blocks.small_blocks),
                                        grouped(blocks.elongated_blocks)));
  if (!measures.intensities.empty()) text.append("\n").append(joint_table(measures));
  if (!measures.stages.empty()) text.append("\n").append(stage_table(measures.stages));
  return text;
}

}  // namespace rockfold
