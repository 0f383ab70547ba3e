// Galerkin's products of covers with several functions, by rows, and what acts between levels.
#include "kernels/operator/operator_rows_kernel.hpp"
#include "kernels/precondition/cover_grid_kernel.hpp"

namespace rockfold::solve {
namespace {

template <class Rows>
void multiply_rows(const Rows& fine, const CoverTransfer& p, const CoverMatrix& to) {
  device::for_each(
      "rockfold::solve::cover_products", to.covers,
      KOKKOS_LAMBDA(const Index row) { multiply_row(fine, p, to, row); }, to.width() * to.width());
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
  multiply_rows(MatrixRows{fine}, p, to);
}

void set_values(const CoverBlocks& blocks, const CoverMatrix& a, const PointTerms& terms,
                const ContactRows& contacts) {
  const CoverBlocks to = blocks;
  const CoverMatrix m = a, c = contacts.a;
  const bool touches = contacts.any();
  device::for_each(
      "rockfold::solve::own_blocks", m.covers, KOKKOS_LAMBDA(const Index p) {
        const int size = m.width() * m.width();
        const Real* own = find_block(m, p, p);
        const Real* more = touches ? find_block(c, p, p) : nullptr;
        for (int e = 0; e < size; ++e)
          to.inverse(static_cast<std::size_t>(p) * size + e) =
              more == nullptr ? own[e] : own[e] + more[e];
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
