#include "src/run/records/recorder.hpp"

#include "src/base/vector.hpp"
#include "src/model/openings.hpp"
#include "src/run/contact_setup.hpp"
#include "src/run/records/block_stress.hpp"
#include "src/run/records/contact_samples.hpp"
#include "src/run/records/nodal_stress.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

Recorder::Recorder(const RunInput& input, const PieceMoments& moments, const StoreState& store,
                   RunResult& result)
    : input_(input),
      moments_(moments),
      store_(store),
      result_(result),
      monitors_(input.monitors),
      base_(base_acceleration(input.model)),
      every_(input.model.output.every) {
  for (const Monitor& monitor : input.model.monitors) {
    if (!monitor.is_of_rock()) continue;
    const std::size_t n = result_.monitors.size();
    MonitorHistory& history = result_.monitors.emplace_back();
    history.name = monitor.name;
    history.material = material_of(input.covers, input.monitors.element[n]);
  }
  if (excavates_on_the_way(input.model)) gone_.resize(input.blocks.block_count());
  if (input.bolts) bolts_.emplace(*input.bolts);
  if (!input.contact) return;
  laws_ = contact_options(input.model, input.blocks).laws;
  joints_.emplace(input, laws_, result.joint_monitors);
  courses_.emplace(input, moments, laws_, result.courses);
}

void Recorder::count_from(std::vector<Vec3> displacement) {
  zero_ = std::move(displacement);
  zero_of_monitors_.clear();
  for (std::size_t n = 0; n < input_.monitors.size(); ++n)
    zero_of_monitors_.push_back(interpolate(input_.monitors, n, zero_));
}

void Recorder::leave_out(const GoneRock& gone) {
  gone_ = gone.block;
  if (zero_.empty()) return;
  for (std::size_t p = 0; p < zero_.size(); ++p)
    if (gone.cover[p % gone.cover.size()] != 0) zero_[p] = {};
  count_from(std::move(zero_));
}

std::vector<Vec3> Recorder::counted(std::vector<Vec3> displacement) const {
  for (std::size_t p = 0; p < zero_.size(); ++p) displacement[p] = displacement[p] - zero_[p];
  return displacement;
}

void Recorder::record(const Motion& motion, Index step, bool last) {
  const Timer timer;
  record_monitors(motion);
  if (joints_) joints_->record(motion);
  if (courses_) courses_->look(motion);
  if (bolts_) bolts_->look(motion);
  result_.energy_time.push_back(motion.time());
  result_.energies.push_back(motion.energy());
  result_.seconds.output += timer.seconds();
  if (step == 0 || last || (every_ > 0 && step % every_ == 0)) store(motion, step);
}

void Recorder::find_support(const Motion& motion, RunResult& result) const {
  if (!bolts_) return;
  result.bolts = bolts_->at_end(motion);
  result.shotcrete = bolts_->shotcrete_at_end(motion);
}

std::vector<ContactSample> Recorder::contacts(const Motion& motion) const {
  return contact_samples(input_, laws_, motion.contact_points(), motion.state().displacement);
}

void Recorder::store(const Motion& motion, Index step) {
  if (stored_ == step || !store_) return;
  const Timer timer;
  StoredState state{step, motion.state(), motion.element_stress(), {}, {}, {}, gone_, {}};
  state.motion.displacement = counted(std::move(state.motion.displacement));
  if (input_.contact) state.contacts = contacts(motion);
  if (bolts_) state.bolts = bolts_->lines(motion, state.motion.displacement);
  state.block_stress = average_block_stress(input_.covers, moments_, state.element_stress,
                                            input_.blocks.block_count());
  if (input_.mesh)
    state.nodal_stress = stress_is_uniform(input_.covers, input_.model.initial_stress)
                             ? average_nodal_stress(*input_.mesh, state.element_stress)
                             : average_nodal_stress(input_.covers, *input_.mesh, motion);
  store_(state);
  stored_ = step;
  ++states_;
  result_.seconds.output += timer.seconds();
}

void Recorder::pass(Archive& archive) {
  archive.all(stored_, states_, zero_);
  base_.pass(archive);
  if (!archive.packs() && !zero_.empty()) count_from(std::move(zero_));
  if (joints_) joints_->pass(archive);
  if (courses_) courses_->pass(archive);
  if (bolts_) bolts_->pass(archive);
}

BaseMotion Recorder::base_motion(const Motion& motion) {
  const Real dt = motion.mean_over();
  const Vec3 before = base_.at(motion.time() - dt).velocity;
  BaseMotion base = base_.at(motion.time());
  if (dt > 0) base.acceleration = (1 / dt) * (base.velocity - before);
  return base;
}

void Recorder::record_monitors(const Motion& motion) {
  if (result_.monitors.empty()) return;
  if (input_.model.base_acceleration) result_.base.push_back(base_motion(motion));
  const PointMotion at = motion.at(monitors_);
  for (std::size_t n = 0; n < result_.monitors.size(); ++n) {
    MonitorHistory& history = result_.monitors[n];
    history.time.push_back(motion.time());
    history.displacement.push_back(zero_.empty() ? at.displacement[n]
                                                 : at.displacement[n] - zero_of_monitors_[n]);
    history.velocity.push_back(at.velocity[n]);
    history.acceleration.push_back(at.acceleration[n]);
    history.stress.push_back(at.stress[n]);
  }
}

}  // namespace rockfold
