// Key blocks beside their motion, as text.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/base/vector.hpp"
#include "src/report/confirmed.hpp"
#include "src/report/design_names.hpp"
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

std::string number_or_dash(Real value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::vector<std::string> keyblock_row(const Confirmed& c) {
  const bool moved = c.seen != SeenMode::stays;
  return {block_ids(c.members),
          std::to_string(c.key->batch),
          mode_words(*c.key),
          joined_names(c.key->planes),
          number_or_dash(c.key->factor_of_safety, 2),
          seen_words(c.seen),
          fmt::format("{:.3g}", norm(c.displacement)),
          number_or_dash(c.off, 1),
          moved ? fmt::format("{:.1f}", c.rotation) : "-",
          c.agrees ? "yes" : "no: " + c.reason};
}

std::string keyblock_table(std::vector<Confirmed> keys, std::size_t most) {
  const auto rank = [](const Confirmed& c) {
    const Real safety = c.key->factor_of_safety;
    return std::pair(std::isfinite(safety) ? safety : 0, -c.key->weight);
  };
  std::stable_sort(keys.begin(), keys.end(),
                   [&](const Confirmed& a, const Confirmed& b) { return rank(a) < rank(b); });
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(keys.size(), most); ++i)
    rows.push_back(keyblock_row(keys[i]));
  return table_text({{"block", ""},
                     {"batch", ""},
                     {"predicted", "", true},
                     {"on", "", true},
                     {"safety", ""},
                     {"seen", "", true},
                     {"moved", "m"},
                     {"off the way", "deg"},
                     {"turned", "deg"},
                     {"as predicted", "", true}},
                    rows);
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

/// Block theory's forces have cohesion in them; a joint that slips has what is left of it.
std::string cohesion_note(const RunReport& report, const std::vector<Confirmed>& keys) {
  const auto& materials = report.model.joint_materials;
  std::set<std::string> weaker;
  for (const FaceOrigin& origin : report.blocks.origins)
    if (origin.joint_material != none && materials[origin.joint_material].cohesion >
                                             materials[origin.joint_material].residual_cohesion)
      weaker.insert(origin.name);
  std::set<std::string> slipped;
  for (const Confirmed& c : keys)
    if (c.seen == SeenMode::sliding)
      for (const std::string& plane : c.key->planes)
        if (weaker.contains(plane)) slipped.insert(plane);
  if (slipped.empty()) return "";
  return fmt::format(
      "\n  Blocks on {} go farther than their net force says: cohesion is gone at the first slip "
      "but "
      "for residual_cohesion.\n",
      fmt::join(slipped, ", "));
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
  const std::string note = cohesion_note(report, keys);
  return fact("key blocks that move", counts(keys)) + text + "\n" + keyblock_table(keys, most) +
         note + "\n";
}

}  // namespace rockfold
