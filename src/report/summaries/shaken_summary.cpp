// What an earthquake's record moves, as text.
#include <algorithm>

#include <fmt/format.h>

#include "src/base/vector.hpp"
#include "src/report/design_names.hpp"
#include "src/report/shaken_blocks.hpp"
#include "src/report/summaries/keyblock_words.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {
namespace {

/// Of shear over normal stiffness, above which a wedge keeps much of the pressure with which its joints have been wedged.
constexpr Real stiff_in_shear = 0.3;

std::vector<std::string> shaken_row(const ShakenBlock& shaken) {
  return {
      block_ids(shaken.members), shaken.mode ? joined_names(shaken.mode->planes) : "-",
      fmt::format("{:.3g}", norm(shaken.displacement)),
      shaken.newmark ? fmt::format("{:.3g}{}", *shaken.newmark, shaken.lifts ? " *" : "") : "-"};
}

/// Whether joints that a wedge slides on are nearly as stiff in shear as they are in compression, as they are by default.
bool wedges_in(const ShakenBlock& shaken, const Model& model) {
  if (!shaken.newmark || shaken.mode->mode != SlidingMode::two_planes) return false;
  return std::any_of(model.joint_materials.begin(), model.joint_materials.end(),
                     [](const JointMaterial& joint) {
                       return !joint.shear_stiffness || !joint.normal_stiffness ||
                              *joint.shear_stiffness > stiff_in_shear * *joint.normal_stiffness;
                     });
}

std::string notes(const RunReport& report, const std::vector<ShakenBlock>& list) {
  std::string text;
  if (std::any_of(list.begin(), list.end(), [](const auto& s) { return s.lifts; }))
    text += "\n  * would leave a joint for a time, where Newmark's block keeps to it.\n";
  if (std::any_of(list.begin(), list.end(),
                  [&](const auto& s) { return wedges_in(s, report.model); }))
    text +=
        "\n  Newmark's block has no stiffness. A wedge on joints that are about as stiff in shear "
        "as in\n"
        "  compression, as they are by default, stays jammed between pulses and slides less: give\n"
        "  joint_material.shear_stiffness, a tenth of normal_stiffness in much of rock.\n";
  if (report.keyblocks &&
      std::any_of(list.begin(), list.end(), [](const auto& s) { return !s.newmark; }))
    text +=
        "\n  - no joint, or line of two, that it would slide on: it falls, turns, is held without "
        "friction "
        "too,\n  or its rock goes on beyond the model (`continues`).\n";
  if (!report.keyblocks)
    text += "\n  With [support] Newmark's rigid block stands beside each block that may slide.\n";
  return text;
}

}  // namespace

std::string shaken_summary(const RunReport& report, std::size_t most) {
  const std::vector<ShakenBlock> list = shaken_blocks(report);
  if (list.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(list.size(), most); ++i) rows.push_back(shaken_row(list[i]));
  const std::string head = list.size() > most
                               ? fmt::format("{}; the {} that move furthest:", list.size(), most)
                               : std::to_string(list.size());
  return fact("blocks under the record", head) + "\n" +
         table_text({{"block", ""}, {"on", "", true}, {"moved", "m"}, {"Newmark", "m"}}, rows) +
         notes(report, list);
}

}  // namespace rockfold
