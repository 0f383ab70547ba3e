// The summary of key blocks: the first batch on top, then what moves behind it and what just stays.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "src/report/design_names.hpp"
#include "src/report/joint_strength.hpp"
#include "src/report/progress_line.hpp"
#include "src/report/stability_words.hpp"
#include "src/report/summaries/keyblock_words.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {

const char* mode_words(SlidingMode mode, const Vec3& direction) {
  switch (mode) {
    case SlidingMode::lifting:
      return direction[2] > pushed_out_within    ? "pushed up"
             : direction[2] > -pushed_out_within ? "pushed out"
                                                 : "falls";
    case SlidingMode::single_plane:
      return "slides";
    case SlidingMode::two_planes:
      return "slides on two";
    case SlidingMode::rotation:
      return "turns";
    case SlidingMode::at_rest:
      return "rests";
  }
  return "";
}

const char* mode_words(const Keyblock& key) {
  return mode_words(key.mode, key.direction);
}

std::string number_or_dash(Real value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string joined_names(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "-" : text;
}

void sort_by_safety(std::vector<Keyblock>& keys) {
  const auto safety = [](const Keyblock& key) {
    return std::isfinite(key.factor_of_safety) ? key.factor_of_safety : 0;
  };
  std::stable_sort(keys.begin(), keys.end(), [&](const Keyblock& a, const Keyblock& b) {
    return std::pair(safety(a), -a.weight) < std::pair(safety(b), -b.weight);
  });
}

namespace {

/// Forces of small blocks keep two digits.
std::string fixed_or_dash(Real value, int decimals) {
  return std::isfinite(value) ? fixed_text(value, decimals) : "-";
}

/// Which columns a table of key blocks has beside those of all.
struct KeyblockColumns {
  bool batch = true;      ///< of blocks that stay there is none
  bool residual = false;  ///< factors of safety on joints that have slipped
};

std::vector<std::string> keyblock_row(const Keyblock& key, const KeyblockColumns& columns) {
  std::vector<std::string> row{block_ids(key.members)};
  if (columns.batch) row.push_back(std::to_string(key.batch));
  row.insert(row.end(),
             {fixed_text(key.volume, 2), fixed_text(key.weight / 1e3, 1), mode_words(key),
              joined_names(key.planes), number_or_dash(key.factor_of_safety, 2)});
  if (columns.residual) row.push_back(number_or_dash(key.residual_factor_of_safety, 2));
  row.insert(row.end(),
             {fixed_or_dash(key.sliding_force / 1e3, 1), fixed_or_dash(key.support_force / 1e3, 1),
              fixed_or_dash(key.support_pressure / 1e3, 2)});
  return row;
}

std::vector<Column> heads(const KeyblockColumns& columns) {
  std::vector<Column> list{{"block", ""}};
  if (columns.batch) list.push_back({"batch", ""});
  list.insert(
      list.end(),
      {{"volume", "m3"}, {"weight", "kN"}, {"motion", "", true}, {"on", "", true}, {"safety", ""}});
  if (columns.residual) list.push_back({"slipped", ""});
  list.insert(list.end(), {{"net", "kN"}, {"support", "kN"}, {"pressure", "kPa"}});
  return list;
}

std::string batches_text(const std::vector<Index>& batches) {
  std::string text;
  for (const Index n : batches) text += (text.empty() ? "" : " + ") + std::to_string(n);
  return text;
}

bool any_removable(const KeyblockReport& report) {
  return std::any_of(report.block_class.begin(), report.block_class.end(),
                     [](BlockClass c) { return c == BlockClass::stable || c == BlockClass::key; });
}

/// Blocks that stay, but with less than the target factor of safety.
std::string doubtful_summary(const KeyblockReport& report) {
  std::size_t count = 0;
  Real force = 0;
  for (const auto& block : report.stable)
    if (block.support_force > 0) ++count, force += block.support_force;
  if (count == 0) return "";
  const std::string more = report.keyblocks.empty() ? "" : "more ";
  return fact("below the target",
              fmt::format("{} {}{}, but {} {:.4g} kN for the target factor of safety", count, more,
                          count == 1 ? "block stays" : "blocks stay", count == 1 ? "needs" : "need",
                          force / 1e3));
}

/// Blocks that the limit of batches leaves without an answer.
std::string unexamined_summary(const KeyblockReport& report) {
  const auto count =
      std::count(report.block_class.begin(), report.block_class.end(), BlockClass::not_examined);
  if (count == 0 && !report.groups_left) return "";
  std::string what;
  if (count > 0)
    what = fmt::format("{} that only key blocks keep in place",
                       count == 1 ? "a block" : fmt::format("{} blocks", count));
  if (report.groups_left)
    what += fmt::format("{}groups that fail together", what.empty() ? "" : ", and ");
  return fact("not examined",
              what + "; support.batches = 0 looks for all that moves once these are gone");
}

/// What blocks need together.
struct KeyblockSums {
  std::int64_t blocks = 0, unheld = 0;  // along a given direction no force may suffice
  Real volume = 0, force = 0;

  void add(const Keyblock& key) {
    ++blocks;
    volume += key.volume;
    if (std::isfinite(key.support_force))
      force += key.support_force;
    else
      ++unheld;
  }
};

KeyblockSums sums_of(const std::vector<Keyblock>& keys) {
  KeyblockSums sums;
  for (const Keyblock& key : keys) sums.add(key);
  return sums;
}

std::string sums_text(const KeyblockSums& sums) {
  std::string text =
      fmt::format("{}, {:.4g} m3, {:.4g} kN of support for the target factor of safety",
                  sums.blocks == 1 ? "1 block" : grouped(sums.blocks) + " blocks", sums.volume,
                  sums.force / 1e3);
  if (sums.unheld > 0)
    text += fmt::format("; no force along support_direction holds {} of them", sums.unheld);
  return text;
}

/// The rows of those of `keys` that are not smaller than `smallest`, `most` of them, and how many are not there.
std::string keyblock_table(std::vector<Keyblock> keys, std::size_t most, Real smallest,
                           const KeyblockColumns& columns) {
  std::vector<std::vector<std::string>> rows;
  KeyblockSums small;
  std::erase_if(keys, [&](const Keyblock& key) {
    if (key.volume >= smallest) return false;
    small.add(key);
    return true;
  });
  for (std::size_t k = 0; k < std::min(most, keys.size()); ++k)
    rows.push_back(keyblock_row(keys[k], columns));
  std::string text = table_text(heads(columns), rows);
  if (rows.size() < keys.size())
    text += fmt::format("  … {} more: --table keyblocks.csv lists all\n",
                        grouped(static_cast<std::int64_t>(keys.size() - rows.size())));
  if (small.blocks > 0)
    text += fmt::format("  … {} smaller than {:g} m3, {:.4g} m3 together\n", grouped(small.blocks),
                        smallest, small.volume);
  return text;
}

/// A line for each batch behind the first, and the blocks of those that a later stage of excavation lets go first.
std::string later_batches(const KeyblockReport& report, std::size_t most) {
  std::string text;
  for (std::size_t batch = 2; batch <= report.batches.size(); ++batch) {
    std::vector<Keyblock> keys;
    for (const Keyblock& key : report.keyblocks)
      if (key.batch == static_cast<Index>(batch)) keys.push_back(key);
    const Index stage = report.batch_stage[batch - 1];
    const bool first = stage != report.batch_stage[batch - 2];
    if (first && batch > 2) text += "\n";
    text +=
        fact(fmt::format("batch {}{}", batch, stage > 0 ? fmt::format(", stage {}", stage) : ""),
             sums_text(sums_of(keys)));
    if (!first) continue;
    sort_by_safety(keys);
    text += "\n" +
            keyblock_table(keys, most, report.smallest_block, {true, any_residual_factor(report)});
  }
  return text.empty() ? "" : "\n" + text;
}

/// How many planes each joint mesh is on the blocks that move or might.
std::string mesh_fact(const KeyblockReport& report) {
  std::map<std::string, std::pair<Index, Index>> planes;  // least, most
  for (const auto* list : {&report.keyblocks, &report.stable})
    for (const Keyblock& key : *list)
      for (const MeshPlaneCount& mesh : key.mesh_planes) {
        auto& [least, most] = planes.try_emplace(mesh.mesh, mesh.planes, mesh.planes).first->second;
        least = std::min(least, mesh.planes);
        most = std::max(most, mesh.planes);
      }
  std::string text;
  for (const auto& [mesh, range] : planes)
    text += (text.empty() ? "" : ", ") + mesh + " " +
            (range.first == range.second ? fmt::format("{}", range.first)
                                         : fmt::format("{} to {}", range.first, range.second));
  return text.empty() ? "" : fact("planes of meshes", text + " on a block");
}

/// The least safe of the blocks that stay.
std::string stable_table(const KeyblockReport& report) {
  constexpr std::size_t most = 10;
  auto stable = report.stable;
  std::erase_if(stable, [&](const Keyblock& key) {
    return !std::isfinite(key.factor_of_safety) || key.volume < report.smallest_block;
  });
  if (stable.empty()) return "";
  sort_by_safety(stable);
  if (stable.size() > most) stable.resize(most);
  return "\n  Blocks that stay, the least safe first, and the motion that is held:\n\n" +
         keyblock_table(stable, most, 0, {false, any_residual_factor(report)});
}

}  // namespace

std::string support_summary(const KeyblockReport& report, const BlockArrays& blocks,
                            const StabilityReport* whole, std::size_t most) {
  const std::string whole_mass = whole ? fact("whole mass", whole_mass_words(*whole)) : "";
  if (report.keyblocks.empty())
    return fact("key blocks",
                any_removable(report)
                    ? "none: no block or group that fails one way moves under these loads"
                    : "none: no block can move by itself") +
           whole_mass + doubtful_summary(report) + mesh_fact(report) + stable_table(report);
  std::vector<Keyblock> first;
  for (const Keyblock& key : report.keyblocks)
    if (key.batch == 1) first.push_back(key);
  sort_by_safety(first);
  std::string text = fact(
      "key blocks", fmt::format("{} of {} blocks", report.keyblocks.size(), blocks.block_count()));
  text +=
      fact("batches", fmt::format("{} ({})", report.batches.size(), batches_text(report.batches)));
  text += fact("first batch", sums_text(sums_of(first)));
  if (report.batches.size() > 1) text += fact("all batches", sums_text(sums_of(report.keyblocks)));
  text += whole_mass + doubtful_summary(report) + unexamined_summary(report) + mesh_fact(report);
  return text + "\n" +
         keyblock_table(first, most, report.smallest_block, {true, any_residual_factor(report)}) +
         later_batches(report, most) + stable_table(report);
}

}  // namespace rockfold
