#include "kernels/operator/point_rows_kernel.hpp"

namespace rockfold::solve {

DevicePoints upload(const MaterialPoints& points) {
  return {static_cast<Index>(points.size()), device::to_device("solve::point_begin", points.begin),
          device::to_device("solve::point_unknown", points.unknown),
          device::to_device("solve::point_weight", points.weight)};
}

void interpolate(const DevicePoints& points, const Field& x, const Field& value) {
  device::for_each(
      "rockfold::solve::interpolate", points.count, KOKKOS_LAMBDA(const Index n) {
        Real u[3];
        interpolate_all(points, n, x, u);
        for (int d = 0; d < 3; ++d) value(n, d) = u[d];
      });
}

/// Unknowns ascending, entries of an unknown ascending.
PointRows make_point_rows(const MaterialPoints& points, Index unknowns) {
  std::vector<Index> begin(static_cast<std::size_t>(unknowns) + 1, 0);
  for (const Index p : points.unknown) ++begin[p + 1];
  std::vector<Index> row, row_begin{0};
  for (Index p = 0; p < unknowns; ++p) {
    if (begin[p + 1] > 0) {
      row.push_back(p);
      row_begin.push_back(row_begin.back() + begin[p + 1]);
    }
    begin[p + 1] += begin[p];
  }
  std::vector<Index> entry(points.unknown.size()), point(entry.size());
  std::vector<Real> weight(entry.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
      const Index at = begin[points.unknown[i]]++;
      entry[at] = i;
      point[at] = static_cast<Index>(n);
      weight[at] = points.weight[i];
    }
  return {upload(points),
          device::to_device("solve::point_row", row),
          device::to_device("solve::point_row_begin", row_begin),
          device::to_device("solve::point_row_entry", entry),
          device::to_device("solve::point_of_row", point),
          device::to_device("solve::weight_of_row", weight)};
}

void scatter(const PointRows& rows, Real scale, const Field& value, const Field& y) {
  const auto row = rows.row, begin = rows.row_begin, point = rows.row_point;
  const auto weight = rows.row_weight;
  device::for_each(
      "rockfold::solve::scatter", static_cast<Index>(row.extent(0)), KOKKOS_LAMBDA(const Index t) {
        Real sum[3] = {0, 0, 0};
        for (Index i = begin(t); i < begin(t + 1); ++i) {
          const Real w = weight(i);
          const Index n = point(i);
          for (int d = 0; d < 3; ++d) sum[d] += w * value(n, d);
        }
        for (int d = 0; d < 3; ++d) y(row(t), d) += scale * sum[d];
      });
}

}  // namespace rockfold::solve
