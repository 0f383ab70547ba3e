#include "kernels/precondition/levels/single_simd.hpp"

#include "src/base/simd_versions.hpp"

namespace rockfold::solve {

ROCKFOLD_SIMD_VERSIONS
void stencil_add(Index length, const float* c, const SingleComponents& x,
                 const SingleComponents& plus, const SingleComponents& minus, float* const* y) {
  const float *x0 = x.x[0], *x1 = x.x[1], *x2 = x.x[2];
  const float *p0 = plus.x[0], *p1 = plus.x[1], *p2 = plus.x[2];
  const float *m0 = minus.x[0], *m1 = minus.x[1], *m2 = minus.x[2];
  float *y0 = y[0], *y1 = y[1], *y2 = y[2];
  const float c0 = c[0], c1 = c[1], c2 = c[2], c3 = c[3], c4 = c[4], c5 = c[5], c6 = c[6],
              c7 = c[7], c8 = c[8];
  ROCKFOLD_NO_ALIAS
  for (Index k = 0; k < length; ++k) {
    const float t0 = (p0[k] - x0[k]) + (m0[k] - x0[k]);
    const float t1 = (p1[k] - x1[k]) + (m1[k] - x1[k]);
    const float t2 = (p2[k] - x2[k]) + (m2[k] - x2[k]);
    y0[k] += c0 * t0 + c1 * t1 + c2 * t2;
    y1[k] += c3 * t0 + c4 * t1 + c5 * t2;
    y2[k] += c6 * t0 + c7 * t1 + c8 * t2;
  }
}

ROCKFOLD_SIMD_VERSIONS
void slice_add(Index columns, const Index* column, const float* value, const SingleComponents& x,
               const float (*own)[simd_lanes], float (*sum)[simd_lanes]) {
  constexpr int n = simd_lanes;
  const float *x0 = x.x[0], *x1 = x.x[1], *x2 = x.x[2];
  float s0[n], s1[n], s2[n];
  for (int l = 0; l < n; ++l) s0[l] = sum[0][l], s1[l] = sum[1][l], s2[l] = sum[2][l];
  for (Index k = 0; k < columns; ++k, column += n, value += 9 * n)
    for (int l = 0; l < n; ++l) {
      const float t0 = x0[column[l]] - own[0][l], t1 = x1[column[l]] - own[1][l],
                  t2 = x2[column[l]] - own[2][l];
      s0[l] += value[l] * t0 + value[n + l] * t1 + value[2 * n + l] * t2;
      s1[l] += value[3 * n + l] * t0 + value[4 * n + l] * t1 + value[5 * n + l] * t2;
      s2[l] += value[6 * n + l] * t0 + value[7 * n + l] * t1 + value[8 * n + l] * t2;
    }
  for (int l = 0; l < n; ++l) sum[0][l] = s0[l], sum[1][l] = s1[l], sum[2][l] = s2[l];
}

ROCKFOLD_SIMD_VERSIONS
void smooth_rows(Index length, float old_share, float new_share, const SingleStep& s) {
  const float *y0 = s.y[0], *y1 = s.y[1], *y2 = s.y[2];
  const float *d0 = s.d[0], *d1 = s.d[1], *d2 = s.d[2];
  const float *xx = s.inverse[0], *yy = s.inverse[1], *zz = s.inverse[2], *xy = s.inverse[3],
              *yz = s.inverse[4], *zx = s.inverse[5];
  float *r0 = s.r[0], *r1 = s.r[1], *r2 = s.r[2];
  float *x0 = s.x[0], *x1 = s.x[1], *x2 = s.x[2];
  float *n0 = s.step[0], *n1 = s.step[1], *n2 = s.step[2];
  ROCKFOLD_NO_ALIAS
  for (Index k = 0; k < length; ++k) {
    const float a = r0[k] - y0[k], b = r1[k] - y1[k], c = r2[k] - y2[k];
    const float u = old_share * d0[k] + new_share * (xx[k] * a + xy[k] * b + zx[k] * c);
    const float v = old_share * d1[k] + new_share * (xy[k] * a + yy[k] * b + yz[k] * c);
    const float w = old_share * d2[k] + new_share * (zx[k] * a + yz[k] * b + zz[k] * c);
    r0[k] = a, r1[k] = b, r2[k] = c;
    n0[k] = u, n1[k] = v, n2[k] = w;
    x0[k] += u, x1[k] += v, x2[k] += w;
  }
}

}  // namespace rockfold::solve
