#include "kernels/update/motion.hpp"

#include <algorithm>
#include <utility>

#include "kernels/update/motion_kernel.hpp"

namespace rockfold {

using device::Field;

namespace update {

MovingState make_moving_state(Index covers, Index fixed) {
  MovingState state;
  state.displacement = device::make_field("update::displacement", covers);
  state.velocity = device::make_field("update::velocity", covers);
  state.acceleration = device::make_field("update::acceleration", covers);
  state.multiplier = device::make_field("update::multiplier", fixed);
  state.reaction = device::make_field("update::reaction", fixed);
  return state;
}

void copy_state(const MovingState& from, MovingState& to) {
  Kokkos::deep_copy(to.displacement, from.displacement);
  Kokkos::deep_copy(to.velocity, from.velocity);
  Kokkos::deep_copy(to.acceleration, from.acceleration);
  Kokkos::deep_copy(to.multiplier, from.multiplier);
  Kokkos::deep_copy(to.reaction, from.reaction);
  to.time = from.time;
  to.support_work = from.support_work;
  to.steps = from.steps;
}

namespace {

Motion::Data make_data(const MotionSetup& setup) {
  const Index covers = setup.covers.cover_count();
  Motion::Data m;
  m.held = solve::make_held_system(
      setup.covers, solve::build_operator(setup.covers, setup.moments, setup.materials),
      setup.fixed);
  const Index fixed = m.held.springs.points.count;
  m.elements = make_element_table(setup.covers, setup.materials);
  m.now = make_moving_state(covers, fixed);
  m.held.springs.multiplier = m.now.multiplier;  // one and the same array: saved with the state
  m.load = device::make_field("update::load", covers);
  m.increment = device::make_field("update::increment", covers);
  m.right = device::make_field("update::right", covers);
  m.work = device::make_field("update::work", covers);
  m.goal = device::make_field("update::goal", fixed);
  m.partial =
      device::allocate<Real>("update::partial", 2 * device::chunk_count(std::max(covers, fixed)));
  m.sums = device::Array<Real>("rockfold::update::sums", 2);
  m.gravity = setup.gravity;
  m.beta = setup.beta;
  m.gamma = setup.gamma;
  m.dynamic_ratio = setup.dynamic_ratio;
  m.solver = setup.solver;
  make_load(m, setup);
  return m;
}

Real largest_motion(const solve::DevicePoints& points, const Field& x) {
  return device::largest(
      "rockfold::update::largest_motion", points.count, KOKKOS_LAMBDA(const Index n) {
        Real square = 0;
        for (int d = 0; d < 3; ++d) {
          const Real u = solve::interpolate_one(points, n, d, x);
          square += u * u;
        }
        return device::math::sqrt(square);
      });
}

}  // namespace
}  // namespace update

Motion::Motion(const MotionSetup& setup) : data_(new Data(update::make_data(setup))) {}
Motion::~Motion() = default;
Motion::Motion(Motion&&) noexcept = default;
Motion& Motion::operator=(Motion&&) noexcept = default;

void Motion::set_motion(const StateArrays& state) {
  device::copy_to_device(state.displacement, data_->now.displacement);
  device::copy_to_device(state.velocity, data_->now.velocity);
  data_->now.time = state.time;
  data_->initial_energy = 0;
  const Energy e = energy();
  data_->initial_energy = e.kinetic + e.strain + e.potential;
}

SolveReport Motion::solve_static() {
  return update::solve_equilibrium(*data_);
}
SolveReport Motion::start(Real dt) {
  if (data_->dynamic_ratio == 0) return {};  // no acceleration is handed on
  return update::solve_initial_acceleration(*data_, dt);
}

SolveReport Motion::step(Real dt, int substeps, const TrackedPoints* watched, Real limit) {
  Data& m = *data_;
  SolveReport total;
  m.largest_increment = 0;
  for (int i = 0; i < substeps; ++i) {
    // A quasi-static substep is a step of its own: nothing is handed on. The share of a velocity is taken once a step.
    if (i == 0 || m.dynamic_ratio == 0) update::hand_on(m);
    const SolveReport report = update::advance(m, dt / substeps);
    total.iterations += report.iterations;
    total.outer += report.outer;
    total.residual = report.residual;
    total.gap = report.gap;
    total.converged = report.converged;
    if (!total.converged) return total;
    if (!watched) continue;
    m.largest_increment =
        std::max(m.largest_increment, update::largest_motion(watched->data().points, m.increment));
    if (m.largest_increment > limit) return total;
  }
  return total;
}

Real Motion::largest_increment() const {
  return data_->largest_increment;
}

void Motion::save() {
  Data& m = *data_;
  if (m.saved.displacement.extent(0) == 0)
    m.saved = update::make_moving_state(m.held.op.covers, m.held.springs.points.count);
  update::copy_state(m.now, m.saved);
}

void Motion::restore() {
  update::copy_state(data_->saved, data_->now);
}

Real Motion::time() const {
  return data_->now.time;
}

StateArrays Motion::state() const {
  const auto& now = data_->now;
  return {now.time, device::copy_to_host(now.displacement), device::copy_to_host(now.velocity),
          device::copy_to_host(now.acceleration)};
}

std::vector<Vec3> Motion::reactions() const {
  return data_->held.shares.share_out(device::copy_to_host(data_->now.reaction));
}

Energy Motion::energy() const {
  const Data& m = *data_;
  Energy e;
  solve::apply(m.held.op, {0, 1}, m.now.velocity, m.work);
  e.kinetic = 0.5 * solve::dot(m.held.work, m.now.velocity, m.work);
  solve::apply(m.held.op, {1, 0}, m.now.displacement, m.work);
  e.strain = 0.5 * solve::dot(m.held.work, m.now.displacement, m.work);
  e.potential = -solve::dot(m.held.work, m.load, m.now.displacement);
  e.dissipated = m.now.support_work - (e.kinetic + e.strain + e.potential - m.initial_energy);
  return e;
}

}  // namespace rockfold
