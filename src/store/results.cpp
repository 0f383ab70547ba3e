#include "src/store/results.hpp"

#include <limits>

#include "src/run/run_state.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

/// The field at each point.
std::vector<Vec3> interpolated(const MaterialPoints& points, const std::vector<Vec3>& field) {
  std::vector<Vec3> value(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) value[n] = interpolate(points, n, field);
  return value;
}

}  // namespace

BlockFields block_fields(const KeyblockReport& report) {
  const std::size_t blocks = report.block_class.size();
  BlockFields fields;
  for (const auto block_class : report.block_class)
    fields.block_class.push_back(static_cast<std::uint8_t>(block_class));
  fields.batch = report.batch;
  fields.mode.assign(blocks, 0);
  fields.factor_of_safety.assign(blocks, std::numeric_limits<Real>::quiet_NaN());
  fields.sliding_force.assign(blocks, 0);
  fields.support_force.assign(blocks, 0);
  fields.direction.assign(blocks, Vec3{});
  for (const auto* list : {&report.keyblocks, &report.stable})
    for (const auto& key : *list)
      for (const Index block : key.members) {  // of a group, each block has what the group has
        fields.mode[block] = static_cast<std::uint8_t>(1 + static_cast<int>(key.mode));
        fields.factor_of_safety[block] = key.factor_of_safety;
        fields.sliding_force[block] = key.sliding_force;
        fields.support_force[block] = key.support_force;
        fields.direction[block] = key.direction;
      }
  return fields;
}

void add_bolting(BlockFields& fields, const BoltingReport& bolting) {
  const std::size_t blocks = fields.block_class.size();
  fields.supported_factor_of_safety.assign(blocks, std::numeric_limits<Real>::quiet_NaN());
  fields.utilisation.assign(blocks, std::numeric_limits<Real>::quiet_NaN());
  for (const auto* list : {&bolting.keyblocks, &bolting.stable, &bolting.at_rest})
    for (const BlockSupport& support : *list)
      for (const Index block : support.members) {
        fields.supported_factor_of_safety[block] = support.held.factor_of_safety;
        if (!support.crossings.empty())
          fields.utilisation[block] = 100 * support.force_mobilisation;
      }
}

void add_stored_state(ResultWriter& writer, const MaterialPoints& block_vertices,
                      const StoredState& state) {
  const auto displacement = interpolated(block_vertices, state.motion.displacement);
  const auto velocity = interpolated(block_vertices, state.motion.velocity);
  writer.add_state({state.step, state.motion, displacement, velocity, state.element_stress,
                    state.block_stress, state.nodal_stress,
                    state.contacts ? &*state.contacts : nullptr, hash_of(state), state.gone,
                    &state.bolts});
}

}  // namespace rockfold
