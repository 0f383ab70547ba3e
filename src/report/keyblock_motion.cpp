// Block theory beside motion: what block theory says of each key block, and what it did.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "src/base/vector.hpp"
#include "src/report/design_names.hpp"
#include "src/report/document_parts.hpp"
#include "src/report/keyblock_words.hpp"
#include "src/report/names.hpp"
#include "src/report/progress_line.hpp"
#include "src/report/summary.hpp"
#include "src/report/table.hpp"

namespace rockfold {
namespace {

/// How a block, or a group that moves as one, has moved.
struct KeyblockMotion {
  Vec3 displacement{};  ///< m, mean of its volume
  Real rotation = 0;    ///< deg, of the block that turned most
  Real size = 0;        ///< m, the cube root of its volume
  bool moved = false;   ///< by more than a hundredth of its size
};

constexpr Real degrees = 180 / std::numbers::pi;

KeyblockMotion motion_of(const Keyblock& key, const RunReport& report) {
  KeyblockMotion motion;
  Real volume = 0;
  for (const Index b : key.members) {
    const BlockMotion& block = report.run.blocks[b];
    motion.displacement += report.blocks.volume[b] * block.displacement;
    motion.rotation = std::max(motion.rotation, degrees * norm(block.rotation));
    volume += report.blocks.volume[b];
  }
  motion.displacement = (1 / volume) * motion.displacement;
  motion.size = std::cbrt(volume);
  motion.moved = norm(motion.displacement) > share_that_is_motion * motion.size;
  return motion;
}

/// deg between the way that block theory predicts and the way that was gone.
Real way_off(const Keyblock& key, const KeyblockMotion& motion) {
  const Vec3 u = motion.displacement;
  return degrees * std::atan2(norm(cross(key.direction, u)), dot(key.direction, u));
}

std::vector<std::string> motion_row(const Keyblock& key, const RunReport& report) {
  const KeyblockMotion motion = motion_of(key, report);
  const Real length = norm(motion.displacement);
  return {block_ids(key.members),
          std::to_string(key.batch),
          mode_words(key),
          joined_names(key.planes),
          std::isfinite(key.factor_of_safety) ? fmt::format("{:.2f}", key.factor_of_safety) : "-",
          motion.moved ? "moves" : "stays",
          fmt::format("{:.3g}", length > 1e-9 * motion.size ? length : 0),
          motion.moved ? fmt::format("{:.1f}", way_off(key, motion)) : "-",
          fmt::format("{:.1f}", motion.rotation)};
}

}  // namespace

std::string keyblock_motion_summary(const RunReport& report, std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  std::vector<Keyblock> keys = report.keyblocks->keyblocks;
  sort_by_safety(keys);
  std::size_t moved = 0;
  for (const Keyblock& key : keys) {
    moved += motion_of(key, report).moved;
    if (rows.size() < most) rows.push_back(motion_row(key, report));
  }
  if (keys.empty()) return "";
  return fact("key blocks that move",
              fmt::format("{} of {}, by more than a hundredth of their size", moved, keys.size())) +
         "\n" +
         table_text({{"block", ""},
                     {"batch", ""},
                     {"predicted", "", true},
                     {"on", "", true},
                     {"safety", ""},
                     {"seen", "", true},
                     {"moved", "m"},
                     {"off the way", "deg"},
                     {"turned", "deg"}},
                    rows) +
         "\n";
}

Json keyblock_motion_json(const RunReport& report) {
  Json list = Json::array();
  for (const Keyblock& key : report.keyblocks->keyblocks) {
    const KeyblockMotion motion = motion_of(key, report);
    Json entry{{"block", key.members.front() + 1},
               {"batch", key.batch},
               {"mode", mode_name(key.mode)},
               {"direction", key.direction},
               {"moved", motion.moved},
               {"displacement", motion.displacement},
               {"rotation", motion.rotation},
               {"off_direction", nullptr}};
    if (motion.moved) entry["off_direction"] = way_off(key, motion);
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace rockfold
