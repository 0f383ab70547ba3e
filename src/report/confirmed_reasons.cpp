#include "src/report/confirmed_reasons.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// m, that a constant acceleration (m/s²) takes a block from rest in the analysis, once a stage of excavation has been dug (where a step does
/// that; 0: none). A quasi-static step begins at rest, and
/// Newmark's average acceleration takes it a Δt²/4 far.
Real way_from_rest(Real acceleration, const Analysis& analysis, Index excavation) {
  Real way = 0, speed = 0;
  const auto dug = std::find_if(analysis.stages.begin(), analysis.stages.end(), [&](const auto& s) {
    return excavation > 0 && s.excavate == excavation;
  });
  for (auto at = dug == analysis.stages.end() ? analysis.stages.begin() : dug;
       at != analysis.stages.end(); ++at) {
    const AnalysisStage& stage = *at;
    const Real dt = stage.time_step, time = dt * stage.steps;
    if (stage.share_handed_on() == 0) {
      way += 0.25 * acceleration * dt * dt * stage.steps;
      speed = 0;
      continue;
    }
    way += speed * time + 0.5 * acceleration * time * time;
    speed += acceleration * time;
  }
  return way;
}

}  // namespace

bool has_other_loads(const Model& model) {
  return model.support->seismic_coefficient != Vec3{} && !model.analysis->is_seismic();
}

Reasons::Reasons(const RunReport& report)
    : report_(report), beside_loose_rock_(report.blocks.volume.size(), 0) {
  const BlockArrays& blocks = report.blocks;
  const auto loose = [&](Index b) {
    return !blocks.finite[b] && has_moved(report.run.courses[b].displacement, blocks.volume[b]);
  };
  for (const auto& shared : blocks.interfaces)
    for (int side = 0; side < 2; ++side)
      if (loose(shared.block[1 - side])) beside_loose_rock_[shared.block[side]] = 1;
}

Reason Reasons::of(const Confirmed& c) const {
  return c.seen == SeenMode::stays ? of_stay(c) : of_motion(c);
}

Reason Reasons::of_stay(const Confirmed& c) const {
  const auto& courses = report_.run.courses;
  if (std::any_of(c.members.begin(), c.members.end(), [&](Index b) { return courses[b].held; }))
    return Reason::held;
  Real mass = 0;
  for (const Index b : c.members) mass += report_.blocks.mass[b];
  const Real way =
      way_from_rest(c.key->sliding_force / mass, *report_.model.analysis, c.key->stage);
  if (!has_moved({way, 0, 0}, c.key->volume)) return Reason::time;
  if (c.key->batch > 1) return Reason::batch;
  if (other_loads()) return Reason::loads;
  if (report_.model.initial_stress.any) return Reason::in_situ_stress;
  return has_tensile_strength() ? Reason::strength : Reason::neighbours;
}

Reason Reasons::of_motion(const Confirmed& c) const {
  const auto beside = [&](Index b) { return beside_loose_rock_[b] != 0; };
  if (std::any_of(c.members.begin(), c.members.end(), beside)) return Reason::rock;
  if (c.is_held()) return Reason::support;
  const Index first = c.members.front();
  if (c.key ? c.key->batch > 1
            : report_.keyblocks->groups_left ||
                  report_.keyblocks->block_class[first] == BlockClass::not_examined)
    return Reason::batch;
  if (other_loads() || !report_.model.initial_velocities.empty()) return Reason::loads;
  if (report_.model.initial_stress.any) return Reason::in_situ_stress;
  return !c.key && slips_once_moved(first) ? Reason::strength : Reason::neighbours;
}

/// Of a block that stays: whether it would not on joints that have slipped.
bool Reasons::slips_once_moved(Index block) const {
  const auto& stable = report_.keyblocks->stable;
  return std::any_of(stable.begin(), stable.end(), [&](const Keyblock& key) {
    return key.block == block && key.residual_factor_of_safety < 1 && key.factor_of_safety >= 1;
  });
}

/// What acts in one of the two alone.
bool Reasons::other_loads() const {
  const Model& model = report_.model;
  return has_other_loads(model) || model.base_acceleration.has_value();
}

/// Which block theory does not count.
bool Reasons::has_tensile_strength() const {
  const auto& joints = report_.model.joint_materials;
  return std::any_of(joints.begin(), joints.end(),
                     [](const JointMaterial& joint) { return joint.tensile_strength > 0; });
}

}  // namespace rockfold
