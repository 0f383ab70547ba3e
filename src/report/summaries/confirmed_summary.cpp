// Key blocks beside their motion, as text.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/base/vector.hpp"
#include "src/report/confirmed.hpp"
#include "src/report/design_names.hpp"
#include "src/report/joint_strength.hpp"
#include "src/report/summaries/keyblock_words.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {
namespace {

const char* seen_words(SeenMode mode) {
  switch (mode) {
    case SeenMode::stays:
      return "stays";
    case SeenMode::sliding:
      return "slides";
    case SeenMode::falling:
      return "falls";
    case SeenMode::rotation:
      return "turns";
  }
  return "";
}

/// The factor of joints that have slipped stands behind that of joints that have not.
constexpr std::ptrdiff_t residual_column = 5;

/// Columns that not every table has.
struct Shown {
  bool residual = false, support = false;
};

std::vector<std::string> keyblock_row(const Confirmed& c, const Shown& shown) {
  const bool moved = c.seen != SeenMode::stays;
  std::vector<std::string> row{block_ids(c.members),
                               std::to_string(c.key->batch),
                               c.is_held() ? "stays, held" : mode_words(*c.key),
                               joined_names(c.key->planes),
                               number_or_dash(c.key->factor_of_safety, 2),
                               seen_words(c.seen),
                               fmt::format("{:.3g}", norm(c.displacement)),
                               number_or_dash(c.off, 1),
                               moved ? fmt::format("{:.1f}", c.rotation) : "-",
                               !c.agrees       ? "no: " + c.reason
                               : c.other_loads ? "yes, under other loads"
                                               : "yes"};
  if (shown.support)
    row.insert(row.begin() + residual_column,
               c.support ? number_or_dash(c.support->held.factor_of_safety, 2) : "-");
  if (shown.residual)
    row.insert(row.begin() + residual_column, number_or_dash(c.key->residual_factor_of_safety, 2));
  return row;
}

std::string keyblock_table(std::vector<Confirmed> keys, std::size_t most, bool residual) {
  const Shown shown{residual, std::any_of(keys.begin(), keys.end(),
                                          [](const Confirmed& c) { return c.support != nullptr; })};
  const auto rank = [](const Confirmed& c) {
    const Real safety = c.key->factor_of_safety;
    return std::pair(std::isfinite(safety) ? safety : 0, -c.key->weight);
  };
  std::stable_sort(keys.begin(), keys.end(),
                   [&](const Confirmed& a, const Confirmed& b) { return rank(a) < rank(b); });
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(keys.size(), most); ++i)
    rows.push_back(keyblock_row(keys[i], shown));
  std::vector<Column> columns{{"block", ""},           {"batch", ""},
                              {"predicted", "", true}, {"on", "", true},
                              {"safety", ""},          {"seen", "", true},
                              {"moved", "m"},          {"off the way", "deg"},
                              {"turned", "deg"},       {"as predicted", "", true}};
  if (shown.support) columns.insert(columns.begin() + residual_column, {"supported", ""});
  if (shown.residual) columns.insert(columns.begin() + residual_column, {"slipped", ""});
  return table_text(columns, rows);
}

/// "7 of 8 by more than a hundredth of their size, 6 as predicted; of the first batch 5 of 5"
std::string counts(const std::vector<Confirmed>& keys) {
  std::size_t moved = 0, agreed = 0, first = 0, first_agreed = 0;
  for (const Confirmed& c : keys) {
    moved += c.seen != SeenMode::stays;
    agreed += c.agrees;
    first += c.key->batch == 1;
    first_agreed += c.key->batch == 1 && c.agrees;
  }
  std::string text = fmt::format("{} of {} by more than a hundredth of their size, {} as predicted",
                                 moved, keys.size(), agreed);
  if (first < keys.size())
    text += fmt::format("; of the first batch {} of {}", first_agreed, first);
  return text;
}

/// The net force is that of joints that have not slipped.
std::string weaker_note(const RunReport& report, const std::vector<Confirmed>& keys) {
  std::set<std::string> weaker;
  for (const FaceOrigin& origin : report.blocks.origins)
    if (origin.joint_material != none &&
        loses_strength(report.model.joint_materials[origin.joint_material]))
      weaker.insert(origin.name);
  std::set<std::string> slipped;
  for (const Confirmed& c : keys)
    if (c.seen == SeenMode::sliding)
      for (const std::string& plane : c.key->planes)
        if (weaker.contains(plane)) slipped.insert(plane);
  if (slipped.empty()) return "";
  return fmt::format(
      "\n  Blocks on {} go farther than their net force says: joints that have slipped have less "
      "strength.\n",
      fmt::join(slipped, ", "));
}

std::string loads_note(const std::vector<Confirmed>& keys) {
  if (std::none_of(keys.begin(), keys.end(), [](const Confirmed& c) { return c.other_loads; }))
    return "";
  return "\n  Block theory counts a seismic coefficient here, which does not act in the "
         "analysis.\n";
}

}  // namespace

std::string confirmed_summary(const RunReport& report, std::size_t most) {
  std::vector<Confirmed> keys;
  std::string others;
  std::size_t other_count = 0;
  for (Confirmed& c : confirmed_motion(report)) {
    if (c.key) {
      if (c.key->volume >= report.keyblocks->smallest_block) keys.push_back(std::move(c));
      continue;
    }
    if (++other_count <= most)
      others += (others.empty() ? "" : ", ") + block_ids(c.members) + " " + seen_words(c.seen) +
                " (" + c.reason + ")";
  }
  if (other_count > most) others += fmt::format(" and {} more", other_count - most);
  std::string text;
  if (other_count > 0) text += fact("others that move", others);
  if (keys.empty()) return text;
  const std::string note = weaker_note(report, keys) + loads_note(keys);
  return fact("key blocks that move", counts(keys)) + text + "\n" +
         keyblock_table(keys, most, any_residual_factor(*report.keyblocks)) + note;
}

}  // namespace rockfold
