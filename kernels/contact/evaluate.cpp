#include <utility>

#include "kernels/contact/contact_kernel.hpp"
#include "kernels/contact/point_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"

namespace rockfold::contact {

namespace {

/// Of four, over so many points.
void make_room_for_sums(DeviceContacts& c, Index points) {
  device::grow(c.partial, "contact::partial",
               4 * static_cast<std::size_t>(device::chunk_count(points)));
}

}  // namespace

ContactEnergy evaluate(DeviceContacts& c, const Motion& m, const Field& force,
                       const Tangents& tangent) {
  make_room_for_sums(c, c.current.count);
  const auto point = c.current.point;
  const auto laws = c.laws;
  const auto into = c.total;
  const Field start = c.before.x;
  const Real restitution = c.options.restitution;
  // elastic, friction, work of the contact on the rock, elastic before
  device::sum_then<4>(
      "rockfold::contact::evaluate", c.current.count, c.partial,
      KOKKOS_LAMBDA(const Index i, device::Sums<4>& sum) {
        const ContactPoint& p = point(i);
        const LocalMotion l = local_motion(p, m);
        const PointTraction t = traction_at(p, l, laws, restitution, m.dt);
        const Vector f = force_of(t, l, p.area);
        for (int d = 0; d < 3; ++d) force(i, d) = component(f, d);
        store_tangent(t, l, p.area, tangent, i);
        sum.value[0] += p.area * t.elastic;
        sum.value[1] += p.area * t.friction;
        sum.value[2] += dot(f, between(p, m.x) - between(p, start));
        sum.value[3] += p.area * elastic_energy(p, laws(p.law));
      },
      KOKKOS_LAMBDA(const device::Sums<4>& sum) {
        for (int k = 0; k < 4; ++k) into(k) = sum.value[k];
      });
  const std::vector<Real> sum = device::to_host(c.total);
  return {sum[0], sum[3], sum[1], sum[3] - sum[0] - sum[1] - sum[2]};
}

Index hold_reversed(DeviceContacts& c, const Motion& m, const Field& heading, const Field& held,
                    const Tangents& tangent) {
  const auto point = c.current.point;
  const auto laws = c.laws;
  const Real restitution = c.options.restitution;
  Index reversed = 0;
  Kokkos::parallel_reduce(
      "rockfold::contact::hold_reversed", device::Range(0, c.current.count),
      KOKKOS_LAMBDA(const Index i, Index& sum) {
        const ContactPoint& p = point(i);
        const LocalMotion l = local_motion(p, m);
        const PointTraction t = traction_at(p, l, laws, restitution, m.dt);
        Vector now{}, excess{};
        if (t.memory.state == Contact::slide) {
          now = -t.traction[1] * l.a - t.traction[2] * l.b;
          if (dot(now, at(heading, i)) < 0) {
            const PointTraction stuck = traction_at(p, l, laws, restitution, m.dt, true);
            excess = force_of(stuck, l, p.area) - force_of(t, l, p.area);
            store_tangent(stuck, l, p.area, tangent, i);
            now = {};
            ++sum;
          }
        }
        for (int d = 0; d < 3; ++d) {
          heading(i, d) = component(now, d);
          held(i, d) = component(excess, d);
        }
      },
      reversed);
  return reversed;
}

Index break_bonds(DeviceContacts& c, const Motion& m) {
  const PointSet now = c.current, accepted = c.accepted;
  const auto laws = c.laws;
  const Real restitution = c.options.restitution;
  Index broken = 0;
  Kokkos::parallel_reduce(
      "rockfold::contact::break_bonds", device::Range(0, now.pairs.count),
      KOKKOS_LAMBDA(const Index pair, Index& sum) {
        for (Index i = now.point_begin(pair); i < now.point_begin(pair + 1); ++i) {
          ContactPoint& p = now.point(i);
          const PointTraction t = traction_at(p, local_motion(p, m), laws, restitution, m.dt);
          if (!overloads_bonds(laws(p.law), p.memory, t)) continue;
          p.memory.broken = 1;
          ++sum;
          const Index old = find_pair(accepted.pairs, now.pairs.a(pair), now.pairs.b(pair));
          if (old == none) continue;
          for (Index j = accepted.point_begin(old); j < accepted.point_begin(old + 1); ++j)
            if (accepted.point(j).key == p.key) accepted.point(j).memory.broken = 1;
        }
      },
      broken);
  return broken;
}

EnergyGain find_largest_gain(DeviceContacts& c, const Motion& m) {
  const PointSet now = c.current, accepted = c.accepted;
  device::grow(c.gain, "contact::gain", now.pairs.count);
  const auto gain = c.gain;
  const auto laws = c.laws;
  const Field start = c.before.x;
  const Real restitution = c.options.restitution;
  device::for_each(
      "rockfold::contact::gain", now.pairs.count, KOKKOS_LAMBDA(const Index pair) {
        Real sum = 0;
        for (Index i = now.point_begin(pair); i < now.point_begin(pair + 1); ++i) {
          const ContactPoint& p = now.point(i);
          const LocalMotion l = local_motion(p, m);
          const PointTraction t = traction_at(p, l, laws, restitution, m.dt);
          const Vector way = between(p, m.x) - between(p, start);
          sum += p.area * (t.elastic + t.friction) + dot(force_of(t, l, p.area), way);
        }
        const Index old = find_pair(accepted.pairs, now.pairs.a(pair), now.pairs.b(pair));
        if (old != none)
          for (Index j = accepted.point_begin(old); j < accepted.point_begin(old + 1); ++j) {
            const ContactPoint& p = accepted.point(j);
            sum -= p.area * elastic_energy(p, laws(p.law));
          }
        gain(pair) = sum;
      });
  EnergyGain found;
  found.energy = device::largest(
      "rockfold::contact::largest_gain", now.pairs.count,
      KOKKOS_LAMBDA(const Index pair) { return gain(pair); });
  if (!(found.energy > 0)) return {};
  const Real most = found.energy;
  Index first = now.pairs.count;
  Kokkos::parallel_reduce(
      "rockfold::contact::first_gain", device::Range(0, now.pairs.count),
      KOKKOS_LAMBDA(const Index pair, Index& least) {
        if (gain(pair) == most && pair < least) least = pair;
      },
      Kokkos::Min<Index>(first));
  // A pair without points stores nothing, and gains nothing.
  const Index at = device::to_host(
      Array<Index>(Kokkos::subview(now.point_begin, std::pair<Index, Index>(first, first + 1))))[0];
  found.point = device::to_host(
      Array<ContactPoint>(Kokkos::subview(now.point, std::pair<Index, Index>(at, at + 1))))[0];
  return found;
}

Real impulse_of_impacts(DeviceContacts& c, const Motion& m) {
  make_room_for_sums(c, c.current.count);
  const auto point = c.current.point;
  const auto laws = c.laws;
  const auto into = c.total;
  const Real restitution = c.options.restitution;
  device::sum_then<1>(
      "rockfold::contact::impulse_of_impacts", c.current.count, c.partial,
      KOKKOS_LAMBDA(const Index i, device::Sums<1>& sum) {
        const ContactPoint& p = point(i);
        const LocalMotion l = local_motion(p, m);
        const Real open = p.memory.dilation;
        if (!p.memory.met || (l.motion.gap_before < open) == (l.motion.gap < open)) return;
        const PointTraction t = traction_at(p, l, laws, restitution, m.dt);
        sum.value[0] += m.dt * length(force_of(t, l, p.area));
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { into(0) = sum.value[0]; });
  return device::to_host(c.total)[0];
}

Real accept(DeviceContacts& c, const Motion& m) {
  make_room_for_sums(c, c.current.count);
  const auto point = c.current.point;
  const auto laws = c.laws;
  const auto met = c.met;
  const auto into = c.total;
  const Real restitution = c.options.restitution;
  device::sum_then<1>(
      "rockfold::contact::accept", c.current.count, c.partial,
      KOKKOS_LAMBDA(const Index i, device::Sums<1>& sum) {
        ContactPoint& p = point(i);
        p.memory = traction_at(p, local_motion(p, m), laws, restitution, m.dt).memory;
        note_surfaces(p, met);
        sum.value[0] += p.area * elastic_energy(p, laws(p.law));
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { into(0) = sum.value[0]; });
  set_pose(c.surfaces, m.x, c.before);
  if (m.speed_by_gap > 0)
    Kokkos::deep_copy(c.speed_before, m.v);
  else
    Kokkos::deep_copy(c.speed_before, 0.0);
  std::swap(c.accepted, c.current);
  c.detected = false;
  return device::to_host(c.total)[0];
}

Real stored_energy(DeviceContacts& c) {
  make_room_for_sums(c, c.accepted.count);
  const auto point = c.accepted.point;
  const auto laws = c.laws;
  const auto into = c.total;
  device::sum_then<1>(
      "rockfold::contact::stored_energy", c.accepted.count, c.partial,
      KOKKOS_LAMBDA(const Index i, device::Sums<1>& sum) {
        const ContactPoint& p = point(i);
        sum.value[0] += p.area * elastic_energy(p, laws(p.law));
      },
      KOKKOS_LAMBDA(const device::Sums<1>& sum) { into(0) = sum.value[0]; });
  return device::to_host(c.total)[0];
}

void scale_speeds(const DeviceContacts& c, Real share) {
  const Field v = c.speed_before;
  device::for_each(
      "rockfold::contact::scale_speeds", c.surfaces.vertices, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) v(n, d) *= share;
      });
}

}  // namespace rockfold::contact
