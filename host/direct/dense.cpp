#include "host/direct/dense.hpp"

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include "host/parallel.hpp"
#include "src/base/simd_versions.hpp"

namespace rockfold::host {
namespace {

// Sums of 8 × 6 entries stay in the registers of AVX2, those of AVX-512 hold as many and more.
constexpr Index tile_rows = 8, tile_columns = 6;
/// Columns of a and b that are gathered at a time, with so many rows of each: 128 kB of a and 192 kB of b, in the second-level cache, and
/// eight rows of a in the first.
constexpr Index chunk = 256, gathered_of_a = 64, block = 96;
/// Rows of which a thread finds the answers at a time, and columns of them that are not found by products.
constexpr Index rows_at_once = 256, triangle = 32;
/// Multiplications that take longer than other threads take to start.
constexpr double worthwhile = 1e6;

// NOLINTNEXTLINE(modernize-use-using): the attribute needs it
typedef Real Lanes __attribute__((vector_size(sizeof(Real) * tile_rows), aligned(sizeof(Real))));

/// sum[j][i] = Σ_k a[k][i] b[k][j].
ROCKFOLD_SIMD_VERSIONS
void multiply(Index depth, const Real* a, const Real* b, Real* sum) {
  Lanes s[tile_columns] = {};
  for (Index k = 0; k < depth; ++k, a += tile_rows, b += tile_columns) {
    const Lanes of_a = *reinterpret_cast<const Lanes*>(a);
    for (Index j = 0; j < tile_columns; ++j) s[j] += of_a * b[j];
  }
  for (Index j = 0; j < tile_columns; ++j) *reinterpret_cast<Lanes*>(sum + j * tile_rows) = s[j];
}

/// The rows as tiles: [tile][k][width], nothing beyond `rows`.
template <Index width>
void gather_tiles(Index rows, Index depth, const Real* from, Index stride, Real* to) {
  const Index whole = rows - rows % width;
  for (Index k = 0; k < depth; ++k, from += stride, to += width) {
    for (Index i = 0; i < whole; i += width) std::copy_n(from + i, width, to + i * depth);
    if (whole < rows)
      std::fill(std::copy_n(from + whole, rows - whole, to + whole * depth),
                to + whole * depth + width, 0);
  }
}

std::ptrdiff_t at(Index row, Index column, Index stride) {
  return row + static_cast<std::ptrdiff_t>(column) * stride;
}

/// take_off_product for a block of columns and a chunk of the depth.
void take_off_chunk(Index rows, Index columns, Index depth, const Real* a, Index a_stride,
                    const Real* b, Index b_stride, Real* c, Index c_stride) {
  alignas(64) Real of_a[chunk * gathered_of_a], of_b[chunk * block], sum[tile_rows * tile_columns];
  gather_tiles<tile_columns>(columns, depth, b, b_stride, of_b);
  for (Index from = 0; from < rows; from += gathered_of_a) {
    const Index to = std::min(from + gathered_of_a, rows);
    gather_tiles<tile_rows>(to - from, depth, a + from, a_stride, of_a);
    for (Index j = 0; j < columns; j += tile_columns)
      for (Index i = from; i < to; i += tile_rows) {
        const Index high = std::min(tile_rows, to - i), wide = std::min(tile_columns, columns - j);
        // What the tile goes to comes from memory meanwhile.
        for (Index l = 0; l < wide; ++l)
          __builtin_prefetch(c + at(i + high - 1, j + l, c_stride), 1);
        multiply(depth, of_a + (i - from) * depth, of_b + j * depth, sum);
        for (Index l = 0; l < wide; ++l)
          for (Index k = 0; k < high; ++k) c[at(i + k, j + l, c_stride)] -= sum[l * tile_rows + k];
      }
  }
}

}  // namespace

void take_off_product(Index rows, Index columns, Index depth, const Real* a, Index a_stride,
                      const Real* b, Index b_stride, Real* c, Index c_stride) {
  if (depth == 0) return;
  for (Index j = 0; j < columns; j += block)
    for (Index k = 0; k < depth; k += chunk)
      take_off_chunk(rows, std::min(block, columns - j), std::min(chunk, depth - k),
                     a + at(0, k, a_stride), a_stride, b + at(j, k, b_stride), b_stride,
                     c + at(0, j, c_stride), c_stride);
}

void take_off_square(Index n, Index depth, const Real* a, Index a_stride, Real* c, Index c_stride) {
  if (depth == 0) return;
  const auto take_off = [&](std::int64_t i) {
    const Index j = static_cast<Index>(i) * block;
    take_off_product(n - j, std::min(block, n - j), depth, a + j, a_stride, a + j, a_stride,
                     c + at(j, j, c_stride), c_stride);
  };
  parallel_for((n + block - 1) / block, 1, take_off,
               0.5 * n * static_cast<double>(n) * depth > worthwhile);
}

void divide_by_transpose(Index rows, Index n, const Real* lower, Index lower_stride, Real* b,
                         Index b_stride) {
  using Stride = Eigen::OuterStride<>;
  using Columns = Eigen::Map<Eigen::MatrixXd, 0, Stride>;
  using Known = Eigen::Map<const Eigen::MatrixXd, 0, Stride>;
  const auto divide = [&](std::int64_t part) {
    const Index from = static_cast<Index>(part) * rows_at_once;
    const Index high = std::min(rows_at_once, rows - from);
    const auto known_of = [&](Index j) { return b + from + at(0, j, b_stride); };
    for (Index j = 0; j < n; j += block) {
      const Index end = std::min(j + block, n);
      take_off_product(high, end - j, j, known_of(0), b_stride, lower + j, lower_stride,
                       known_of(j), b_stride);
      for (Index k = j; k < end; k += triangle) {
        const Index wide = std::min(triangle, end - k);
        take_off_product(high, wide, k - j, known_of(j), b_stride, lower + at(k, j, lower_stride),
                         lower_stride, known_of(k), b_stride);
        Columns answers(known_of(k), high, wide, Stride(b_stride));
        const Known by(lower + at(k, k, lower_stride), wide, wide, Stride(lower_stride));
        by.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(answers);
      }
    }
  };
  parallel_for((rows + rows_at_once - 1) / rows_at_once, 1, divide,
               static_cast<double>(rows) * n * n > worthwhile);
}

}  // namespace rockfold::host
