// Galerkin's products of covers with several functions, by rows: a coarse row gathers from the rows of its children, so that each value is
// summed by one thread in one order.
#include "kernels/operator/operator_rows_kernel.hpp"
#include "kernels/precondition/cover_grid_kernel.hpp"

namespace rockfold::solve {
namespace {

/// f += weight · what the coarse functions c are there (see the header's G), by function.
KOKKOS_INLINE_FUNCTION void prolong(int n, bool quadratic, Real weight, const Real* step,
                                    const Real* c, Real* f) {
  for (int k = 0; k < n; ++k) f[k] += weight * c[k];
  if (!quadratic) return;
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, g = (d + 2) % 3;
    f[1 + d] += weight * (step[d] * c[4 + d] + 0.5 * step[e] * c[7 + d] + 0.5 * step[g] * c[7 + g]);
  }
}

/// The transpose, without weight, in place: entries of one function are `stride` apart.
KOKKOS_INLINE_FUNCTION void restrict_in_place(bool quadratic, const Real* step, Real* f,
                                              int stride) {
  if (!quadratic) return;
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3;
    f[(4 + d) * stride] += step[d] * f[(1 + d) * stride];
    f[(7 + d) * stride] += 0.5 * (step[e] * f[(1 + d) * stride] + step[d] * f[(1 + e) * stride]);
  }
}

/// The rows of a coarse level.
struct MatrixRows {
  CoverMatrix a;
  int functions;

  KOKKOS_INLINE_FUNCTION Index count(Index i) const { return a.begin(i + 1) - a.begin(i); }
  KOKKOS_INLINE_FUNCTION Index load(Index i, Index m, Real* to) const {
    const int size = a.width() * a.width();
    const Real* v = &a.value(static_cast<std::size_t>(a.begin(i) + m) * size);
    for (int e = 0; e < size; ++e) to[e] = v[e];
    return a.column(a.begin(i) + m);
  }
};

KOKKOS_INLINE_FUNCTION Real* find_block(const CoverMatrix& a, Index row, Index column) {
  Index low = a.begin(row), high = a.begin(row + 1);
  while (low < high) {
    const Index middle = (low + high) / 2;
    if (a.column(middle) < column)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == a.begin(row + 1) || a.column(low) != column) return nullptr;
  return &a.value(static_cast<std::size_t>(low) * a.width() * a.width());
}

template <class Rows>
void multiply_rows(const Rows& fine, const CoverTransfer& p, const CoverMatrix& to) {
  device::for_each(
      "rockfold::solve::cover_products", to.covers,
      KOKKOS_LAMBDA(const Index row) {
        const int n = to.functions, width = 3 * n, size = width * width;
        Real a[most_block_width * most_block_width], b[most_block_width];
        for (Index k = to.begin(row); k < to.begin(row + 1); ++k)
          for (int e = 0; e < size; ++e) to.value(static_cast<std::size_t>(k) * size + e) = 0;
        for (Index c = p.child_begin(row); c < p.child_begin(row + 1); ++c) {
          const Index i = p.child(c), blocks = fine.count(i);
          for (Index m = 0; m < blocks; ++m) {
            const Index j = fine.load(i, m, a);
            if (j == none) continue;
            for (int e = 0; e < width; ++e)
              for (int d = 0; d < 3; ++d)
                restrict_in_place(p.quadratic, &p.child_step(3 * c), a + e * width + d, 3);
            for (Index q = p.parent_begin(j); q < p.parent_begin(j + 1); ++q) {
              Real* sum = find_block(to, row, p.parent(q));
              if (sum == nullptr) continue;
              const Real weight = p.child_weight(c) * p.parent_weight(q);
              if (!p.quadratic) {
                for (int e = 0; e < size; ++e) sum[e] += weight * a[e];
                continue;
              }
              for (int r = 0; r < width; ++r)
                for (int d = 0; d < 3; ++d) {
                  for (int f = 0; f < n; ++f) b[f] = a[(3 * f + d) * width + r];
                  restrict_in_place(true, &p.parent_step(3 * q), b, 1);
                  for (int f = 0; f < n; ++f) sum[(3 * f + d) * width + r] += weight * b[f];
                }
            }
          }
        }
      },
      to.width() * to.width());
}

}  // namespace

void apply(const CoverMatrix& a, const Field& x, const Field& y) {
  const CoverMatrix m = a;
  device::for_each(
      "rockfold::solve::apply_covers", m.covers,
      KOKKOS_LAMBDA(const Index p) {
        const int width = m.width();
        Real sum[most_block_width], u[most_block_width];
        for (int r = 0; r < width; ++r) sum[r] = 0;
        const Real* v = &m.value(static_cast<std::size_t>(m.begin(p)) * width * width);
        for (Index k = m.begin(p); k < m.begin(p + 1); ++k, v += width * width) {
          for (int e = 0; e < width; ++e) u[e] = x(e / 3 * m.covers + m.column(k), e % 3);
#ifdef ROCKFOLD_ON_GPU
          for (int e = 0; e < width; ++e)
            for (int r = 0; r < width; ++r) sum[r] += v[e * width + r] * u[e];
#else
          block_add(width, v, u, sum);
#endif
        }
        for (int r = 0; r < width; ++r) y(r / 3 * m.covers + p, r % 3) = sum[r];
      },
      m.width());
}

void multiply(const Operator& op, const Combination& c, const CoverTransfer& p,
              const CoverMatrix& to) {
  multiply_rows(rows_of(op, c), p, to);
}

void multiply(const CoverMatrix& fine, const CoverTransfer& p, const CoverMatrix& to) {
  multiply_rows(MatrixRows{fine, fine.functions}, p, to);
}

void set_values(const CoverBlocks& blocks, const CoverMatrix& a, const PointTerms& terms) {
  const CoverBlocks to = blocks;
  const CoverMatrix m = a;
  device::for_each(
      "rockfold::solve::own_blocks", m.covers, KOKKOS_LAMBDA(const Index p) {
        const int size = m.width() * m.width();
        const Real* own = find_block(m, p, p);
        for (int e = 0; e < size; ++e) to.inverse(static_cast<std::size_t>(p) * size + e) = own[e];
      });
  invert_cover_blocks(blocks, terms);
}

void restrict_functions(const CoverTransfer& p, int functions, const Field& fine,
                        const Field& coarse) {
  const CoverTransfer t = p;
  const Index fines = static_cast<Index>(fine.extent(0)) / functions,
              coarses = static_cast<Index>(coarse.extent(0)) / functions;
  device::for_each(
      "rockfold::solve::restrict_functions", coarses, KOKKOS_LAMBDA(const Index q) {
        for (int d = 0; d < 3; ++d) {
          Real sum[most_block_width / 3] = {}, f[most_block_width / 3];
          for (Index c = t.child_begin(q); c < t.child_begin(q + 1); ++c) {
            for (int k = 0; k < functions; ++k) f[k] = fine(k * fines + t.child(c), d);
            restrict_in_place(t.quadratic, &t.child_step(3 * c), f, 1);
            for (int k = 0; k < functions; ++k) sum[k] += t.child_weight(c) * f[k];
          }
          for (int k = 0; k < functions; ++k) coarse(k * coarses + q, d) = sum[k];
        }
      });
}

void add_correction(const CoverTransfer& p, int functions, const Field& coarse, const Field& d,
                    const Field& x) {
  const CoverTransfer t = p;
  const Index fines = static_cast<Index>(d.extent(0)) / functions,
              coarses = static_cast<Index>(coarse.extent(0)) / functions;
  device::for_each(
      "rockfold::solve::prolong_functions", fines, KOKKOS_LAMBDA(const Index i) {
        for (int e = 0; e < 3; ++e) {
          Real sum[most_block_width / 3] = {}, c[most_block_width / 3];
          for (Index q = t.parent_begin(i); q < t.parent_begin(i + 1); ++q) {
            for (int k = 0; k < functions; ++k) c[k] = coarse(k * coarses + t.parent(q), e);
            prolong(functions, t.quadratic, t.parent_weight(q), &t.parent_step(3 * q), c, sum);
          }
          for (int k = 0; k < functions; ++k) {
            d(k * fines + i, e) = sum[k];
            x(k * fines + i, e) += sum[k];
          }
        }
      });
}

}  // namespace rockfold::solve
