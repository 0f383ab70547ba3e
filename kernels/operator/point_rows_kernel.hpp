// Material points on the device, and their transpose: forces at points become forces on unknowns, one writer an unknown.
#pragma once

#include "kernels/device/device_kernel.hpp"
#include "src/arrays/cover_arrays.hpp"

namespace rockfold::solve {

using device::Array;
using device::Field;

/// Material points on the device.
struct DevicePoints {
  Index count = 0;
  Array<Index> begin;    ///< [N+1]
  Array<Index> unknown;  ///< see MaterialPoints
  Array<Real> weight;
};
DevicePoints upload(const MaterialPoints& points);

/// value(n, d) = Σ weight · x.
void interpolate(const DevicePoints& points, const Field& x, const Field& value);

KOKKOS_INLINE_FUNCTION Real interpolate_one(const DevicePoints& points, Index n, int d,
                                            const Field& x) {
  Real sum = 0;
  for (Index i = points.begin(n); i < points.begin(n + 1); ++i)
    sum += points.weight(i) * x(points.unknown(i), d);
  return sum;
}

/// u[d] = Σ weight · x(…, d).
KOKKOS_INLINE_FUNCTION void interpolate_all(const DevicePoints& points, Index n, const Field& x,
                                            Real (&u)[3]) {
  u[0] = u[1] = u[2] = 0;
  for (Index i = points.begin(n); i < points.begin(n + 1); ++i) {
    const Real w = points.weight(i);
    const Index p = points.unknown(i);
    for (int d = 0; d < 3; ++d) u[d] += w * x(p, d);
  }
}

/// Points and which of them act on an unknown.
struct PointRows {
  DevicePoints points;
  Array<Index> row;        ///< [T] unknowns touched, ascending
  Array<Index> row_begin;  ///< [T+1]
  Array<Index> row_entry;  ///< into points.unknown
  Array<Index> row_point;  ///< the point of each of these, …
  Array<Real> row_weight;  ///< … and its weight: products read them one after the other

  KOKKOS_INLINE_FUNCTION bool any() const { return points.count > 0; }
};
PointRows make_point_rows(const MaterialPoints& points, Index unknowns);

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

/// y += scale · Nᵀ value.
void scatter(const PointRows& rows, Real scale, const Field& value, const Field& y);

}  // namespace rockfold::solve
