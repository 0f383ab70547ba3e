// Rock that is excavated on the way. Its covers belong to no other block: their unknowns stay in the system, at rest in place, where the forces
// on them are left out.
#include <vector>

#include "kernels/time/step_kernel.hpp"

namespace rockfold {
namespace motion {
namespace {

/// Points that it was held at hold nothing.
void let_go(Motion::Data& m) {
  const solve::Springs s = m.system.springs;
  if (!s.any()) return;
  const auto gone = m.gone;
  const Field reaction = m.now.reaction;
  device::for_each(
      "rockfold::motion::let_go", s.points.count, KOKKOS_LAMBDA(const Index n) {
        const Index first = s.points.begin(n);
        if (first == s.points.begin(n + 1) || gone(s.points.unknown(first)) == 0) return;
        for (int d = 0; d < 3; ++d) {
          s.stiffness(n, d) = s.held(n, d) = s.multiplier(n, d) = 0;
          s.target(n, d) = reaction(n, d) = 0;
        }
      });
}

/// Those of all contact points as blocks are now, before anything of it goes.
void find_forces_at_rest(Motion::Data& m) {
  contact::set_motion(*m.contact, m.now.displacement, m.now.velocity, 0, 0);
  contact::detect(*m.contact, m.system.contacts);
  Kokkos::deep_copy(m.work, 0.0);
  contact::add_forces(*m.contact, m.system.contacts, 1, m.work);
}

/// N, on the covers of what stays: the forces of the points that it shares with what goes, as they are now.
void take_over_walls(Motion::Data& m) {
  contact::ContactTerm& term = *m.contact;
  contact::keep_wall_forces(term);
  if (m.system.contacts.any()) solve::scatter(m.system.contacts, 1, term.force, m.now.wall);
  leave_out_gone(m, m.now.wall);
}

/// J, of motion and all that is stored.
Real mechanical_energy(const Motion& motion) {
  const Energy e = motion.energy();
  return e.kinetic + e.strain + e.potential + e.contact;
}

}  // namespace

void leave_out_gone(const Motion::Data& m, const Field& x) {
  if (m.gone_element.empty()) return;
  const auto gone = m.gone;
  device::for_each(
      "rockfold::motion::leave_out_gone", m.unknowns, KOKKOS_LAMBDA(const Index p) {
        if (gone(p) != 0)
          for (int d = 0; d < 3; ++d) x(p, d) = 0;
      });
}

}  // namespace motion

void Motion::leave_out(const GoneRock& gone) {
  Data& m = *data_;
  std::vector<std::uint8_t> unknown;
  for (Index p = 0; p < m.unknowns; ++p) unknown.push_back(gone.cover[p % m.covers]);
  Kokkos::deep_copy(m.gone, device::to_device("motion::gone", unknown));
  m.gone_element = gone.element;
  motion::let_go(m);
  contact::set_gone(m.contact->contacts, gone.block);
  bolts::leave_out(m.bolts, gone.element);
}

void Motion::begin_release() {
  Data& m = *data_;
  const auto wall = m.now.wall;
  const Real left = m.now.walls;
  device::for_each(
      "rockfold::motion::begin_release", static_cast<Index>(wall.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) wall(p, d) *= left;
      });
  m.now.walls = 1;
}

Real Motion::walls() const {
  return data_->now.walls;
}

void Motion::set_walls(Real left) {
  data_->now.walls = left;
}

void Motion::excavate(const GoneRock& gone) {
  Data& m = *data_;
  const Real before = motion::mechanical_energy(*this);
  motion::find_forces_at_rest(m);
  leave_out(gone);
  begin_release();
  motion::take_over_walls(m);
  for (const device::Field& field : {m.now.displacement, m.now.velocity, m.now.acceleration})
    motion::leave_out_gone(m, field);
  contact::set_motion(*m.contact, m.now.displacement, m.now.velocity, 0, 0);
  contact::forget_gone(m.contact->contacts, m.contact->motion.x);
  m.now.contact_energy = contact::stored_energy(m.contact->contacts);
  m.now.work.excavated += before - motion::mechanical_energy(*this);
}

}  // namespace rockfold
