#include "kernels/time/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/time/motion_kernel.hpp"

namespace rockfold {

using device::Field;

namespace motion {

MovingState make_moving_state(Index unknowns, Index fixed) {
  MovingState state;
  state.displacement = device::make_field("motion::displacement", unknowns);
  state.velocity = device::make_field("motion::velocity", unknowns);
  state.acceleration = device::make_field("motion::acceleration", unknowns);
  state.multiplier = device::make_field("motion::multiplier", fixed);
  state.reaction = device::make_field("motion::reaction", fixed);
  return state;
}

void copy_state(const MovingState& from, MovingState& to) {
  Kokkos::deep_copy(to.displacement, from.displacement);
  Kokkos::deep_copy(to.velocity, from.velocity);
  Kokkos::deep_copy(to.acceleration, from.acceleration);
  Kokkos::deep_copy(to.multiplier, from.multiplier);
  Kokkos::deep_copy(to.reaction, from.reaction);
  to.time = from.time;
  to.work = from.work;
  to.learned = from.learned;
  to.learned_in = from.learned_in;
  to.steps = from.steps;
  to.initial_energy = from.initial_energy;
}

std::vector<Vec3> uniform_field(Index unknowns, Index covers, const Vec3& v) {
  std::vector<Vec3> field(unknowns);
  std::fill(field.begin(), field.begin() + covers, v);  // the weights of the constants sum to one
  return field;
}

namespace {

void make_system(Motion::Data& m, const MotionSetup& setup) {
  m.held = solve::make_held_system(
      setup.covers,
      solve::build_operator(setup.covers, setup.moments, setup.materials, !setup.large),
      setup.fixed, setup.preconditioner, setup.direct);
  m.rock = setup.large ? make_finite_strain(setup, m.held) : make_small_strain(setup, m.held);
  m.supports = make_moving_supports(setup.fixed, m.held);
  m.dashpots = make_dashpots(setup.quiet, m.unknowns);
  if (!m.dashpots.any()) return;
  // Data stays where it is for as long as its motion lives.
  m.held.other = {[&m](const Field& x, const Field& y) {
                    m.rock->apply(m.held.combination, x, y);
                    add_dashpots(m.dashpots, m.dashpot_factor, x, y);
                  },
                  [&m](const solve::Blocks& d) {
                    m.rock->diagonal(m.held.combination, d);
                    add_dashpot_diagonal(m.dashpots, m.dashpot_factor, d);
                  }};
}

void make_loads(Motion::Data& m, const MotionSetup& setup) {
  m.load = device::make_field("motion::load", m.unknowns);
  // ∫ρ N dV is the mass matrix times the uniform field 1.
  const Field mass = device::make_field("motion::mass", m.unknowns);
  device::copy_to_device(uniform_field(m.unknowns, m.covers, {1, 1, 1}), m.work);
  m.rock->apply({0, 1}, m.work, mass);
  device::copy_to_device(constant_load(setup, device::copy_to_host(mass)), m.load);
  m.varying_loads = make_varying_loads(setup, mass);
  if (!m.varying_loads.any()) return;
  m.varying = device::make_field("motion::varying_load", m.unknowns);
  m.varying_before = device::make_field("motion::varying_load_before", m.unknowns);
}

void make_data(Motion::Data& m, const MotionSetup& setup) {
  m.unknowns = setup.covers.unknown_count();
  m.covers = setup.covers.cover_count();
  m.elements = setup.covers.element_count();
  m.gravity = setup.gravity;
  m.damping = setup.damping;
  m.beta = setup.beta;
  m.gamma = setup.gamma;
  m.dynamic_ratio = setup.dynamic_ratio;
  m.solver = setup.solver;
  make_system(m, setup);
  const Index fixed = m.held.springs.points.count;
  m.now = make_moving_state(m.unknowns, fixed);
  m.held.springs.multiplier = m.now.multiplier;  // one and the same array: saved with the state
  m.increment = device::make_field("motion::increment", m.unknowns);
  m.correction = device::make_field("motion::correction", m.unknowns);
  m.right = device::make_field("motion::right", m.unknowns);
  m.work = device::make_field("motion::work", m.unknowns);
  m.goal = device::make_field("motion::goal", fixed);
  m.support_way = device::make_field("motion::support_way", fixed);
  m.partial = device::allocate<Real>("motion::partial",
                                     3 * device::chunk_count(std::max(m.unknowns, fixed)));
  m.sums = device::Array<Real>("rockfold::motion::sums", 3);
  if (!m.rock->linear()) {
    m.velocity_before = device::make_field("motion::velocity_before", m.unknowns);
    m.acceleration_before = device::make_field("motion::acceleration_before", m.unknowns);
    m.following = make_following_pressures(setup);
    if (m.following.any())
      m.following_before = device::make_field("motion::following_before", m.unknowns);
    m.goal_before = device::make_field("motion::goal_before", fixed);
  }
  make_loads(m, setup);
  m.rock->force(m.now.displacement, m.work);
  m.initial_force = std::sqrt(solve::dot(m.held.work, m.work, m.work));
}

Real largest_motion(const solve::DevicePoints& points, const Field& x) {
  return device::largest(
      "rockfold::motion::largest_motion", points.count, KOKKOS_LAMBDA(const Index n) {
        Real square = 0;
        for (int d = 0; d < 3; ++d) {
          const Real u = solve::interpolate_one(points, n, d, x);
          square += u * u;
        }
        return device::math::sqrt(square);
      });
}

/// Numbers so large that energies overflow are no motion any more: not converged, residual NaN.
void require_finite(const Motion::Data& m, SolveReport& report) {
  constexpr Real most = 1e200;  // of squares
  if (solve::dot(m.held.work, m.now.displacement, m.now.displacement) < most &&
      solve::dot(m.held.work, m.now.acceleration, m.now.acceleration) < most)
    return;
  report.converged = false;
  report.residual = std::numeric_limits<Real>::quiet_NaN();
}

}  // namespace
}  // namespace motion

Motion::Motion(const MotionSetup& setup) : data_(std::make_unique<Data>()) {
  motion::make_data(*data_, setup);
}
Motion::~Motion() = default;
Motion::Motion(Motion&&) noexcept = default;
Motion& Motion::operator=(Motion&&) noexcept = default;

void Motion::set_motion(const StateArrays& state) {
  device::copy_to_device(state.displacement, data_->now.displacement);
  device::copy_to_device(state.velocity, data_->now.velocity);
  data_->now.time = state.time;
  data_->now.initial_energy = 0;
  const Energy e = energy();
  data_->now.initial_energy = e.kinetic + e.strain + e.potential;
}

SolveReport Motion::solve_static() {
  SolveReport report = motion::solve_equilibrium(*data_);
  motion::require_finite(*data_, report);
  return report;
}
SolveReport Motion::start(Real dt) {
  if (data_->dynamic_ratio == 0) return {};  // no acceleration is handed on
  return motion::solve_initial_acceleration(*data_, dt);
}

SolveReport Motion::step(Real dt, int substeps, const TrackedPoints* watched, Real limit) {
  Data& m = *data_;
  SolveReport total;
  m.largest_increment = 0;
  for (int i = 0; i < substeps; ++i) {
    // A quasi-static substep is a step of its own: nothing is handed on. The share of a velocity is taken once a step.
    m.handed = 1;
    if (i == 0 || m.dynamic_ratio == 0) motion::hand_on(m);
    SolveReport report = motion::take_step(m, dt / substeps);
    motion::require_finite(m, report);
    total.add(report);
    if (!total.converged) return total;
    if (!watched) continue;
    m.largest_increment =
        std::max(m.largest_increment, motion::largest_motion(watched->data().points, m.increment));
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
    m.saved = motion::make_moving_state(m.unknowns, m.held.springs.points.count);
  motion::copy_state(m.now, m.saved);
}

void Motion::restore() {
  motion::copy_state(data_->saved, data_->now);
  motion::set_time(*data_, data_->now.time);  // loads and supports too stand where they stood
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

}  // namespace rockfold
