#include <cmath>

#include "kernels/contact/detection/broad_phase_kernel.hpp"

namespace rockfold::contact {

namespace {

/// Bits of a cell's number in each direction, and of a level's. Cells are no smaller than the whole over 2^18.
constexpr int cell_bits = 19, level_bits = 5, last_level = 20;

/// The grids: level l has cells of edge size · 2^l.
struct Grids {
  Vector origin;
  Real size = 1;

  KOKKOS_INLINE_FUNCTION Real edge(Index level) const {
    Real e = size;
    for (Index l = 0; l < level; ++l) e *= 2;
    return e;
  }
  KOKKOS_INLINE_FUNCTION std::int64_t cell(Real x, Real from, Real edge_length) const {
    return static_cast<std::int64_t>(math::floor((x - from) / edge_length));
  }
};

KOKKOS_INLINE_FUNCTION std::uint64_t cell_key(Index level, std::int64_t x, std::int64_t y,
                                              std::int64_t z) {
  return ((static_cast<std::uint64_t>(level) << cell_bits | static_cast<std::uint64_t>(z))
              << cell_bits |
          static_cast<std::uint64_t>(y))
             << cell_bits |
         static_cast<std::uint64_t>(x);
}

void find_boxes(const Surfaces& s, const Field& from, const Field& to, Real margin,
                const BroadPhase& w) {
  const auto low = w.low, high = w.high;
  device::for_each(
      "rockfold::contact::boxes", s.parts,
      KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) {
          const Index first = s.part_vertex(s.part_vertex_begin(p));
          Real least = from(first, d), most = least;
          for (Index i = s.part_vertex_begin(p); i < s.part_vertex_begin(p + 1); ++i) {
            const Index v = s.part_vertex(i);
            least = math::fmin(least, math::fmin(from(v, d), to(v, d)));
            most = math::fmax(most, math::fmax(from(v, d), to(v, d)));
          }
          low(p, d) = least - margin;
          high(p, d) = most + margin;
        }
      },
      16);
}

/// The largest f(i); of numbers that may all be negative.
template <class F>
Real maximum(Index n, const F& f) {
  Real most = 0;
  Kokkos::parallel_reduce(
      "rockfold::contact::maximum", device::Range(0, n),
      KOKKOS_LAMBDA(const Index i, Real& found) {
        const Real value = f(i);
        if (value > found) found = value;
      },
      Kokkos::Max<Real>(most));
  return most;
}

KOKKOS_INLINE_FUNCTION Real extent_of(const Field& low, const Field& high, Index p) {
  return math::fmax(high(p, 0) - low(p, 0),
                    math::fmax(high(p, 1) - low(p, 1), high(p, 2) - low(p, 2)));
}

Grids choose_grids(const Surfaces& s, const BroadPhase& w) {
  const auto low = w.low, high = w.high;
  Real least[3], most[3];
  for (int d = 0; d < 3; ++d) {
    least[d] = -maximum(
        s.parts, KOKKOS_LAMBDA(const Index p) { return -low(p, d); });
    most[d] = maximum(
        s.parts, KOKKOS_LAMBDA(const Index p) { return high(p, d); });
  }
  const Real smallest = -maximum(
      s.parts, KOKKOS_LAMBDA(const Index p) { return -extent_of(low, high, p); });
  Grids g;
  Real whole = 0;
  for (int d = 0; d < 3; ++d) whole = std::fmax(whole, most[d] - least[d]);
  g.origin = {least[0], least[1], least[2]};
  g.size = std::fmax(smallest, whole / (1 << (cell_bits - 1)));
  if (!(g.size > 0)) g.size = 1;
  return g;
}

void place_boxes(const Surfaces& s, const Grids& g, const BroadPhase& w) {
  const auto low = w.low, high = w.high;
  const auto level = w.level;
  const auto key = w.cells.key;
  const auto value = w.cells.value;
  device::for_each(
      "rockfold::contact::place_boxes", s.parts, KOKKOS_LAMBDA(const Index p) {
        const Real extent = extent_of(low, high, p);
        Index l = 0;
        Real edge = g.size;
        while (edge < extent && l < last_level) {
          edge *= 2;
          ++l;
        }
        level(p) = l;
        key(p) = cell_key(l, g.cell(low(p, 0), g.origin.x, edge),
                          g.cell(low(p, 1), g.origin.y, edge), g.cell(low(p, 2), g.origin.z, edge));
        value(p) = p;
      });
}

/// found(q) for all boxes q that box p overlaps: of its own level those after it, of coarser levels all.
template <class Found>
KOKKOS_INLINE_FUNCTION void for_each_neighbour(const Surfaces& s, const Grids& g,
                                               const BroadPhase& w, Index p, const Found& found) {
  if (w.gone(p) != 0) return;
  for (Index l = w.level(p); l <= last_level; ++l) {
    const Index end = lower_bound(w.cells.key, s.parts, cell_key(l + 1, 0, 0, 0));
    const Index begin = lower_bound(w.cells.key, end, cell_key(l, 0, 0, 0));
    if (begin == end) continue;
    const Real edge = g.edge(l);
    std::int64_t first[3], last[3];
    const Real origin[3] = {g.origin.x, g.origin.y, g.origin.z};
    for (int d = 0; d < 3; ++d) {  // a box there reaches into the cell after its own at most
      first[d] = g.cell(w.low(p, d), origin[d], edge) - 1;
      if (first[d] < 0) first[d] = 0;
      last[d] = g.cell(w.high(p, d), origin[d], edge);
    }
    for (std::int64_t z = first[2]; z <= last[2]; ++z)
      for (std::int64_t y = first[1]; y <= last[1]; ++y) {
        const std::uint64_t to = cell_key(l, last[0], y, z);
        for (Index i = lower_bound(w.cells.key, end, cell_key(l, first[0], y, z));
             i < end && w.cells.key(i) <= to; ++i) {
          const Index q = w.cells.value(i);
          if ((l == w.level(p) && q <= p) || s.part_block(q) == s.part_block(p) || w.gone(q) != 0)
            continue;
          bool meet = true;
          for (int d = 0; d < 3; ++d)
            meet = meet && w.low(p, d) <= w.high(q, d) && w.low(q, d) <= w.high(p, d);
          if (meet) found(q);
        }
      }
  }
}

int bits_of(std::uint64_t n) {
  int bits = 0;
  while (n > 0) {
    n >>= 1;
    ++bits;
  }
  return bits;
}

}  // namespace

BroadPhase make_broad_phase(const Surfaces& s) {
  BroadPhase w;
  w.low = device::make_field("contact::low", s.parts);
  w.high = device::make_field("contact::high", s.parts);
  w.gone = Array<std::uint8_t>("rockfold::contact::gone", s.parts);
  w.level = device::allocate<Index>("contact::level", s.parts);
  w.pair_begin = device::allocate<Index>("contact::pair_begin", s.parts + 1);
  reserve(w.cells, s.parts);
  return w;
}

Pairs find_pairs(const Surfaces& s, const Field& from, const Field& to, Real margin,
                 BroadPhase& work) {
  Pairs pairs;
  if (s.parts == 0) return pairs;
  find_boxes(s, from, to, margin, work);
  const Grids g = choose_grids(s, work);
  place_boxes(s, g, work);
  sort(work.cells, s.parts, level_bits + 3 * cell_bits);
  const BroadPhase w = work;
  device::for_each(
      "rockfold::contact::count_pairs", s.parts,
      KOKKOS_LAMBDA(const Index p) {
        Index n = 0;
        for_each_neighbour(s, g, w, p, [&](Index) { ++n; });
        w.pair_begin(p) = n;
      },
      64);
  pairs.count = to_offsets(w.pair_begin, s.parts);
  reserve(work.found, pairs.count);
  const auto key = work.found.key;
  const auto parts = static_cast<std::uint64_t>(s.parts);
  device::for_each(
      "rockfold::contact::write_pairs", s.parts,
      KOKKOS_LAMBDA(const Index p) {
        Index i = w.pair_begin(p);
        for_each_neighbour(s, g, w, p, [&](Index q) {
          const Index a = p < q ? p : q, b = p < q ? q : p;
          key(i++) = static_cast<std::uint64_t>(a) * parts + static_cast<std::uint64_t>(b);
        });
      },
      64);
  sort(work.found, pairs.count, bits_of(parts * parts));
  pairs.a = device::allocate<Index>("contact::pair_a", pairs.count);
  pairs.b = device::allocate<Index>("contact::pair_b", pairs.count);
  const auto sorted = work.found.key;
  const auto a = pairs.a, b = pairs.b;
  device::for_each(
      "rockfold::contact::split_pairs", pairs.count, KOKKOS_LAMBDA(const Index i) {
        a(i) = static_cast<Index>(sorted(i) / parts);
        b(i) = static_cast<Index>(sorted(i) % parts);
      });
  return pairs;
}

}  // namespace rockfold::contact
