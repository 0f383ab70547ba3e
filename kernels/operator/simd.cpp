#include "kernels/operator/simd.hpp"

#include "src/base/simd_versions.hpp"

namespace rockfold::solve {

void stencil_start(Index length, Real scale, const Components& x, Real* const* y) {
  for (int i = 0; i < 3; ++i)
    for (Index k = 0; k < length; ++k) y[i][k] = scale * x.x[i][k];
}

ROCKFOLD_SIMD_VERSIONS
void stencil_add(Index length, const Real* c, const Components& x, const Components& plus,
                 const Components& minus, Real* const* y) {
  const Real *x0 = x.x[0], *x1 = x.x[1], *x2 = x.x[2];
  const Real *p0 = plus.x[0], *p1 = plus.x[1], *p2 = plus.x[2];
  const Real *m0 = minus.x[0], *m1 = minus.x[1], *m2 = minus.x[2];
  Real *y0 = y[0], *y1 = y[1], *y2 = y[2];
  const Real c0 = c[0], c1 = c[1], c2 = c[2], c3 = c[3], c4 = c[4], c5 = c[5], c6 = c[6], c7 = c[7],
             c8 = c[8];
  ROCKFOLD_NO_ALIAS
  for (Index k = 0; k < length; ++k) {
    const Real t0 = (p0[k] - x0[k]) + (m0[k] - x0[k]);
    const Real t1 = (p1[k] - x1[k]) + (m1[k] - x1[k]);
    const Real t2 = (p2[k] - x2[k]) + (m2[k] - x2[k]);
    y0[k] += c0 * t0 + c1 * t1 + c2 * t2;
    y1[k] += c3 * t0 + c4 * t1 + c5 * t2;
    y2[k] += c6 * t0 + c7 * t1 + c8 * t2;
  }
}

namespace {

constexpr Index chunk = 16;

/// Rows [begin, begin + count) of stencil_gather: count = chunk, or fewer where they are not contiguous.
template <bool contiguous>
[[gnu::always_inline]] inline void gather_chunk(Index begin, Index count, Index stride,
                                                Index differences, Index terms, const Real* block,
                                                const Components* at, const Components& own,
                                                Real own_mass, Real* const* y) {
  Index index[chunk];  // lanes without a row repeat the last
  for (Index l = 0; l < chunk; ++l) index[l] = (begin + (l < count ? l : count - 1)) * stride;
  Real o[3][chunk], s[3][chunk];
  for (int i = 0; i < 3; ++i)
    for (Index l = 0; l < chunk; ++l) {
      o[i][l] = own.x[i][contiguous ? begin + l : index[l]];
      s[i][l] = own_mass * o[i][l];
    }
  for (Index c = 0; c < terms; ++c, block += 9) {
    Real t[3][chunk];
    for (int i = 0; i < 3; ++i)
      for (Index l = 0; l < chunk; ++l) t[i][l] = at[c].x[i][contiguous ? begin + l : index[l]];
    if (c < differences)
      for (int i = 0; i < 3; ++i)
        for (Index l = 0; l < chunk; ++l) t[i][l] -= o[i][l];
    for (int i = 0; i < 3; ++i)
      for (Index l = 0; l < chunk; ++l)
        s[i][l] += block[3 * i] * t[0][l] + block[3 * i + 1] * t[1][l] + block[3 * i + 2] * t[2][l];
  }
  for (int i = 0; i < 3; ++i)
    for (Index l = 0; l < count; ++l) y[i][contiguous ? begin + l : index[l]] = s[i][l];
}

}  // namespace

ROCKFOLD_SIMD_VERSIONS
void stencil_gather(Index length, Index stride, Index differences, Index terms, const Real* block,
                    const Components* at, const Components& own, Real own_mass, Real* const* y) {
  for (Index begin = 0; begin < length; begin += chunk) {
    const Index count = length - begin < chunk ? length - begin : chunk;
    if (count == chunk && stride == 1)
      gather_chunk<true>(begin, chunk, stride, differences, terms, block, at, own, own_mass, y);
    else
      gather_chunk<false>(begin, count, stride, differences, terms, block, at, own, own_mass, y);
  }
}

namespace {

template <int width>
[[gnu::always_inline]] inline void add_block(const Real* value, const Real* u, Real* sum) {
  Real s[width];  // in registers
  for (int r = 0; r < width; ++r) s[r] = sum[r];
  for (int e = 0; e < width; ++e, value += width)
    for (int r = 0; r < width; ++r) s[r] += value[r] * u[e];
  for (int r = 0; r < width; ++r) sum[r] = s[r];
}

}  // namespace

/// With the widths of covers of order 1 and 2 known to the compiler.
ROCKFOLD_SIMD_VERSIONS
void block_add(int width, const Real* value, const Real* u, Real* sum) {
  if (width == 12) return add_block<12>(value, u, sum);
  if (width == 30) return add_block<30>(value, u, sum);
  for (int e = 0; e < width; ++e, value += width)
    for (int r = 0; r < width; ++r) sum[r] += value[r] * u[e];
}

ROCKFOLD_SIMD_VERSIONS
void slice_add(Index columns, const Index* column, const Real* value, Real stiffness, Real mass,
               const Components& x, const Real (*own)[simd_lanes], Real (*sum)[simd_lanes]) {
  constexpr int n = simd_lanes;
  const Real *x0 = x.x[0], *x1 = x.x[1], *x2 = x.x[2];
  Real s0[n], s1[n], s2[n];
  for (int l = 0; l < n; ++l) s0[l] = sum[0][l], s1[l] = sum[1][l], s2[l] = sum[2][l];
  for (Index k = 0; k < columns; ++k, column += n, value += 10 * n)
    for (int l = 0; l < n; ++l) {
      const Real u0 = x0[column[l]], u1 = x1[column[l]], u2 = x2[column[l]];
      const Real t0 = stiffness * (u0 - own[0][l]), t1 = stiffness * (u1 - own[1][l]),
                 t2 = stiffness * (u2 - own[2][l]), m = mass * value[9 * n + l];
      s0[l] += value[l] * t0 + value[n + l] * t1 + value[2 * n + l] * t2 + m * u0;
      s1[l] += value[3 * n + l] * t0 + value[4 * n + l] * t1 + value[5 * n + l] * t2 + m * u1;
      s2[l] += value[6 * n + l] * t0 + value[7 * n + l] * t1 + value[8 * n + l] * t2 + m * u2;
    }
  for (int l = 0; l < n; ++l) sum[0][l] = s0[l], sum[1][l] = s1[l], sum[2][l] = s2[l];
}

}  // namespace rockfold::solve
