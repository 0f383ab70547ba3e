#include "kernels/time/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "kernels/time/step_kernel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

using device::Field;

namespace motion {

MovingState make_moving_state(Index unknowns, Index fixed, bool walls) {
  MovingState state;
  state.displacement = device::make_field("motion::displacement", unknowns);
  state.velocity = device::make_field("motion::velocity", unknowns);
  state.acceleration = device::make_field("motion::acceleration", unknowns);
  state.reaction = device::make_field("motion::reaction", fixed);
  state.wall = device::make_field("motion::wall", walls ? unknowns : 0);
  return state;
}

void copy_state(const MovingState& from, MovingState& to) {
  static_cast<StateNumbers&>(to) = from;
  const auto of_from = from.fields(), of_to = to.fields();
  for (std::size_t i = 0; i < of_to.size(); ++i) Kokkos::deep_copy(of_to[i], of_from[i]);
}

std::vector<Vec3> uniform_field(Index unknowns, Index covers, const Vec3& v) {
  std::vector<Vec3> field(unknowns);
  std::fill(field.begin(), field.begin() + covers, v);  // the weights of the constants sum to one
  return field;
}

namespace {

/// Points of terms beside those of the supports: dashpots, then the links of bolts.
MaterialPoints other_terms(const MotionSetup& setup) {
  MaterialPoints points = setup.quiet.points;
  if (setup.bolts) solve::append_points(points, bolts::link_points(*setup.bolts));
  return points;
}

void make_system(Motion::Data& m, const MotionSetup& setup) {
  m.system = solve::make_constrained_system(
      setup.covers,
      solve::build_operator(setup.covers, setup.moments, setup.materials, !setup.large),
      setup.fixed, setup.preconditioner, setup.direct, other_terms(setup));
  m.first_link = m.system.springs.points.count + static_cast<Index>(setup.quiet.points.size());
  if (setup.bolts)
    m.bolts = bolts::make_bolts(*setup.bolts, setup.covers, setup.moments, setup.materials);
  if (m.bolts.any()) m.bolts_before = device::make_field("motion::bolts_before", m.unknowns);
  if (setup.surfaces) {
    m.contact = std::make_unique<contact::ContactTerm>(
        contact::make_contact_term(*setup.surfaces, setup.surface_points, setup.contact));
    m.system.has_contacts = true;
    m.held = device::make_field("motion::held", m.unknowns);
    m.of_blocks = make_block_forces(setup.covers);
    m.system.contacts = contact::make_contact_rows(m.unknowns);
    m.system.bicgstab = solve::make_bicgstab_work(m.unknowns);
    m.most_iterations = setup.contact_iterations;
    if (setup.large && setup.contact.restitution > 0)
      m.rebounds = make_rebounds(setup, m.of_blocks);
  }
  m.rock = setup.large ? make_finite_strain(setup, m.system) : make_small_strain(setup, m.system);
  m.supports = make_moving_supports(setup.fixed, m.system);
  m.dashpots = make_dashpots(setup.quiet, m.unknowns);
}

void make_loads(Motion::Data& m, const MotionSetup& setup) {
  m.load = device::make_field("motion::load", m.unknowns);
  // ∫ρ N dV is the mass matrix times the uniform field 1.
  const Field mass = device::make_field("motion::mass", m.unknowns);
  device::copy_to_device(uniform_field(m.unknowns, m.covers, {1, 1, 1}), m.work);
  m.rock->apply({0, 1}, m.work, mass);
  const std::vector<Vec3> load = constant_load(setup, device::copy_to_host(mass));
  device::copy_to_device(load, m.load);
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
  m.solver = setup.solver;
  make_system(m, setup);
  const Index fixed = m.system.springs.points.count;
  m.now = make_moving_state(m.unknowns, fixed, m.contact != nullptr);
  m.now.dynamic_ratio = setup.dynamic_ratio;
  m.increment = device::make_field("motion::increment", m.unknowns);
  m.gone = device::Array<std::uint8_t>("rockfold::motion::gone", m.unknowns);
  m.correction = device::make_field("motion::correction", m.unknowns);
  m.right = device::make_field("motion::right", m.unknowns);
  m.work = device::make_field("motion::work", m.unknowns);
  if (m.system.springs.any()) m.left = device::make_field("motion::left", m.unknowns);
  m.prescribed = device::make_field("motion::prescribed", fixed);
  m.support_way = device::make_field("motion::support_way", fixed);
  m.partial = device::allocate<Real>("motion::partial",
                                     3 * device::chunk_count(std::max(m.unknowns, fixed)));
  m.sums = device::Array<Real>("rockfold::motion::sums", 3);
  m.velocity_before = device::make_field("motion::velocity_before", m.unknowns);
  m.acceleration_before = device::make_field("motion::acceleration_before", m.unknowns);
  m.stretch_before = device::make_field("motion::stretch_before", fixed);
  if (!m.rock->linear()) {
    m.following = make_following_pressures(setup);
    if (m.following.any())
      m.following_before = device::make_field("motion::following_before", m.unknowns);
  }
  make_loads(m, setup);
  m.rock->force(m.now.displacement, m.work);
  m.initial_force = std::sqrt(solve::dot(m.system.work, m.work, m.work));
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
  if (solve::dot(m.system.work, m.now.displacement, m.now.displacement) < most &&
      solve::dot(m.system.work, m.now.acceleration, m.now.acceleration) < most)
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
void Motion::begin_stage(Real dynamic_ratio) {
  motion::begin_stage(*data_, dynamic_ratio);
}
SolveReport Motion::start(Real dt) {
  if (data_->contact) motion::begin_contact(*data_);
  if (data_->now.dynamic_ratio == 0) return {};  // no acceleration is handed on
  const SolveReport report = motion::solve_initial_acceleration(*data_, dt);
  for (const Field& field : {data_->now.velocity, data_->now.acceleration})
    motion::leave_out_gone(*data_, field);
  return report;
}

SolveReport Motion::step(Real dt, bool first, const TrackedPoints* watched,
                         const StepCourse& course) {
  Data& m = *data_;
  m.handed = 1;
  if (first || m.now.dynamic_ratio == 0) motion::hand_on(m);
  SolveReport report = course.by_substeps ? motion::take_explicit_step(m, dt, course)
                                          : motion::take_step(m, dt, course);
  motion::require_finite(m, report);
  if (watched && report.converged)
    m.largest_increment = motion::largest_motion(watched->data().points, m.increment);
  return report;
}

Real Motion::substep_visits(Real dt, Real mass_scaling) {
  save();
  const Real visits = motion::count_substep_visits(*data_, dt, mass_scaling);
  restore();
  return visits;
}
Real Motion::largest_increment() const {
  return data_->largest_increment;
}
Real Motion::energy_made() const {
  return data_->energy_made;
}
Real Motion::crossing() const {
  return data_->crossing;
}
const EnergyGain& Motion::largest_gain() const {
  return data_->gain;
}

void Motion::save() {
  Data& m = *data_;
  if (m.saved.displacement.extent(0) == 0)
    m.saved =
        motion::make_moving_state(m.unknowns, m.system.springs.points.count, m.contact != nullptr);
  motion::copy_state(m.now, m.saved);
  if (m.contact) contact::keep(m.contact->contacts, m.saved_contacts);
  m.saved_water = m.following.water;
  if (!m.bolts.any()) return;
  if (m.saved_bolts.slip.extent(0) == 0) m.saved_bolts = bolts::make_state(m.bolts);
  bolts::copy_state(m.bolts.now, m.saved_bolts);
}

void Motion::restore() {
  motion::copy_state(data_->saved, data_->now);
  if (data_->contact) contact::restore(data_->contact->contacts, data_->saved_contacts);
  data_->following.water = data_->following.water_at_end = data_->saved_water;
  if (data_->bolts.any()) bolts::copy_state(data_->saved_bolts, data_->bolts.now);
  motion::set_time(*data_, data_->now.time);  // loads and supports too stand where they stood
}

void Motion::set_water(const CoverArrays& covers, const LoadPoints& water) {
  motion::set_water(data_->following, covers, water);
}
void Motion::set_water_now(const CoverArrays& covers, const LoadPoints& water) {
  set_water(covers, water);
  data_->following.water = data_->following.water_at_end;
}
void Motion::set_water_shares(const std::vector<Real>& share) {
  data_->following.share = device::to_device("motion::water_share", share);
}

void Motion::install_bolts(Index stage) {
  bolts::install(data_->bolts, stage, data_->now.displacement);
}
BoltForces Motion::bolt_forces() const {
  return bolts::forces(data_->bolts, data_->now.displacement);
}

std::vector<ContactPoint> Motion::contact_points() const {
  return data_->contact ? contact::points(data_->contact->contacts) : std::vector<ContactPoint>{};
}

ContactCount Motion::contact_count() const {
  return data_->contact ? contact::count_states(data_->contact->contacts) : ContactCount{};
}

std::vector<std::uint8_t> Motion::surfaces_that_met() const {
  return data_->contact ? contact::surfaces_that_met(data_->contact->contacts)
                        : std::vector<std::uint8_t>{};
}

double Motion::contact_seconds() const {
  return data_->contact_seconds;
}

Index Motion::most_unbalanced_cover() const {
  Real reference = 0;
  motion::find_imbalance(*data_, reference);
  const auto right = device::copy_to_host(data_->right),
             supports = device::copy_to_host(data_->work);
  Index worst = none;
  Real most = 0;
  for (Index p = 0; p < data_->covers; ++p) {
    const Real left = norm(right[p] + supports[p]);
    if (!(left > most)) continue;
    most = left;
    worst = p;
  }
  return worst;
}

Real Motion::time() const {
  return data_->now.time;
}
Real Motion::mean_over() const {
  return data_->mean_over;
}

StateArrays Motion::state() const {
  const auto& now = data_->now;
  return {now.time, device::copy_to_host(now.displacement), device::copy_to_host(now.velocity),
          device::copy_to_host(now.acceleration)};
}

std::vector<Vec3> Motion::reactions() const {
  return data_->system.shares.share_out(device::copy_to_host(data_->now.reaction));
}

}  // namespace rockfold
