// Contact within a step.
//
// Its forces are those of the step's end, inside the middle rule of the rock: then their work only dissipates, whatever the step; the
// mean of both ends explodes. Newton's iteration is the open–close iteration: states, slip and impact follow from each trial motion. How
// far to go along a correction is measured by the work that unbalanced forces do along it (Crisfield 1991, §9.3): of an elastic joint
// that is the slope of the energy. Once forces are balanced the points are found again where blocks have come to: those that were
// missed are added, and the iteration goes on.
#include <algorithm>
#include <cmath>

#include "kernels/time/step_kernel.hpp"
#include "src/base/timer.hpp"
#include "src/base/vector.hpp"

namespace rockfold::motion {
namespace {

/// rad: where a normal turns by more, the step is too long.
constexpr Real most_turn = 10 * 3.14159265358979323846 / 180;
/// Share of the work along a correction at its start that may be left, either way, where it ends; trials to get there.
constexpr Real most_left = 0.5;
constexpr int most_trials = 8;
/// Of a correction, what is taken at least: one loose block that runs against another must not hold up all the rest. Where it then overlaps,
/// the next iteration knows.
constexpr Real least_share = 0.05;

void move_vertices(Motion::Data& m, const Step& step) {
  contact::set_motion(*m.contact, m.now.displacement, m.now.velocity, step.speed_by_gap, step.dt);
}

/// What is left of the forces, with those of the supports, times the correction, J.
Real work_along_correction(Motion::Data& m) {
  Real reference = 0;
  find_imbalance(m, reference);  // leaves the supports' forces in m.work
  return solve::dot(m.system.work, m.work, m.correction) +
         solve::dot(m.system.work, m.right, m.correction);
}

DetectReport detect(Motion::Data& m) {
  const Timer timer;
  const DetectReport found = contact::detect(*m.contact, m.system.contacts);
  if (!found.served) solve::contacts_changed(m.system);
  m.contact_seconds += timer.seconds();
  return found;
}

/// J: a step takes an impact in its middle. One at its start or end that changes a speed by Δv leaves a block Δv Δt/2 from where it should be, under
/// gravity. Where nothing rebounds that does not matter: the block stays.
Real misplaced_energy(Motion::Data& m, const Step& step) {
  if (!m.rebounds.any()) return 0;
  return 0.5 * step.dt * norm(m.gravity) *
         contact::impulse_of_impacts(m.contact->contacts, m.contact->motion);
}

}  // namespace

void begin_contact(Motion::Data& m) {
  if (m.contact->contacts.started) return;
  contact::set_motion(*m.contact, m.now.displacement, m.now.velocity, 1, 0);
  detect(m);
  m.now.contact_energy =
      contact::accept(m.contact->contacts, m.contact->motion);  // of the initial stress
  m.now.initial_energy += m.now.contact_energy;
}

void find_contacts(Motion::Data& m, const Step& step) {
  move_vertices(m, step);
  detect(m);
}

Real add_contact_forces(Motion::Data& m, const Step& step) {
  move_vertices(m, step);
  Kokkos::deep_copy(m.work, 0.0);
  contact::add_forces(*m.contact, m.system.contacts, step.middle ? 2 : 1, m.work);
  contact::add_force_sizes(*m.contact, m.system.contacts, step.middle ? 2 : 1, m.of_blocks.acting);
  const Field forces = m.work, right = m.right;
  device::for_each(
      "rockfold::motion::add_contact_forces", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) right(p, i) += forces(p, i);
      });
  return std::sqrt(solve::dot(m.system.work, forces, forces));
}

void hold_reversed(Motion::Data& m, const Step& step) {
  Kokkos::deep_copy(m.held, m.right);
  contact::hold_reversed(*m.contact, m.system.contacts, step.middle ? 2 : 1, m.held);
}

Forces correct_along_line(Motion::Data& m, const Step& step) {
  const Real start = work_along_correction(m);
  Forces forces;
  Real at = 0, left = 0;
  const auto go_to = [&](Real share) {
    correct(m, step, share - at);
    at = share;
    forces = find_residual(m, step);
    find_prescribed(m, step);
    left = work_along_correction(m);
  };
  go_to(1);
  if (!(start > 0) || left >= -most_left * start) return forces;
  // Beyond balance by much: back to it by false position (Illinois).
  Real low = 0, of_low = start, high = 1, of_high = left;
  for (int trial = 0; trial < most_trials && std::abs(left) > most_left * start; ++trial) {
    const Real before = left;
    const Real next = (low * of_high - high * of_low) / (of_high - of_low);
    go_to(std::max(next, least_share));
    if (next < least_share) break;
    const bool same_side = (left > 0) == (before > 0);
    if (left > 0) {
      low = at;
      of_low = left;
      if (same_side) of_high *= 0.5;
    } else {
      high = at;
      of_high = left;
      if (same_side) of_low *= 0.5;
    }
  }
  return forces;
}

bool misses_contacts(Motion::Data& m, const Step& step, SolveReport& report) {
  move_vertices(m, step);
  const contact::DeviceContacts& contacts = m.contact->contacts;
  // Points were looked for to a gap of `search_distance`: where no vertex has come further than half of it, no face has met another unseen.
  const bool near = contact::largest_shift(m.contact->motion.x, contacts.now.x) <=
                    0.5 * contacts.options.search_distance;
  const DetectReport found = detect(m);
  if (contact::largest_turn(contacts) > most_turn) report.converged = false;
  return report.converged && !near && found.missed > 0;
}

void end_contact(Motion::Data& m, const Step& step) {
  const ContactEnergy& energy = m.contact->energy;
  Work& work = m.now.work;
  work.friction += energy.friction;
  contact::DeviceContacts& contacts = m.contact->contacts;
  const bool gains = energy.impact + (m.now.contact_energy - energy.before) < 0;
  m.gain = gains ? contact::find_largest_gain(contacts, m.contact->motion) : EnergyGain{};
  m.crossing = step.stabilised ? contact::largest_crossing(contacts) : 0;
  const Real misplaced = step.stabilised ? misplaced_energy(m, step) : 0;
  const Real stored = contact::accept(contacts, m.contact->motion);
  // Points found anew, before the step and at its end, have other areas and planes than those whose forces worked: what they store more or
  // less is counted with the impacts.
  const Real lost =
      energy.impact + (m.now.contact_energy - energy.before) + (energy.elastic - stored);
  work.impact += lost;
  m.now.contact_energy = stored;
  const Real moving = kinetic_energy(m) + stored;
  const Real made = step.stabilised && lost < 0 ? -lost : 0;
  m.energy_made = moving > 0 ? std::max(made, misplaced) / moving : 0;
}

}  // namespace rockfold::motion
