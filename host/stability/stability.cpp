#include "host/stability/stability.hpp"

#include <limits>

#include <fmt/format.h>

#include "host/stability/rock_mass.hpp"
#include "host/stability/verify.hpp"
#include "src/base/error.hpp"

namespace rockfold {

StageKeys keys_of_stability() {
  return {
      "stability",
      {"gravity", "material.density", "joint_material.friction_angle", "joint_material.cohesion",
       "contact_pair", "bolt_type", "bolt", "bolt_pattern", "joint_material.tensile_strength",
       "support.seismic_coefficient", "support.water_pressure", "water", "point_load", "traction",
       "fixed.where", "fixed.components"}};
}

Index moving_block_count(const BlockArrays& blocks, const Model& model) {
  const std::vector<std::uint8_t> held = held_blocks(blocks, model).held;
  Index count = 0;
  for (Index b = 0; b < blocks.block_count(); ++b)
    if (!held[b] && blocks.stage[b] == 0) ++count;
  return count;
}

StabilityReport find_stability(const Cutting& cutting, const BlockArrays& blocks,
                               const Model& model, Progress& progress) {
  StabilityReport report;
  report.mass = rigid_mass(cutting, blocks, model);
  report.partly_held = held_blocks(blocks, model).partly_held;
  const auto count = static_cast<Index>(report.mass.bodies.size());
  if (count > most_moving_blocks)
    throw Error(
        ErrorKind::model,
        fmt::format("{} blocks may move, and limit analysis of the whole mass is for at most {}: "
                    "join blocks by [cut] min_volume or [[merge]], or hold rock that stays by "
                    "[[fixed]]",
                    count, most_moving_blocks));
  if (count == 0) {
    report.bound.factor = std::numeric_limits<Real>::infinity();
    report.sliding = find_sliding(report.mass, report.bound, progress);
    return report;
  }
  report.bound = find_bound(report.mass, progress);
  report.bound_proved =
      !report.bound.below.force.empty() &&
      verify({report.mass, report.bound.below, report.bound.above, {}, {}}).holds();
  report.sliding = find_sliding(report.mass, report.bound, progress);
  report.at_bound = moving_blocks(report.mass, report.bound.above, report.bound.below);
  report.at_sliding = moving_blocks(report.mass, report.sliding.mechanism, report.sliding.balance);
  return report;
}

}  // namespace rockfold
