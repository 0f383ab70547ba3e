#include <algorithm>
#include <utility>

#include "kernels/constraints/constraints_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Stiffness by which points are tied, over what resists there: a pass leaves its inverse of a gap, and rounding takes as many digits.
constexpr Real tied_by = 1e6;

/// Likewise as preconditioners know it: between motions that points allow, forces are then known to a tenth, for which conjugate gradients
/// need a few iterations. With more, levels take many, and factors lose digits of what resists softly.
constexpr Real known_by = 10;

/// Passes that take off what points take, or bring them to their places: to the last digits, but for points that all but depend on each other.
constexpr int passes = 3;

/// Of the stiffest unknown of a point, what another one counts as at least: constants of a block by itself resist nothing.
constexpr Real softest = 1e-8;

/// f(d) for x, y and z at once, on the host.
template <class F>
void for_each_component(const F& f) {
  using Host = Kokkos::DefaultHostExecutionSpace;
  Kokkos::parallel_for("rockfold::solve::components",
                       Kokkos::RangePolicy<Host, Kokkos::Schedule<Kokkos::Dynamic>>(0, 3),
                       [&](int d) { f(d); });
  Host().fence();
}

/// The pattern of T: unknowns that share a point that acts, and the diagonal.
void analyse(const Constraints& c, TiedUnknowns& t, const std::vector<std::uint8_t>& acts) {
  const Index rows = static_cast<Index>(c.row_begin.size()) - 1;
  std::vector<Index> seen_by(rows, none);
  t.begin = {0};
  t.column.clear();
  for (Index i = 0; i < rows; ++i) {
    const std::size_t first = t.column.size();
    const auto meet = [&](Index j) {
      if (std::exchange(seen_by[j], i) != i) t.column.push_back(j);
    };
    meet(i);
    for (Index k = c.row_begin[i]; k < c.row_begin[i + 1]; ++k)
      if (const Index n = c.row_point[k]; acts[n] != 0)
        for (Index m = c.begin[n]; m < c.begin[n + 1]; ++m) meet(c.entry_row_host[m]);
    std::sort(t.column.begin() + static_cast<std::ptrdiff_t>(first), t.column.end());
    t.begin.push_back(static_cast<Index>(t.column.size()));
  }
  t.value.resize(t.column.size());
  t.factors = SparseCholesky(t.begin, t.column);
}

void factorise(const Constraints& c, TiedUnknowns& t, const std::vector<Real>& resists,
               const std::vector<Real>& stiffness) {
  std::vector<Real> sum(resists.size(), 0);
  for (std::size_t i = 0; i < resists.size(); ++i) {
    const Index first = t.begin[i], end = t.begin[i + 1];
    for (Index m = first; m < end; ++m) sum[t.column[m]] = 0;
    for (Index k = c.row_begin[i]; k < c.row_begin[i + 1]; ++k) {
      const Index n = c.row_point[k];
      if (!(stiffness[n] > 0)) continue;
      const Real of_row = c.row_weight[k] * stiffness[n];
      for (Index m = c.begin[n]; m < c.begin[n + 1]; ++m)
        sum[c.entry_row_host[m]] += of_row * c.entry_weight[m];
    }
    sum[i] += resists[i];
    for (Index m = first; m < end; ++m) t.value[m] = sum[t.column[m]];
  }
  t.factors.factorise(t.begin, t.column, t.value);
}

template <class HostField>
std::vector<Real> column(const HostField& field, int d) {
  std::vector<Real> of_component(field.extent(0));
  for (std::size_t t = 0; t < of_component.size(); ++t) of_component[t] = field(t, d);
  return of_component;
}

void make_current(Constraints& c) {
  if (c.current) return;
  c.current = true;
  const auto resists = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), c.resists),
             unknown = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), c.unknown);
  std::array<std::vector<Real>, 3> w, k;
  for (int d = 0; d < 3; ++d) {
    w[d] = column(resists, d);
    k[d] = column(unknown, d);
    c.matrix[d].components.clear();
    int like = 0;
    while (like < d && !(c.acts[like] == c.acts[d] && w[like] == w[d] && k[like] == k[d])) ++like;
    c.matrix[like].components.push_back(d);
  }
  for_each_component([&](int d) {
    if (c.matrix[d].components.empty()) return;
    if (c.matrix[d].begin.empty()) analyse(c, c.matrix[d], c.acts[d]);
    factorise(c, c.matrix[d], w[d], k[d]);
  });
}

/// part ← T⁻¹ part.
void solve(Constraints& c) {
  make_current(c);
  const auto host = Kokkos::create_mirror_view(c.part);
  Kokkos::deep_copy(host, c.part);
  for_each_component([&](int d) {
    Real* r[3];
    int columns = 0;
    for (const int of : c.matrix[d].components) r[columns++] = &host(0, of);
    if (columns > 0) c.matrix[d].factors.solve(r, columns);
  });
  Kokkos::deep_copy(c.part, host);
}

Index touched(const Constraints& c) {
  return static_cast<Index>(c.springs.row.extent(0));
}

/// part = x at the unknowns that points touch.
void gather(const Constraints& c, const Field& x) {
  const auto row = c.springs.row;
  const Field part = c.part;
  device::for_each(
      "rockfold::solve::gather", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (int d = 0; d < 3; ++d) part(t, d) = x(row(t), d);
      });
}

/// part = T⁻¹ Nᵀ value.
void follow_points(Constraints& c) {
  const Springs s = c.springs;
  const Field part = c.part, value = c.value;
  device::for_each(
      "rockfold::solve::pull_of_points", touched(c), KOKKOS_LAMBDA(const Index t) {
        Real sum[3] = {0, 0, 0};
        for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i)
          for (int d = 0; d < 3; ++d) sum[d] += s.row_weight(i) * value(s.row_point(i), d);
        for (int d = 0; d < 3; ++d) part(t, d) = sum[d];
      });
  solve(c);
}

/// x += part.
void add_part(const Constraints& c, const Field& x) {
  const auto row = c.springs.row;
  const Field part = c.part;
  device::for_each(
      "rockfold::solve::add_part", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (int d = 0; d < 3; ++d) x(row(t), d) += part(t, d);
      });
}

/// value = K N x of points tied, added to the multipliers; x of an entry stands at at(entry).
void take(const Constraints& c, const Field& stiffness, const Array<Index>& at, const Field& x) {
  const Springs s = c.springs;
  const Field value = c.value;
  device::for_each(
      "rockfold::solve::take", s.points.count, KOKKOS_LAMBDA(const Index n) {
        Real u[3] = {0, 0, 0};
        for (Index i = s.points.begin(n); i < s.points.begin(n + 1); ++i)
          for (int d = 0; d < 3; ++d) u[d] += s.points.weight(i) * x(at(i), d);
        for (int d = 0; d < 3; ++d) {
          value(n, d) = s.tied(n, d) > 0 ? stiffness(n, d) * u[d] : 0;
          s.multiplier(n, d) += value(n, d);
        }
      });
}

/// left = W⁻¹ part where points touch, r elsewhere; part is kept.
void take_off_forces(const Constraints& c, const Field& r) {
  const auto row = c.springs.row;
  const Field part = c.part, kept = c.kept, left = c.left, resists = c.resists;
  Kokkos::deep_copy(left, r);
  device::for_each(
      "rockfold::solve::take_off_forces", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (int d = 0; d < 3; ++d) {
          kept(t, d) = part(t, d);
          left(row(t), d) = resists(t, d) * part(t, d);
        }
      });
}

/// part = W⁻¹ z + NᵀKN T⁻¹ r, with T⁻¹ r as it was kept.
void add_motion_of_points(const Constraints& c, const Field& r, const Field& z) {
  const auto row = c.springs.row;
  const Field part = c.part, kept = c.kept, resists = c.resists;
  device::for_each(
      "rockfold::solve::add_motion_of_points", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (int d = 0; d < 3; ++d)
          part(t, d) = r(row(t), d) + resists(t, d) * (z(row(t), d) - kept(t, d));
      });
}

/// x = part where points touch.
void replace_part(const Constraints& c, const Field& x) {
  const auto row = c.springs.row;
  const Field part = c.part;
  device::for_each(
      "rockfold::solve::replace_part", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (int d = 0; d < 3; ++d) x(row(t), d) = part(t, d);
      });
}

/// The same for all components, which then share T where points tie them alike.
KOKKOS_INLINE_FUNCTION Real stiffest_way(const Blocks& diagonal, Index u) {
  return device::math::fmax(diagonal(u, 0), device::math::fmax(diagonal(u, 1), diagonal(u, 2)));
}

/// W⁻¹ = resists: the geometric mean with the stiffest beside an unknown, for points are kept by what is stiff, not by slivers.
void find_what_resists(const Constraints& c, const Blocks& diagonal, const Field& resists) {
  const Springs s = c.springs;
  const Field stiffest = c.value;
  device::for_each(
      "rockfold::solve::stiffest", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) {
          Real most = 0;
          for (Index i = s.points.begin(n); i < s.points.begin(n + 1); ++i)
            if (s.points.weight(i) != 0)
              most = device::math::fmax(most, stiffest_way(diagonal, s.points.unknown(i)));
          stiffest(n, d) = most;
        }
      });
  device::for_each(
      "rockfold::solve::resists", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (int d = 0; d < 3; ++d) {
          const Real a = stiffest_way(diagonal, s.row(t));
          Real most = a;
          for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i)
            most = device::math::fmax(most, stiffest(s.row_point(i), d));
          const Real least = device::math::fmax(a, softest * most);
          resists(t, d) = least > 0 ? device::math::sqrt(least) * device::math::sqrt(most) : 1;
        }
      });
}

/// Of what ties the points, what is known, up to known_by of what resists there (c.value), and what is not; W⁻¹ gets what is known.
void share_out(Constraints& c) {
  c.current = false;
  const Springs s = c.springs;
  const Field there = c.value, known = c.known, unknown = c.unknown, resists = c.resists;
  device::for_each(
      "rockfold::solve::known", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) {
          known(n, d) = device::math::fmin(s.tie(n, d), known_by * there(n, d));
          unknown(n, d) = s.tie(n, d) - known(n, d);
        }
      });
  device::for_each(
      "rockfold::solve::resists_as_known", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i)
          for (int d = 0; d < 3; ++d)
            resists(t, d) += s.row_weight(i) * s.row_weight(i) * known(s.row_point(i), d);
      });
}

}  // namespace

Constraints make_constraints(Springs springs, Index unknowns) {
  Constraints c;
  c.springs = std::move(springs);
  const Springs& s = c.springs;
  if (!s.any()) return c;
  c.any_held = largest_entry(s.held) > 0;
  c.value = device::make_field("solve::constraint_value", s.points.count);
  c.left = device::make_field("solve::constraint_left", unknowns);
  c.part = device::make_field("solve::constraint_part", touched(c));
  c.kept = device::make_field("solve::constraint_kept", touched(c));
  c.begin = device::to_host(s.points.begin);
  c.entry_weight = device::to_host(s.points.weight);
  c.row_begin = device::to_host(s.row_begin);
  c.row_point = device::to_host(s.row_point);
  c.row_weight = device::to_host(s.row_weight);
  const std::vector<Index> entry = device::to_host(s.row_entry);
  c.entry_row_host.resize(entry.size());
  for (std::size_t t = 0; t + 1 < c.row_begin.size(); ++t)
    for (Index k = c.row_begin[t]; k < c.row_begin[t + 1]; ++k)
      c.entry_row_host[entry[k]] = static_cast<Index>(t);
  c.entry_row = device::to_device("solve::entry_row", c.entry_row_host);
  const auto held = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.held),
             stiffness = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.stiffness);
  c.known = device::make_field("solve::known_stiffness", s.points.count);
  c.unknown = device::make_field("solve::unknown_stiffness", s.points.count);
  c.resists = device::make_field("solve::resists", touched(c));
  for (int d = 0; d < 3; ++d)
    for (Index n = 0; n < s.points.count; ++n)
      c.acts[d].push_back(held(n, d) > 0 || stiffness(n, d) > 0 ? 1 : 0);
  return c;
}

void set_ties(Constraints& c, const Blocks& diagonal, Real spring_factor) {
  if (!c.springs.any()) return;
  c.spring_factor = spring_factor;
  find_what_resists(c, diagonal, c.resists);
  const Springs s = c.springs;
  const Field resists = c.resists, there = c.value;
  const auto row = c.entry_row;
  device::for_each(
      "rockfold::solve::ties", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) {
          Real yields = 0;  // m/N
          for (Index i = s.points.begin(n); i < s.points.begin(n + 1); ++i)
            yields += s.points.weight(i) * s.points.weight(i) / resists(row(i), d);
          there(n, d) = yields > 0 ? 1 / yields : 0;
          const Real given = spring_factor * s.stiffness(n, d);
          s.tied(n, d) = s.held(n, d) > 0 || given > tied_by * there(n, d) ? 1 : 0;
          s.tie(n, d) = s.tied(n, d) > 0 ? tied_by * there(n, d) : given;
        }
      });
  c.any_tied = largest_entry(s.tied) > 0;
  share_out(c);
}

void take_off_multipliers(Constraints& c, const Field& r) {
  if (!c.any_tied) return;
  scatter(c.springs, -1, c.springs.multiplier, r);
  for (int pass = 0; pass < passes; ++pass) {
    gather(c, r);
    solve(c);
    take(c, c.unknown, c.entry_row, c.part);
    scatter(c.springs, -1, c.value, r);
  }
}

void close_gaps(Constraints& c, const Field& prescribed, const Field& x) {
  if (!c.any_tied) return;
  const Springs s = c.springs;
  const Field value = c.value, unknown = c.unknown;
  const Real factor = c.spring_factor;
  for (int pass = 0; pass < passes; ++pass) {
    device::for_each(
        "rockfold::solve::pulls", s.points.count, KOKKOS_LAMBDA(const Index n) {
          for (int d = 0; d < 3; ++d) {
            value(n, d) = s.tied(n, d) > 0 ? unknown(n, d) * (prescribed(n, d) +
                                                              stretch_of_tied(s, n, d, factor) -
                                                              interpolate_one(s.points, n, d, x))
                                           : 0;
          }
        });
    follow_points(c);
    add_part(c, x);
  }
}

void place_exactly(const Constraints& c, const Field& prescribed, const Field& x) {
  if (!c.any_held) return;
  const Springs s = c.springs;
  device::for_each(
      "rockfold::solve::place_exactly", touched(c), KOKKOS_LAMBDA(const Index t) {
        for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i) {
          const Index n = s.row_point(i);
          if (s.points.begin(n + 1) - s.points.begin(n) > 1) continue;
          for (int d = 0; d < 3; ++d)
            if (s.held(n, d) > 0) x(s.row(t), d) = prescribed(n, d) / s.row_weight(i);
        }
      });
}

void add_multipliers_of(Constraints& c, const Field& x) {
  if (c.any_tied) take(c, c.springs.tie, c.springs.points.unknown, x);
}

void hold_points(Constraints& c, const Field& x) {
  if (!c.any_held) return;
  Kokkos::deep_copy(c.springs.multiplier, 0.0);
  close_gaps(c, device::make_field("solve::at_rest", c.springs.points.count), x);
}

ApplyInverse with_constraints(Constraints& c, ApplyInverse b, const KrylovWork& work) {
  if (!c.springs.any()) return b;
  return [&c, work, b = std::move(b)](const Field& r, const Field& z, const Array<Real>& energy) {
    gather(c, r);
    solve(c);
    take_off_forces(c, r);
    b(c.left, z, energy);
    add_motion_of_points(c, r, z);
    solve(c);
    replace_part(c, z);
    dot_on_device(work, r, z, energy);
  };
}

}  // namespace rockfold::solve
