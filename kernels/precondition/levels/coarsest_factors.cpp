#include <algorithm>
#include <utility>

#include "kernels/precondition/levels/coarsest_factors_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Which blocks stand in each row.
std::vector<std::vector<std::size_t>> blocks_of_rows(const HostBlocks& a) {
  std::vector<std::vector<std::size_t>> of(a.covers);
  for (std::size_t b = 0; b < a.row.size(); ++b) of[a.row[b]].push_back(b);
  return of;
}

/// By unknowns.
struct HostRows {
  std::vector<Index> begin{0}, column;
  std::vector<Real> value;
};

HostRows by_unknowns(const HostBlocks& a) {
  const std::size_t width = a.width;
  HostRows rows;
  std::vector<Index> place(a.covers, none), columns;
  const auto of_rows = blocks_of_rows(a);
  for (Index p = 0; p < a.covers; ++p) {
    columns.clear();
    for (const std::size_t b : of_rows[p]) columns.push_back(a.column[b]);
    std::sort(columns.begin(), columns.end());
    for (std::size_t k = 0; k < columns.size(); ++k) place[columns[k]] = static_cast<Index>(k);
    const std::size_t first = rows.value.size(), length = columns.size() * width;
    rows.value.resize(first + width * length, 0);
    for (const std::size_t b : of_rows[p])
      for (std::size_t f = 0; f < width; ++f)
        for (std::size_t e = 0; e < width; ++e)
          rows.value[first + e * length + place[a.column[b]] * width + f] =
              a.value[b * a.size() + f * width + e];
    for (std::size_t e = 0; e < width; ++e) {
      for (const Index q : columns)
        for (std::size_t f = 0; f < width; ++f)
          rows.column.push_back(static_cast<Index>(q * width + f));
      rows.begin.push_back(static_cast<Index>(rows.column.size()));
    }
  }
  return rows;
}

}  // namespace

Real* HostBlocks::at(Index p, Index q) {
  const auto [found, is_new] = known.try_emplace(std::int64_t{p} * covers + q, row.size());
  if (is_new) {
    row.push_back(p);
    column.push_back(q);
    value.resize(value.size() + size(), 0);
  }
  return &value[found->second * size()];
}

void add_rows(HostBlocks& to, const CoverMatrix& a) {
  const std::vector<Index> begin = device::to_host(a.begin), column = device::to_host(a.column);
  const std::vector<Real> value = device::to_host(a.value);
  for (Index p = 0; p < a.covers; ++p)
    for (Index k = begin[p]; k < begin[p + 1]; ++k) {
      Real* block = to.at(p, column[k]);
      for (std::size_t e = 0; e < to.size(); ++e) block[e] += value[k * to.size() + e];
    }
}

void add_points(HostBlocks& to, const DevicePoints& points,
                const std::vector<std::array<Real, 6>>& tangent) {
  const std::vector<Index> begin = device::to_host(points.begin),
                           unknown = device::to_host(points.unknown);
  const std::vector<Real> weight = device::to_host(points.weight);
  for (std::size_t n = 0; n < tangent.size(); ++n)
    for (Index i = begin[n]; i < begin[n + 1]; ++i)
      for (Index j = begin[n]; j < begin[n + 1]; ++j) {
        const int k = unknown[i] / to.covers, l = unknown[j] / to.covers;
        Real* a = to.at(unknown[i] % to.covers, unknown[j] % to.covers);
        for (int d = 0; d < 3; ++d)
          for (int e = 0; e < 3; ++e)
            a[(3 * l + e) * to.width + 3 * k + d] +=
                weight[i] * weight[j] * tangent[n][symmetric_entry(d, e)];
      }
}

void factorise(CoarsestFactors& coarsest, const HostBlocks& a, Real shift, Real negligible) {
  HostRows rows = by_unknowns(a);
  const Index unknowns = static_cast<Index>(rows.begin.size()) - 1;
  for (Index u = 0; u < unknowns; ++u)
    for (Index k = rows.begin[u]; k < rows.begin[u + 1]; ++k)
      if (rows.column[k] == u) rows.value[k] *= 1 + shift;
  if (rows.begin != coarsest.begin || rows.column != coarsest.column) {
    coarsest.factors = SparseCholesky(rows.begin, rows.column);
    coarsest.begin = rows.begin;
    coarsest.column = rows.column;
    coarsest.x.resize(unknowns);
  }
  coarsest.factors.factorise(rows.begin, rows.column, rows.value, negligible);
}

}  // namespace rockfold::solve
