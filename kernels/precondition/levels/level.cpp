// Products of a level's matrix, on a core fused with what follows: rows stay in the first-level cache.
#include "kernels/precondition/levels/level_kernel.hpp"
#include "kernels/precondition/levels/single_simd.hpp"

namespace rockfold::solve {
namespace {

/// What a sweep over the rows does with A d.
struct Sweep {
  bool smooths = false;  ///< or the residual alone
  float old_share = 0, new_share = 0;
  SingleInverse inverse;
  SingleField d, r, x, step;
};

KOKKOS_INLINE_FUNCTION void finish_row(const Sweep& s, Index p, const float* y) {
  float r[3];
  for (int i = 0; i < 3; ++i) {
    r[i] = s.r(p, i) - y[i];
    s.r(p, i) = r[i];
  }
  if (!s.smooths) return;
  const auto& b = s.inverse;
  const float z[3] = {b(p, 0) * r[0] + b(p, 3) * r[1] + b(p, 5) * r[2],
                      b(p, 3) * r[0] + b(p, 1) * r[1] + b(p, 4) * r[2],
                      b(p, 5) * r[0] + b(p, 4) * r[1] + b(p, 2) * r[2]};
  for (int i = 0; i < 3; ++i) {
    const float step = s.old_share * s.d(p, i) + s.new_share * z[i];
    s.step(p, i) = step;
    s.x(p, i) += step;
  }
}

KOKKOS_INLINE_FUNCTION void sweep_stencil_row(const SingleStencil& stencil, Index run, Index k,
                                              const Sweep& s) {
  const Index along = stencil.stride * k, p = stencil.first(run) + along;
  const Index offsets = 2 * stencil.run_pairs(run);
  const float* block = &stencil.table(stencil.run_table(run));
  float own[3], y[3];
  for (int i = 0; i < 3; ++i) {
    own[i] = s.d(p, i);
    y[i] = block[9 * offsets] * own[i];
  }
  for (Index o = 0; o < offsets; ++o, block += 9) {
    const Index q = stencil.neighbour(stencil.neighbour_begin(run) + o) + along;
    float t[3];
    for (int j = 0; j < 3; ++j) t[j] = s.d(q, j) - own[j];
    for (int i = 0; i < 3; ++i)
      y[i] += block[3 * i] * t[0] + block[3 * i + 1] * t[1] + block[3 * i + 2] * t[2];
  }
  finish_row(s, p, y);
}

#ifndef ROCKFOLD_ON_GPU

SingleComponents components(const SingleField& x, Index p) {
  return {{&x(p, 0), &x(p, 1), &x(p, 2)}};
}

/// Rows that do not stand side by side.
void sweep_strided_run(const SingleStencil& stencil, Index run, const Sweep& s) {
  for (Index k = 0; k < stencil.length(run); ++k) sweep_stencil_row(stencil, run, k, s);
}

void sweep_run(const SingleStencil& stencil, Index run, const Sweep& s) {
  if (stencil.stride != 1) return sweep_strided_run(stencil, run, s);
  const Index first = stencil.first(run), length = stencil.length(run);
  const Index pairs = stencil.run_pairs(run);
  const float* table = &stencil.table(stencil.run_table(run));
  float y[3][StencilRuns::max_length];
  float* const out[3] = {y[0], y[1], y[2]};
  const SingleComponents own = components(s.d, first);
  const float whole = table[18 * pairs];
  for (int i = 0; i < 3; ++i)
    for (Index k = 0; k < length; ++k) y[i][k] = whole * own.x[i][k];
  const Index* q = &stencil.neighbour(stencil.neighbour_begin(run));
  for (Index o = 0; o < pairs; ++o)
    stencil_add(length, table + 18 * o, own, components(s.d, q[2 * o]),
                components(s.d, q[2 * o + 1]), out);
  if (!s.smooths) {
    for (int i = 0; i < 3; ++i)
      for (Index k = 0; k < length; ++k) s.r(first + k, i) -= y[i][k];
    return;
  }
  SingleStep rows{};
  for (int i = 0; i < 3; ++i) {
    rows.y[i] = y[i];
    rows.d[i] = own.x[i];
    rows.r[i] = &s.r(first, i);
    rows.x[i] = &s.x(first, i);
    rows.step[i] = &s.step(first, i);
  }
  for (int k = 0; k < 6; ++k) rows.inverse[k] = &s.inverse(first, k);
  smooth_rows(length, s.old_share, s.new_share, rows);
}

void sweep_slice(const SingleBlocks& block, Index slice, const Sweep& s) {
  const Index slot = slice * slice_lanes, begin = block.slice_begin(slice);
  float own[3][slice_lanes], sum[3][slice_lanes];
  for (int l = 0; l < slice_lanes; ++l) {
    const Index p = block.row(slot + l);
    for (int i = 0; i < 3; ++i) {
      own[i][l] = p == none ? 0 : s.d(p, i);
      sum[i][l] = block.own(3 * static_cast<std::size_t>(slot + l) + i) * own[i][l];
    }
  }
  slice_add(block.slice_begin(slice + 1) - begin, block.column.data() + begin * slice_lanes,
            block.values(slice), components(s.d, 0), own, sum);
  for (int l = 0; l < slice_lanes; ++l) {
    const Index p = block.row(slot + l);
    const float y[3] = {sum[0][l], sum[1][l], sum[2][l]};
    if (p != none) finish_row(s, p, y);
  }
}

void sweep(const LevelMatrix& a, const Sweep& s) {
  using Portions = Kokkos::RangePolicy<device::Exec, Kokkos::Schedule<Kokkos::Dynamic>,
                                       Kokkos::IndexType<Index>>;
  const SingleStencil stencil = a.stencil;
  const SingleBlocks block = a.block;
  const Index slices = block.slices();
  const Index portions = slices + stencil.runs();
  const auto sweep_portion = KOKKOS_LAMBDA(const Index i) {
    if (i < slices)
      sweep_slice(block, i, s);
    else
      sweep_run(stencil, i - slices, s);
  };
  if (a.rows <= device::serial_limit)
    for (Index i = 0; i < portions; ++i) sweep_portion(i);
  else
    Kokkos::parallel_for("rockfold::solve::sweep", Portions(0, portions, Kokkos::ChunkSize(16)),
                         sweep_portion);
}

#else

KOKKOS_INLINE_FUNCTION void sweep_block_row(const SingleBlocks& block, Index slot, const Sweep& s) {
  const Index p = block.row(slot), slice = slot / slice_lanes;
  if (p == none) return;
  float own[3], y[3];
  for (int i = 0; i < 3; ++i) {
    own[i] = s.d(p, i);
    y[i] = block.own(3 * static_cast<std::size_t>(slot) + i) * own[i];
  }
  const Index begin = block.slice_begin(slice);
  for (Index k = begin; k < block.slice_begin(slice + 1); ++k) {
    const Index q = block.column(k * slice_lanes + slot % slice_lanes);
    const float* v = block.values(slice) + static_cast<std::size_t>(k - begin) * 9 * slice_lanes +
                     slot % slice_lanes;
    float t[3];
    for (int j = 0; j < 3; ++j) t[j] = s.d(q, j) - own[j];
    for (int i = 0; i < 3; ++i)
      y[i] += v[3 * i * slice_lanes] * t[0] + v[(3 * i + 1) * slice_lanes] * t[1] +
              v[(3 * i + 2) * slice_lanes] * t[2];
  }
  finish_row(s, p, y);
}

void sweep(const LevelMatrix& a, const Sweep& s) {
  const SingleStencil stencil = a.stencil;
  const SingleBlocks block = a.block;
  device::for_each(
      "rockfold::solve::sweep_blocks", block.slices() * slice_lanes,
      KOKKOS_LAMBDA(const Index slot) { sweep_block_row(block, slot, s); });
  device::for_each(
      "rockfold::solve::sweep_stencil", stencil.runs() * slice_lanes, KOKKOS_LAMBDA(const Index i) {
        const Index run = i / slice_lanes;
        for (Index k = i % slice_lanes; k < stencil.length(run); k += slice_lanes)
          sweep_stencil_row(stencil, run, k, s);
      });
}

#endif

/// r −= Nᵀ D N d.
void subtract_terms(const SingleTerms& terms, const SingleField& d, const SingleField& r) {
  if (!terms.any()) return;
  const SingleTerms s = terms;
  device::for_each(
      "rockfold::solve::single_term_forces", s.points.count, KOKKOS_LAMBDA(const Index n) {
        Real u[3] = {0, 0, 0};
        for (Index e = s.points.begin(n); e < s.points.begin(n + 1); ++e)
          for (int i = 0; i < 3; ++i) u[i] += s.points.weight(e) * d(s.points.unknown(e), i);
        for (int i = 0; i < 3; ++i) {
          Real sum = 0;
          for (int j = 0; j < 3; ++j) sum += s.tangent(n, symmetric_entry(i, j)) * u[j];
          s.force(n, i) = static_cast<float>(sum);
        }
      });
  device::for_each(
      "rockfold::solve::single_scatter", static_cast<Index>(s.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) {
        for (int i = 0; i < 3; ++i) {
          Real sum = 0;
          for (Index k = s.row_begin(t); k < s.row_begin(t + 1); ++k)
            sum += s.row_weight(k) * s.force(s.row_point(k), i);
          r(s.row(t), i) -= static_cast<float>(sum);
        }
      });
}

}  // namespace

void smooth(const LevelMatrix& a, const SingleInverse& inverse, float old_share, float new_share,
            const SingleField& d, const SingleField& r, const SingleField& x,
            const SingleField& step) {
  subtract_terms(a.terms, d, r);
  if (a.contacts.any()) add_contacts(a.contacts, -1, d, r);
  sweep(a, {true, old_share, new_share, inverse, d, r, x, step});
}

void subtract_product(const LevelMatrix& a, const SingleField& d, const SingleField& r) {
  subtract_terms(a.terms, d, r);
  if (a.contacts.any()) add_contacts(a.contacts, -1, d, r);
  sweep(a, {false, 0, 0, {}, d, r, {}, {}});
}

}  // namespace rockfold::solve
