#include "kernels/solve/cover_blocks_kernel.hpp"

namespace rockfold::solve {
namespace {

constexpr int most_entries = most_block_width * most_block_width;

/// Pivots of a matrix of unit diagonal below this are rounding.
constexpr Real least_pivot = 1e-10;

/// Where the couplings of each cover with itself stand: its slot of block rows, or −1 − its run.
Array<Index> places(const Operator& op) {
  const auto place = device::allocate<Index>("solve::cover_place", op.covers);
  const DeviceStencil stencil = op.stencil;
  const auto row = op.block.row;
  device::for_each(
      "rockfold::solve::place_blocks", op.block.slots(), KOKKOS_LAMBDA(const Index slot) {
        if (row(slot) != none) place(row(slot)) = slot;
      });
  device::for_each(
      "rockfold::solve::place_runs", stencil.runs(), KOKKOS_LAMBDA(const Index run) {
        for (Index i = 0; i < stencil.length(run); ++i)
          place(stencil.first(run) + stencil.stride * i) = -1 - run;
      });
  return place;
}

/// αK + βM of a cover with itself.
KOKKOS_INLINE_FUNCTION void own_matrix(const DeviceBlocks& block, const DeviceStencil& stencil,
                                       Index place, const Combination& c, int n, Real* a) {
  const int width = 3 * n;
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) {
      const Real* v;
      int step;
      if (place >= 0) {
        v = block.diagonals(place / slice_lanes, k, l) + place % slice_lanes;
        step = slice_lanes;
      } else {
        const Index run = -1 - place;
        v = stencil.of_run(run) + stencil.entry(stencil.run_offsets(run), k, 0, l);
        step = 1;
      }
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          a[(3 * k + i) * width + 3 * l + j] =
              c.stiffness * v[(3 * i + j) * step] + (i == j ? c.mass * v[9 * step] : 0);
    }
}

/// The row of `unknown` among those that points act on, or none.
KOKKOS_INLINE_FUNCTION Index find_row(const Array<Index>& row, Index unknown) {
  Index low = 0, high = static_cast<Index>(row.extent(0));
  while (low < high) {
    const Index middle = (low + high) / 2;
    if (row(middle) < unknown)
      low = middle + 1;
    else
      high = middle;
  }
  return low < static_cast<Index>(row.extent(0)) && row(low) == unknown ? low : none;
}

/// a += factor · Nᵀ k N of cover p with itself.
KOKKOS_INLINE_FUNCTION void add_springs(const Springs& s, Real factor, Index p, Index covers, int n,
                                        Real* a) {
  const int width = 3 * n;
  for (int k = 0; k < n; ++k) {
    const Index t = find_row(s.row, k * covers + p);
    if (t == none) continue;
    for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i) {
      const Index entry = s.row_entry(i), point = s.entry_point(entry);
      for (Index j = s.points.begin(point); j < s.points.begin(point + 1); ++j) {
        if (s.points.unknown(j) % covers != p) continue;
        const int l = s.points.unknown(j) / covers;
        for (int d = 0; d < 3; ++d)
          a[(3 * k + d) * width + 3 * l + d] +=
              factor * s.points.weight(entry) * s.points.weight(j) * s.stiffness(point, d);
      }
    }
  }
}

/// a ← its inverse; a symmetric with unit (or zero) diagonal. Cholesky: a = L Lᵀ, then L⁻¹, then L⁻ᵀ L⁻¹.
KOKKOS_INLINE_FUNCTION void invert_symmetric(int n, Real* a) {
  for (int j = 0; j < n; ++j) {
    Real pivot = a[j * n + j];
    for (int k = 0; k < j; ++k) pivot -= a[j * n + k] * a[j * n + k];
    const bool resists = pivot > least_pivot;
    const Real root = resists ? device::math::sqrt(pivot) : 1;
    a[j * n + j] = root;
    for (int k = 0; !resists && k < j; ++k) a[j * n + k] = 0;  // left to itself
    for (int i = j + 1; i < n; ++i) {
      Real sum = a[i * n + j];
      for (int k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = resists ? sum / root : 0;
    }
  }
  for (int j = 0; j < n; ++j) {
    a[j * n + j] = 1 / a[j * n + j];
    for (int i = j + 1; i < n; ++i) {
      Real sum = 0;
      for (int k = j; k < i; ++k) sum -= a[i * n + k] * a[k * n + j];
      a[i * n + j] = sum / a[i * n + i];
    }
  }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      Real sum = 0;
      for (int k = i; k < n; ++k) sum += a[k * n + i] * a[k * n + j];
      a[j * n + i] = sum;  // into the upper half: row i of L⁻¹ is needed no more
    }
}

}  // namespace

CoverBlocks make_cover_blocks(const Operator& op) {
  CoverBlocks blocks;
  blocks.covers = op.covers;
  blocks.functions = op.functions;
  blocks.inverse = device::allocate<Real>(
      "solve::cover_blocks", static_cast<std::size_t>(op.covers) * blocks.width() * blocks.width());
  blocks.scale = device::make_field("solve::cover_scale", op.unknowns);
  return blocks;
}

void set_values(const CoverBlocks& blocks, const Operator& op, const Springs& springs,
                const Combination& c, Real spring_factor) {
  const CoverBlocks to = blocks;
  const Springs s = springs;
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  const auto place = places(op);
  device::for_each(
      "rockfold::solve::cover_blocks", op.covers, KOKKOS_LAMBDA(const Index p) {
        Real a[most_entries];
        const int n = to.functions, width = to.width();
        own_matrix(block, stencil, place(p), c, n, a);
        if (s.any()) add_springs(s, spring_factor, p, to.covers, n, a);
        for (int i = 0; i < width; ++i) {
          const Real d = a[i * width + i];
          to.scale(i / 3 * to.covers + p, i % 3) = d > 0 ? 1 / device::math::sqrt(d) : 0;
        }
        for (int i = 0; i < width; ++i)
          for (int j = 0; j < width; ++j)
            a[i * width + j] *=
                to.scale(i / 3 * to.covers + p, i % 3) * to.scale(j / 3 * to.covers + p, j % 3);
        invert_symmetric(width, a);
        Real* inverse = &to.inverse(static_cast<std::size_t>(p) * width * width);
        for (int i = 0; i < width; ++i)
          for (int j = 0; j < width; ++j)
            inverse[i * width + j] = i <= j ? a[i * width + j] : a[j * width + i];
      });
}

}  // namespace rockfold::solve
