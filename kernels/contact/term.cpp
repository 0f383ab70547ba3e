#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/contact/term_kernel.hpp"

namespace rockfold::contact {

using device::grow;

ContactTerm make_contact_term(const SurfaceArrays& surfaces, const MaterialPoints& points,
                              const ContactOptions& options) {
  ContactTerm term;
  term.contacts = make_contacts(surfaces, options);
  term.vertex = solve::upload(points);
  Vec3 low{}, high{};
  if (!surfaces.vertex.empty()) low = high = surfaces.vertex[0];
  for (const Vec3& x : surfaces.vertex)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  term.contacts.options.initial_stress.reference_z -= 0.5 * (low[2] + high[2]);
  std::vector<Vec3> home = surfaces.vertex;
  for (Vec3& x : home)
    for (int d = 0; d < 3; ++d) x[d] -= 0.5 * (low[d] + high[d]);
  const Index vertices = surfaces.vertex_count();
  term.home = device::make_field("contact::home", vertices);
  device::copy_to_device(home, term.home);
  term.motion.x = device::make_field("contact::place", vertices);
  term.motion.v = device::make_field("contact::speed", vertices);
  return term;
}

solve::PointTerms make_contact_rows(Index unknowns) {
  solve::PointTerms rows;
  rows.row = device::allocate<Index>("contact::row", unknowns);
  rows.row_begin = Array<Index>("rockfold::contact::row_begin", unknowns + 1);
  const auto row = rows.row;
  device::for_each(
      "rockfold::contact::rows", unknowns, KOKKOS_LAMBDA(const Index p) { row(p) = p; });
  return rows;
}

void set_motion(ContactTerm& term, const Field& d, const Field& v, Real speed_by_gap, Real dt) {
  term.motion.speed_by_gap = speed_by_gap;
  term.motion.dt = dt;
  const solve::DevicePoints points = term.vertex;
  const Field home = term.home, x = term.motion.x, speed = term.motion.v;
  const bool moving = speed_by_gap > 0;
  device::for_each(
      "rockfold::contact::move", points.count,
      KOKKOS_LAMBDA(const Index n) {
        Real u[3] = {0, 0, 0}, w[3] = {0, 0, 0};
        for (Index i = points.begin(n); i < points.begin(n + 1); ++i)
          for (int k = 0; k < 3; ++k) {
            u[k] += points.weight(i) * d(points.unknown(i), k);
            if (moving) w[k] += points.weight(i) * v(points.unknown(i), k);
          }
        for (int k = 0; k < 3; ++k) {
          x(n, k) = home(n, k) + u[k];
          speed(n, k) = w[k];
        }
      },
      16);
}

namespace {

/// Room for the lists of all points as they are before merging.
void stage_lists(ContactTerm& term, Index count) {
  grow(term.staged_begin, "contact::staged_begin", count + 1);
  const auto begin = term.staged_begin;
  const auto point = term.contacts.current.point;
  const solve::DevicePoints vertex = term.vertex;
  device::for_each(
      "rockfold::contact::list_lengths", count, KOKKOS_LAMBDA(const Index c) {
        Index sum = 0;
        for (int k = 0; k < 6; ++k) {
          const Index v = point(c).vertex[k];
          if (point(c).weight[k] != 0) sum += vertex.begin(v + 1) - vertex.begin(v);
        }
        begin(c) = sum;
      });
  const Index total = to_offsets(begin, count);
  grow(term.staged_unknown, "contact::staged_unknown", total);
  grow(term.staged_weight, "contact::staged_weight", total);
}

/// The functions of each point, each once; length(c) of them.
void merge_lists(const ContactTerm& term, Index count, const Array<Index>& length) {
  const auto begin = term.staged_begin, unknown = term.staged_unknown;
  const auto weight = term.staged_weight;
  const auto point = term.contacts.current.point;
  const solve::DevicePoints vertex = term.vertex;
  device::for_each(
      "rockfold::contact::merge_lists", count,
      KOKKOS_LAMBDA(const Index c) {
        const Index first = begin(c);
        Index end = first;
        for (int k = 0; k < 6; ++k) {
          const Real w = point(c).weight[k];
          const Index v = point(c).vertex[k];
          if (w == 0) continue;
          for (Index i = vertex.begin(v); i < vertex.begin(v + 1); ++i) {
            Index at = first;
            while (at < end && unknown(at) != vertex.unknown(i)) ++at;
            if (at == end) {
              unknown(at) = vertex.unknown(i);
              weight(at) = 0;
              ++end;
            }
            weight(at) += w * vertex.weight(i);
          }
        }
        length(c) = end - first;
      },
      16);
}

/// The same without the room between, and the point of each entry.
void store_lists(const ContactTerm& term, Index count, solve::PointTerms& rows) {
  const auto from = term.staged_begin, staged_unknown = term.staged_unknown;
  const auto staged_weight = term.staged_weight;
  const auto begin = rows.points.begin, unknown = rows.points.unknown, owner = term.owner;
  const auto weight = rows.points.weight;
  device::for_each(
      "rockfold::contact::store_lists", count,
      KOKKOS_LAMBDA(const Index c) {
        Index at = from(c);
        for (Index i = begin(c); i < begin(c + 1); ++i, ++at) {
          unknown(i) = staged_unknown(at);
          weight(i) = staged_weight(at);
          owner(i) = c;
        }
      },
      8);
}

/// Which entries act on an unknown, ascending.
void transpose(ContactTerm& term, Index entries, solve::PointTerms& rows) {
  SortedKeys& sorted = term.transposed;
  reserve(sorted, entries);
  const auto key = sorted.key;
  const auto value = sorted.value;
  const auto unknown = rows.points.unknown;
  device::for_each(
      "rockfold::contact::entry_keys", entries, KOKKOS_LAMBDA(const Index i) {
        key(i) = static_cast<std::uint64_t>(unknown(i));
        value(i) = i;
      });
  const Index unknowns = static_cast<Index>(rows.row.extent(0));
  int bits = 0;
  while (bits < 31 && (Index{1} << bits) < unknowns) ++bits;
  sort(sorted, entries, bits);
  grow(rows.row_point, "contact::row_point", entries);
  grow(rows.row_weight, "contact::row_weight", entries);
  const auto sorted_key = sorted.key;
  const auto entry = sorted.value, owner = term.owner, row_point = rows.row_point,
             row_begin = rows.row_begin;
  const auto weight = rows.points.weight, row_weight = rows.row_weight;
  device::for_each(
      "rockfold::contact::row_entries", entries, KOKKOS_LAMBDA(const Index i) {
        row_point(i) = owner(entry(i));
        row_weight(i) = weight(entry(i));
      });
  device::for_each(
      "rockfold::contact::row_begins", unknowns + 1, KOKKOS_LAMBDA(const Index p) {
        row_begin(p) = lower_bound(sorted_key, entries, static_cast<std::uint64_t>(p));
      });
}

void grow_points(ContactTerm& term, Index count, solve::PointTerms& rows) {
  grow(rows.points.begin, "contact::point_begin", count + 1);
  if (static_cast<Index>(rows.force.extent(0)) >= count) return;
  const Index room = count + count / 2;
  rows.tangent = solve::Blocks("rockfold::contact::row_tangent", room);
  rows.whole = Tangents("rockfold::contact::row_whole", room);
  rows.force = device::make_field("contact::row_force", room);
  term.force = device::make_field("contact::force", room);
  term.tangent = Tangents("rockfold::contact::tangent", room);
  term.heading = device::make_field("contact::heading", room);
  term.held = device::make_field("contact::held", room);
}

}  // namespace

DetectReport detect(ContactTerm& term, solve::PointTerms& rows) {
  DetectReport report = detect(term.contacts, term.motion.x);
  const PointSet& points = term.contacts.current;
  report.served = points.detection == term.rows_of;
  if (report.served) return report;
  term.rows_of = points.detection;
  const Index count = points.count;
  rows.points.count = count;
  grow_points(term, count, rows);
  stage_lists(term, count);
  merge_lists(term, count, rows.points.begin);
  const Index entries = to_offsets(rows.points.begin, count);
  grow(rows.points.unknown, "contact::unknown", entries);
  grow(rows.points.weight, "contact::weight", entries);
  grow(term.owner, "contact::owner", entries);
  store_lists(term, count, rows);
  transpose(term, entries, rows);
  return report;
}

void add_forces(ContactTerm& term, const solve::PointTerms& rows, Real scale, const Field& f) {
  term.energy = evaluate(term.contacts, term.motion, term.force, term.tangent);
  if (rows.any()) solve::scatter(rows, scale, term.force, f);
}

void add_force_sizes(const ContactTerm& term, const solve::PointTerms& rows, Real scale,
                     const Array<Real>& acting) {
  if (!rows.any()) return;
  const Field force = term.force;
  const auto row = rows.row, row_begin = rows.row_begin, row_point = rows.row_point;
  const auto row_weight = rows.row_weight;
  device::for_each(
      "rockfold::contact::force_sizes", static_cast<Index>(row.extent(0)),
      KOKKOS_LAMBDA(const Index r) {
        Real sum = 0;
        for (Index i = row_begin(r); i < row_begin(r + 1); ++i)
          sum += math::fabs(row_weight(i)) * length(at(force, row_point(i)));
        acting(row(r)) += scale * sum;
      },
      16);
}

void forget_headings(ContactTerm& term) {
  Kokkos::deep_copy(term.heading, 0.0);
}

Index hold_reversed(ContactTerm& term, const solve::PointTerms& rows, Real scale, const Field& f) {
  const Index reversed =
      hold_reversed(term.contacts, term.motion, term.heading, term.held, term.tangent);
  if (reversed > 0) solve::scatter(rows, scale, term.held, f);
  return reversed;
}

bool write_tangents(const ContactTerm& term, Real factor, solve::PointTerms& rows) {
  const auto from = term.tangent, whole = rows.whole;
  const auto part = rows.tangent;
  const auto point = term.contacts.current.point;
  const Real skew = device::largest(
      "rockfold::contact::write_tangents", rows.points.count, KOKKOS_LAMBDA(const Index c) {
        Real d[3][3], dn[3], nd[3], ndn = 0, most = 0;
        const Real* n = point(c).normal;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) whole(c, 3 * i + j) = d[i][j] = factor * from(c, 3 * i + j);
        for (int i = 0; i < 3; ++i) {
          dn[i] = nd[i] = 0;
          for (int j = 0; j < 3; ++j) {
            dn[i] += d[i][j] * n[j];
            nd[i] += n[j] * d[j][i];
            most = math::fmax(most, math::fabs(d[i][j] - d[j][i]));
          }
          ndn += n[i] * dn[i];
        }
        // Without what couples normal and shear: that is not symmetric where it slides, the rest is, and resists.
        for (int i = 0; i < 3; ++i)
          for (int j = i; j < 3; ++j)
            part(c, solve::symmetric_entry(i, j)) =
                0.5 * (d[i][j] + d[j][i]) -
                0.5 * (n[i] * (nd[j] + dn[j]) + n[j] * (nd[i] + dn[i])) + 2 * n[i] * n[j] * ndn;
        return most > 0 ? most / math::fmax(ndn, most) : 0;
      });
  return skew < 1e-12;  // of frames that are turned
}

bool clear_tangents(const solve::PointTerms& rows) {
  Kokkos::deep_copy(rows.whole, 0.0);
  Kokkos::deep_copy(rows.tangent, 0.0);
  return true;
}

Real rounding(const ContactTerm& term) {
  const auto point = term.contacts.current.point;
  const auto laws = term.contacts.laws;
  const Field x = term.motion.x;
  const Real largest = device::largest(
      "rockfold::contact::rounding", term.contacts.current.count, KOKKOS_LAMBDA(const Index c) {
        const ContactPoint& p = point(c);
        return p.area * laws(p.law).normal_stiffness * length(at(x, p.vertex[0]));
      });
  constexpr Real roundings = 4;  // of places, frames, gaps and tractions, one after the other
  return roundings * std::numeric_limits<Real>::epsilon() * largest *
         std::sqrt(static_cast<Real>(term.contacts.current.count));
}

}  // namespace rockfold::contact
