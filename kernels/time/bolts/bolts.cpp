#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "kernels/time/bolts/link_kernel.hpp"
#include "kernels/time/bolts/state_kernel.hpp"

namespace rockfold::bolts {

namespace {
/// Of a chain, at the least: device::for_each.
constexpr Index work_of_chain = 64;
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
  const DeviceBolts all = bolts;
  device::for_each(
      "rockfold::bolts::chains", all.bolts,
      KOKKOS_LAMBDA(const Index b) {
        const Chain chain = chain_of(all, b);
        if (all.now.installed(b) == 0) return hold_nothing(all, chain);
        pull_chain(all, chain, d);
        if (tangents) find_couplings(all, chain);
      },
      work_of_chain);
}

void begin_ticks(const DeviceBolts& bolts, const Field& d, Ticking& ticking) {
  find_forces(bolts, d, false);
  if (ticking.work.extent(0) == 0) {
    ticking.motion = device::make_field("bolts::motion_before", bolts.links);
    ticking.force = device::make_field("bolts::force_before", bolts.links);
    ticking.work = Array<Real>("rockfold::bolts::work", bolts.bolts);
  }
  Kokkos::deep_copy(ticking.motion, bolts.motion);
  Kokkos::deep_copy(ticking.force, bolts.force);
  Kokkos::deep_copy(ticking.work, 0.0);
}

void tick(const DeviceBolts& bolts, const Field& d, const Array<Index>& order, Index count,
          const Ticking& ticking) {
  const DeviceBolts all = bolts;
  const Field motion = ticking.motion, force = ticking.force;
  const Array<Real> work = ticking.work;
  device::for_each(
      "rockfold::bolts::tick", count,
      KOKKOS_LAMBDA(const Index i) {
        const Chain chain = chain_of(all, order(i));
        if (all.now.installed(chain.bolt) == 0) return;
        pull_chain(all, chain, d);
        Real done = 0;
        for (Index l = chain.link; l < chain.link + chain.links; ++l)
          for (int k = 0; k < 3; ++k) {
            done += 0.5 * (force(l, k) + all.force(l, k)) * (all.motion(l, k) - motion(l, k));
            force(l, k) = all.force(l, k);
            motion(l, k) = all.motion(l, k);
          }
        work(chain.bolt) += done;
        accept_chain(all, chain);
        copy_chain(all.next, all.now, chain);
      },
      work_of_chain);
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
        if (all.now.installed(b) == 0) return copy_chain(all.now, all.next, chain);
        accept_chain(all, chain);
      });
  std::swap(bolts.now, bolts.next);
}

void install(DeviceBolts& bolts, Index stage, const Field& d) {
  if (std::find(bolts.install.begin(), bolts.install.end(), stage) == bolts.install.end()) return;
  const DeviceBolts all = bolts;
  const Array<Index> when = device::to_device("bolts::install", bolts.install);
  device::for_each(
      "rockfold::bolts::install", all.bolts, KOKKOS_LAMBDA(const Index b) {
        if (when(b) != stage) return;
        const Chain chain = chain_of(all, b);
        all.now.installed(b) = 1;
        move_chain(all, chain, d);
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
