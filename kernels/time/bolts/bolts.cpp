#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "kernels/time/bolts/chain_kernel.hpp"
#include "kernels/time/forces/stress_kernel.hpp"

namespace rockfold::bolts {
namespace {

/// Where the bolts' directions are at points of rock that d has displaced, and what their links have become.
void find_motions(const DeviceBolts& bolts, const Field& d) {
  const DeviceBolts all = bolts;
  device::for_each(
      "rockfold::bolts::axes", all.points, KOKKOS_LAMBDA(const Index n) {
        Index low = 0, high = all.bolts;  // its bolt: the last that begins no later
        while (high - low > 1) {
          const Index middle = (low + high) / 2;
          (all.point_begin(middle) <= n ? low : high) = middle;
        }
        const Real x[3] = {all.local(n, 0), all.local(n, 1), all.local(n, 2)};
        Real deformed[3][3];
        motion::gradient_at(all.elements, d, all.element(n), x, all.slopes.at(n), deformed);
        const Vector from = contact::at(all.direction, low);
        const Vector to = from + Vector{dot(contact::to_vector(deformed[0]), from),
                                        dot(contact::to_vector(deformed[1]), from),
                                        dot(contact::to_vector(deformed[2]), from)};
        const Vector axis = contact::unit(to);
        all.axis(n, 0) = axis.x;
        all.axis(n, 1) = axis.y;
        all.axis(n, 2) = axis.z;
      });
  device::for_each(
      "rockfold::bolts::motions", all.links, KOKKOS_LAMBDA(const Index l) {
        Real u[3];
        solve::interpolate_all(all.rows.points, l, d, u);
        for (int i = 0; i < 3; ++i) all.motion(l, i) = all.apart(l, i) + u[i];
      });
}

KOKKOS_INLINE_FUNCTION void put(const Field& to, Index n, const Vector& v) {
  to(n, 0) = v.x;
  to(n, 1) = v.y;
  to(n, 2) = v.z;
}

/// b += s · (v wᵀ + w vᵀ)/2, symmetric.
KOKKOS_INLINE_FUNCTION void add_product(const solve::Blocks& b, Index n, Real s, const Vector& v,
                                        const Vector& w) {
  const Real a[3] = {v.x, v.y, v.z}, c[3] = {w.x, w.y, w.z};
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      b(n, solve::symmetric_entry(i, j)) += 0.5 * s * (a[i] * c[j] + a[j] * c[i]);
}

/// What the rock gets from a link, and A_k and a_k of it.
KOKKOS_INLINE_FUNCTION void find_link(const DeviceBolts& all, const Chain& chain, Index l) {
  const Index link = chain.link + l, begin = all.steel_begin(link), end = all.steel_begin(link + 1);
  const LinkMotion m = motion_of(all, chain, l);
  const Real share = 1 / static_cast<Real>(end - begin);
  for (int i = 0; i < 6; ++i) all.tangent(link, i) = 0;
  if (all.crossing(link) == 0) {
    Real force = 0, stiffness = 0;
    for (Index p = begin; p < end; ++p) {
      force += share * all.work.axial(p);
      stiffness += share * share * all.work.tangent(p);
    }
    put(all.force, link, force * m.along);
    put(all.lead, link, m.along);
    add_product(all.tangent, link, stiffness, m.along, m.along);
    return;
  }
  const Index near = begin + chain.bolt;
  const Real e = m.stretch + all.next.slip(near + 1) - all.next.slip(near) - all.now.plastic(begin);
  const SteelForce f = steel_force(steel_of(all, chain, link, begin), e, m.shear);
  const Vector across = m.shear > 0 ? (1 / m.shear) * m.across : contact::any_across(m.along);
  const Vector third = contact::cross(m.along, across);
  put(all.force, link, f.axial * m.along + f.shear * across);
  put(all.lead, link, f.aa * m.along + f.as * across);
  add_product(all.tangent, link, f.aa, m.along, m.along);
  add_product(all.tangent, link, 2 * f.as, m.along, across);
  add_product(all.tangent, link, f.ss, across, across);
  const Real turning = m.shear > 0 ? f.shear / m.shear : f.ss;
  add_product(all.tangent, link, turning, third, third);
}

/// Row l of B into `right`: by how much the slips change what the link pulls with (over lead).
KOKKOS_INLINE_FUNCTION void find_row(const DeviceBolts& all, const Chain& chain, Index l,
                                     const Array<Real>& right) {
  for (Index n = chain.node; n < chain.node + chain.nodes; ++n) right(n) = 0;
  const Index link = chain.link + l, begin = all.steel_begin(link), end = all.steel_begin(link + 1);
  const Real share = 1 / static_cast<Real>(end - begin);
  for (Index p = begin; p < end; ++p) {
    const Real k = all.crossing(link) != 0 ? 1 : share * all.work.tangent(p);
    right(p + chain.bolt) -= k;
    right(p + chain.bolt + 1) += k;
  }
}

/// W of one bolt.
KOKKOS_INLINE_FUNCTION void find_couplings(const DeviceBolts& all, const Chain& chain) {
  const ChainWork& w = all.work;
  Real* const coupling = &all.coupling(all.coupling_begin(chain.bolt));
  for (Index l = 0; l < chain.links; ++l) {
    find_row(all, chain, l, w.residual);
    solve_chain(all, chain, w.residual, w.step, w.solution);
    for (Index k = 0; k < chain.links; ++k) {
      const Index link = chain.link + k, begin = all.steel_begin(link),
                  end = all.steel_begin(link + 1);
      const Real share = 1 / static_cast<Real>(end - begin);
      Real sum = 0;
      for (Index p = begin; p < end; ++p) {
        const Real stiffness = all.crossing(link) != 0 ? 1 : share * w.tangent(p);
        sum += stiffness * (w.step(p + chain.bolt + 1) - w.step(p + chain.bolt));
      }
      coupling[l * chain.links + k] = sum;
    }
  }
}

KOKKOS_INLINE_FUNCTION void hold_nothing(const DeviceBolts& all, const Chain& chain) {
  for (Index l = chain.link; l < chain.link + chain.links; ++l) {
    put(all.force, l, {});
    put(all.lead, l, {});
    for (int i = 0; i < 6; ++i) all.tangent(l, i) = 0;
  }
  Real* const coupling = &all.coupling(all.coupling_begin(chain.bolt));
  for (Index k = 0; k < chain.links * chain.links; ++k) coupling[k] = 0;
}

/// What has become of a bolt's links at the end of a step.
KOKKOS_INLINE_FUNCTION void accept_link(const DeviceBolts& all, const Chain& chain, Index l) {
  const Index link = chain.link + l, begin = all.steel_begin(link), end = all.steel_begin(link + 1);
  const LinkMotion m = motion_of(all, chain, l);
  const bool crossing = all.crossing(link) != 0;
  for (Index p = begin; p < end; ++p) {
    const Index near = p + chain.bolt;
    const Real total =
        m.stretch / static_cast<Real>(end - begin) + all.next.slip(near + 1) - all.next.slip(near);
    const Steel steel = steel_of(all, chain, link, p);
    const SteelForce f = steel_force(steel, total - all.now.plastic(p), m.shear);
    all.next.plastic(p) = all.now.plastic(p);
    all.next.used(p) = all.now.used(p) + f.used;
    all.next.broken(p) = all.now.broken(p);
    const Real k = f.axial < 0 ? steel.pushed * steel.along : steel.along;
    if (f.used > 0 && k > 0) all.next.plastic(p) = total - f.axial / k;
    all.next.cut(link) = all.now.cut(link);
    if (!crossing) continue;
    const Vector was = contact::at(all.now.axis, link);
    Vector sheared = turn_along(contact::at(all.now.sheared, link), was, m.along);
    if (m.shear > 0) {
      const bool doweled = steel.across > 0 && steel.shear > 0;
      const Real elastic = doweled ? f.shear / steel.across : 0;
      sheared = sheared + ((m.shear - elastic) / m.shear) * m.across;
      if (!doweled) all.next.cut(link) += m.shear;
    }
    put(all.next.sheared, link, sheared);
    put(all.next.axis, link, m.along);
  }
}

/// Of a bolt that does not act yet.
KOKKOS_INLINE_FUNCTION void keep_chain(const DeviceBolts& all, const Chain& chain) {
  const BoltState &now = all.now, &next = all.next;
  next.plate(chain.bolt) = now.plate(chain.bolt);
  next.peak(chain.bolt) = now.peak(chain.bolt);
  for (Index n = chain.node; n < chain.node + chain.nodes; ++n) {
    next.slip(n) = now.slip(n);
    next.slid(n) = now.slid(n);
  }
  for (Index p = chain.steel; p + 1 < chain.steel + chain.nodes; ++p) {
    next.plastic(p) = now.plastic(p);
    next.used(p) = now.used(p);
    next.broken(p) = now.broken(p);
  }
  for (Index l = chain.link; l < chain.link + chain.links; ++l) {
    next.cut(l) = now.cut(l);
    for (int i = 0; i < 3; ++i) {
      next.sheared(l, i) = now.sheared(l, i);
      next.axis(l, i) = now.axis(l, i);
    }
  }
}

/// Steel between places that hold it, which pulls with one force and yields anywhere: breaks where it has flowed most.
KOKKOS_INLINE_FUNCTION void break_steel(const DeviceBolts& all, const Chain& chain) {
  const BoltLaw& law = all.law(chain.bolt);
  const Index end = chain.steel + chain.nodes - 1;
  Index link = chain.link;  // of the piece looked at
  for (Index first = chain.steel; first < end;) {
    Index last = first, most = first;
    Real flow = 0, before = 0, length = 0, cut = 0;
    for (;; ++last) {
      while (all.steel_begin(link + 1) <= last) ++link;
      cut = math::fmax(cut, all.next.cut(link));
      flow += all.next.used(last);
      before += all.now.used(last);
      if (all.next.used(last) > all.next.used(most)) most = last;
      length += all.steel_length(last);
      const Index far = last + chain.bolt + 1;
      if (last + 1 == end || all.bond_to(far) > all.bond_from(far)) break;
    }
    if (flow > before && all.next.broken(most) == 0) {
      const Real moved = flow + math::fabs(all.work.axial(most)) / law.stiffness + cut;
      const bool breaks =
          law.rupture > 0 ? flow > law.rupture * length : moved >= (1 - 1e-9) * law.reach;
      if (breaks) all.next.broken(most) = 1;
    }
    first = last + 1;
  }
}

}  // namespace

MaterialPoints link_points(const BoltArrays& arrays) {
  MaterialPoints rows;
  const MaterialPoints& points = arrays.points;
  for (Index b = 0; b < arrays.count(); ++b)
    for (Index n = arrays.point_begin[b]; n + 1 < arrays.point_begin[b + 1]; ++n) {
      rows.element.push_back(points.element[n]);
      rows.local.push_back(points.local[n]);
      for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
        rows.unknown.push_back(points.unknown[i]);
        rows.weight.push_back(-points.weight[i]);
      }
      const Index own = rows.begin.back();
      for (Index i = points.begin[n + 1]; i < points.begin[n + 2]; ++i) {
        const auto from = rows.unknown.begin() + own;
        const auto same = std::find(from, rows.unknown.end(), points.unknown[i]);
        if (same == rows.unknown.end()) {
          rows.unknown.push_back(points.unknown[i]);
          rows.weight.push_back(points.weight[i]);
        } else {
          rows.weight[same - rows.unknown.begin()] += points.weight[i];
        }
      }
      rows.begin.push_back(static_cast<Index>(rows.unknown.size()));
    }
  return rows;
}

BoltState make_state(const DeviceBolts& bolts) {
  const auto numbers = [](Index n) { return Array<Real>("rockfold::bolts::state", n); };
  BoltState state;
  state.slip = numbers(bolts.nodes);
  state.slid = numbers(bolts.nodes);
  state.plate = numbers(bolts.bolts);
  state.plastic = numbers(bolts.steels);
  state.used = numbers(bolts.steels);
  state.cut = numbers(bolts.links);
  state.broken = numbers(bolts.steels);
  state.installed = numbers(bolts.bolts);
  state.peak = numbers(bolts.bolts);
  state.sheared = device::make_field("bolts::sheared", bolts.links);
  state.axis = device::make_field("bolts::axis", bolts.links);
  return state;
}

void copy_state(const BoltState& from, BoltState& to) {
  const auto a = from.arrays(), b = to.arrays();
  for (std::size_t i = 0; i < a.size(); ++i) Kokkos::deep_copy(b[i], a[i]);
  const auto c = from.fields(), d = to.fields();
  for (std::size_t i = 0; i < c.size(); ++i) Kokkos::deep_copy(d[i], c[i]);
}

DeviceBolts make_bolts(const BoltArrays& arrays, const CoverArrays& covers,
                       const PieceMoments& moments, const std::vector<ElasticMaterial>& materials) {
  DeviceBolts bolts;
  bolts.bolts = arrays.count();
  if (bolts.bolts == 0) return bolts;
  bolts.points = static_cast<Index>(arrays.points.size());
  bolts.links = bolts.points - bolts.bolts;
  bolts.nodes = arrays.node_begin.back();
  bolts.steels = bolts.nodes - bolts.bolts;
  bolts.rows = solve::make_point_rows(link_points(arrays), covers.unknown_count());
  bolts.element = device::to_device("bolts::element", arrays.points.element);
  const auto field = [](const char* label, const std::vector<Vec3>& values) {
    Field f = device::make_field(label, static_cast<Index>(values.size()));
    device::copy_to_device(values, f);
    return f;
  };
  bolts.local = field("bolts::local", arrays.points.local);
  bolts.slopes = solve::sampled_slopes(covers, arrays.points.element, arrays.points.local);
  bolts.elements = solve::make_element_table(covers, moments, materials);
  bolts.point_begin = device::to_device("bolts::point_begin", arrays.point_begin);
  bolts.node_begin = device::to_device("bolts::node_begin", arrays.node_begin);
  bolts.steel_begin = device::to_device("bolts::steel_begin", arrays.steel_begin);
  bolts.direction = field("bolts::direction", arrays.direction);
  std::vector<Vec3> apart;
  std::vector<std::uint8_t> crossing;
  std::vector<Real> steel_length;
  std::vector<Index> coupling_begin{0}, link_begin{0};
  for (Index b = 0; b < bolts.bolts; ++b) {
    const Index begin = arrays.point_begin[b], end = arrays.point_begin[b + 1] - 1;
    for (Index n = begin; n < end; ++n) {
      const Vec3 &from = arrays.place[n], &to = arrays.place[n + 1];
      apart.push_back({to[0] - from[0], to[1] - from[1], to[2] - from[2]});
      const Index l = n - b, pieces = arrays.steel_begin[l + 1] - arrays.steel_begin[l];
      crossing.push_back(arrays.link[l] == BoltLink::crossing ? 1 : 0);
      steel_length.insert(steel_length.end(), pieces,
                          arrays.link_length[l] / static_cast<Real>(pieces));
    }
    link_begin.push_back(end - b);
    coupling_begin.push_back(coupling_begin.back() + (end - begin) * (end - begin));
  }
  bolts.link_begin = device::to_device("bolts::link_begin", link_begin);
  bolts.apart = field("bolts::apart", apart);
  bolts.crossing = device::to_device("bolts::crossing", crossing);
  bolts.length = device::to_device("bolts::length", arrays.link_length);
  bolts.elastic_length = device::to_device("bolts::elastic_length", arrays.elastic_length);
  bolts.steel_length = device::to_device("bolts::steel_length", steel_length);
  bolts.dowel = device::to_device("bolts::dowel", arrays.dowel);
  bolts.toe = device::to_device("bolts::toe", arrays.toe);
  bolts.law = device::to_device("bolts::law", arrays.law);
  bolts.node_place = device::to_device("bolts::node_place", arrays.node_place);
  bolts.bond_from = device::to_device("bolts::bond_from", arrays.bond_from);
  bolts.bond_to = device::to_device("bolts::bond_to", arrays.bond_to);
  bolts.install = arrays.install;
  for (const BoltLaw& law : arrays.law)
    bolts.largest_strength = std::max(bolts.largest_strength, law.strength);
  bolts.node_element = arrays.node_element;
  bolts.now = make_state(bolts);
  bolts.next = make_state(bolts);
  bolts.axis = device::make_field("bolts::axis", bolts.points);
  bolts.motion = device::make_field("bolts::motion", bolts.links);
  bolts.force = device::make_field("bolts::force", bolts.links);
  bolts.lead = device::make_field("bolts::lead", bolts.links);
  bolts.tangent = solve::Blocks("rockfold::bolts::tangent", bolts.links);
  bolts.coupling_begin = device::to_device("bolts::coupling_begin", coupling_begin);
  bolts.coupling = Array<Real>("rockfold::bolts::coupling", coupling_begin.back());
  for (Array<Real>* of_nodes : {&bolts.work.diagonal, &bolts.work.off, &bolts.work.residual,
                                &bolts.work.step, &bolts.work.solution})
    *of_nodes = Array<Real>("rockfold::bolts::of_nodes", bolts.nodes);
  bolts.work.axial = Array<Real>("rockfold::bolts::axial", bolts.steels);
  bolts.work.tangent = Array<Real>("rockfold::bolts::tangent_of_steel", bolts.steels);
  return bolts;
}

void find_forces(const DeviceBolts& bolts, const Field& d, bool tangents) {
  if (!bolts.any()) return;
  find_motions(bolts, d);
  const DeviceBolts all = bolts;
  const Index work = 64;  // of a chain, at the least
  device::for_each(
      "rockfold::bolts::chains", all.bolts,
      KOKKOS_LAMBDA(const Index b) {
        const Chain chain = chain_of(all, b);
        if (all.now.installed(b) == 0) return hold_nothing(all, chain);
        balance_chain(all, chain);
        for (Index l = 0; l < chain.links; ++l) find_link(all, chain, l);
        if (tangents) find_couplings(all, chain);
      },
      work);
}

void add_forces(const DeviceBolts& bolts, Real scale, const Field& f) {
  if (bolts.any()) solve::scatter(bolts.rows, -scale, bolts.force, f);
}

Real rounding(const DeviceBolts& bolts) {
  return least_tangent * bolts.largest_strength;
}

void write_tangents(const DeviceBolts& bolts, solve::PointTerms& terms, Index first) {
  if (!bolts.any()) return;
  const DeviceBolts all = bolts;
  const auto tangent = terms.tangent;
  device::for_each(
      "rockfold::bolts::tangents", all.bolts, KOKKOS_LAMBDA(const Index b) {
        const Chain chain = chain_of(all, b);
        for (Index l = 0; l < chain.links; ++l) {
          const Index link = chain.link + l;
          const Real own = all.coupling(all.coupling_begin(b) + l * chain.links + l);
          for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) {
              const int at = solve::symmetric_entry(i, j);
              tangent(first + link, at) =
                  all.tangent(link, at) - own * all.lead(link, i) * all.lead(link, j);
            }
        }
      });
  terms.couplings = {first,        all.links, all.link_begin, all.bolts, all.coupling_begin,
                     all.coupling, all.lead};
}

void write_stiffest(const DeviceBolts& bolts, Real factor, const solve::PointTerms& terms,
                    Index first) {
  if (!bolts.any()) return;
  const DeviceBolts all = bolts;
  const auto tangent = terms.tangent;
  device::for_each(
      "rockfold::bolts::stiffest", all.bolts, KOKKOS_LAMBDA(const Index b) {
        const Chain chain = chain_of(all, b);
        for (Index l = 0; l < chain.links; ++l) {
          const Index link = chain.link + l;
          const BoltLaw& law = all.law(b);
          const Real bond = math::sqrt(law.section * law.bond_stiffness);
          const Real along = math::fmin(law.section / all.elastic_length(link),
                                        math::fmax(law.section / all.length(link), bond));
          const Real stiff = math::fmax(along, all.dowel(link));
          for (int i = 0; i < 6; ++i) tangent(first + link, i) = i < 3 ? factor * stiff : 0;
        }
      });
}

void clear_tangents(const DeviceBolts& bolts, solve::PointTerms& terms, Index first) {
  if (!bolts.any()) return;
  const auto tangent = terms.tangent;
  device::for_each(
      "rockfold::bolts::no_tangents", bolts.links, KOKKOS_LAMBDA(const Index l) {
        for (int i = 0; i < 6; ++i) tangent(first + l, i) = 0;
      });
  terms.couplings = {};
}

void accept(DeviceBolts& bolts) {
  if (!bolts.any()) return;
  const DeviceBolts all = bolts;
  Kokkos::deep_copy(all.next.installed, all.now.installed);
  device::for_each(
      "rockfold::bolts::accept", all.bolts, KOKKOS_LAMBDA(const Index b) {
        const Chain chain = chain_of(all, b);
        if (all.now.installed(b) == 0) return keep_chain(all, chain);
        all.next.plate(b) = all.now.plate(b);
        for (Index i = 0; i < chain.nodes; ++i) {
          const Hold hold = hold_of(all, chain, i, all.next.slip(chain.node + i));
          all.next.slid(chain.node + i) = hold.lost;
          if (i == 0) all.next.plate(b) = hold.plate_lost;
        }
        for (Index l = 0; l < chain.links; ++l) accept_link(all, chain, l);
        Real peak = all.now.peak(b);
        for (Index p = chain.steel; p + 1 < chain.steel + chain.nodes; ++p)
          peak = math::fmax(peak, all.work.axial(p));
        all.next.peak(b) = peak;
        break_steel(all, chain);
      });
  std::swap(bolts.now, bolts.next);
}

void install(DeviceBolts& bolts, Index stage, const Field& d) {
  if (std::find(bolts.install.begin(), bolts.install.end(), stage) == bolts.install.end()) return;
  find_motions(bolts, d);
  const DeviceBolts all = bolts;
  const Array<Index> when = device::to_device("bolts::install", bolts.install);
  device::for_each(
      "rockfold::bolts::install", all.bolts, KOKKOS_LAMBDA(const Index b) {
        if (when(b) != stage) return;
        const Chain chain = chain_of(all, b);
        all.now.installed(b) = 1;
        for (Index l = 0; l < chain.links; ++l) {
          const Index link = chain.link + l, begin = all.steel_begin(link),
                      end = all.steel_begin(link + 1);
          const LinkMotion m = motion_of(all, chain, l);
          for (Index p = begin; p < end; ++p)
            all.now.plastic(p) = m.stretch / static_cast<Real>(end - begin) -
                                 all.law(b).pretension / steel_of(all, chain, link, p).along;
          if (all.crossing(link) == 0) continue;
          const Vector way = contact::at(all.motion, link);
          put(all.now.sheared, link, way - dot(way, m.along) * m.along);
          put(all.now.axis, link, m.along);
        }
      });
}

void leave_out(DeviceBolts& bolts, const std::vector<std::uint8_t>& gone_element) {
  if (!bolts.any()) return;
  const std::vector<Index> begin = device::to_host(bolts.node_begin);
  std::vector<Real> from = device::to_host(bolts.bond_from), to = device::to_host(bolts.bond_to),
                    broken = device::to_host(bolts.now.broken);
  std::vector<BoltLaw> law = device::to_host(bolts.law);
  for (Index b = 0; b < bolts.bolts; ++b)
    for (Index n = begin[b]; n < begin[b + 1]; ++n) {
      if (bolts.node_element[n] == none || gone_element[bolts.node_element[n]] == 0) continue;
      to[n] = from[n];
      if (n == begin[b]) law[b].plate_strength = 0;
      if (n > begin[b]) broken[n - 1 - b] = 1;
      if (n + 1 < begin[b + 1]) broken[n - b] = 1;
    }
  Kokkos::deep_copy(bolts.bond_to, device::to_device("bolts::bond_to", to));
  Kokkos::deep_copy(bolts.now.broken, device::to_device("bolts::broken", broken));
  Kokkos::deep_copy(bolts.law, device::to_device("bolts::law", law));
}

std::vector<std::byte> bytes(const DeviceBolts& bolts) {
  std::vector<std::byte> all;
  const auto put_bytes = [&](const void* from, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(from);
    all.insert(all.end(), first, first + size);
  };
  for (const Array<Real>& array : bolts.now.arrays()) {
    const std::vector<Real> values = device::to_host(array);
    put_bytes(values.data(), values.size() * sizeof(Real));
  }
  for (const Field& field : bolts.now.fields()) {
    const std::vector<Vec3> values = device::copy_to_host(field);
    put_bytes(values.data(), values.size() * sizeof(Vec3));
  }
  return all;
}

void restore(DeviceBolts& bolts, std::span<const std::byte> bytes) {
  const auto take = [&](void* to, std::size_t size) {
    if (bytes.size() < size) throw std::invalid_argument("the bytes of bolts end early");
    if (size > 0) std::memcpy(to, bytes.data(), size);
    bytes = bytes.subspan(size);
  };
  for (const Array<Real>& array : bolts.now.arrays()) {
    std::vector<Real> values(array.extent(0));
    take(values.data(), values.size() * sizeof(Real));
    Kokkos::deep_copy(array, device::to_device("bolts::restored", values));
  }
  for (const Field& field : bolts.now.fields()) {
    std::vector<Vec3> values(field.extent(0));
    take(values.data(), values.size() * sizeof(Vec3));
    device::copy_to_device(values, field);
  }
  if (!bytes.empty()) throw std::invalid_argument("the bytes are those of other bolts");
}

BoltForces forces(const DeviceBolts& bolts, const Field& d) {
  BoltForces result;
  if (!bolts.any()) return result;
  find_forces(bolts, d, false);
  const DeviceBolts all = bolts;
  const Array<Real> shear("rockfold::bolts::shear", all.steels),
      plate("rockfold::bolts::plate", all.bolts);
  const Array<std::uint8_t> steel("rockfold::bolts::steel", all.steels),
      bond("rockfold::bolts::bond", all.nodes);
  device::for_each(
      "rockfold::bolts::states", all.bolts, KOKKOS_LAMBDA(const Index b) {
        const Chain chain = chain_of(all, b);
        const bool acts = all.now.installed(b) != 0;
        for (Index i = 0; acts && i < chain.nodes; ++i) {
          const Hold hold = hold_of(all, chain, i, all.next.slip(chain.node + i));
          const bool pulled_in = i == 0 && hold.plate_lost > 0;
          if (hold.slides || all.now.slid(chain.node + i) != 0 || pulled_in)
            bond(chain.node + i) = static_cast<std::uint8_t>(BoltStatus::slides);
          if (i == 0) plate(b) = hold.plate;
        }
        for (Index l = 0; acts && l < chain.links; ++l) {
          const Index link = chain.link + l;
          const LinkMotion m = motion_of(all, chain, l);
          for (Index p = all.steel_begin(link); p < all.steel_begin(link + 1); ++p) {
            if (all.now.broken(p) != 0) {
              steel(p) = static_cast<std::uint8_t>(BoltStatus::broken);
              continue;
            }
            const Vector f = contact::at(all.force, link);
            if (all.crossing(link) != 0) shear(p) = contact::length(f - dot(f, m.along) * m.along);
            if (all.now.used(p) > 0) steel(p) = static_cast<std::uint8_t>(BoltStatus::yields);
          }
        }
      });
  const auto status = [](const Array<std::uint8_t>& of) {
    std::vector<BoltStatus> statuses;
    for (const std::uint8_t s : device::to_host(of)) statuses.push_back(static_cast<BoltStatus>(s));
    return statuses;
  };
  for (const Real acts : device::to_host(all.now.installed))
    result.installed.push_back(acts != 0 ? 1 : 0);
  result.axial = device::to_host(all.work.axial);
  result.shear = device::to_host(shear);
  result.steel = status(steel);
  result.slip = device::to_host(all.next.slip);
  result.bond = status(bond);
  result.plate = device::to_host(plate);
  result.peak = device::to_host(all.now.peak);
  const std::vector<Index> begin = device::to_host(all.node_begin);
  for (Index b = 0; b < all.bolts; ++b)
    if (result.installed[b] == 0)
      for (Index p = begin[b] - b; p + b + 1 < begin[b + 1]; ++p) result.axial[p] = 0;
  return result;
}

}  // namespace rockfold::bolts
