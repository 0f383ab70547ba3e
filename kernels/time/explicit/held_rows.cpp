#include <cmath>
#include <numeric>

#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

/// Of a row's own size: what is left of one that others make up is rounding.
constexpr Real independent = 1e-8;

/// A row and what it is of the points chosen so far.
struct Row {
  Index point = 0;
  std::vector<Real> weight, combine;
};

/// On the host: the arrays of HeldRows.
struct Lists {
  std::vector<Index> cover, begin{0}, point;
  std::vector<int> component;
  std::vector<Real> combine, row, way;
};

std::vector<Real> times_inverse(const Real* inverse, int n, const std::vector<Real>& row) {
  std::vector<Real> product(n, 0);
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) product[k] += inverse[k * n + l] * row[l];
  return product;
}

Real dot(const std::vector<Real>& a, const std::vector<Real>& b) {
  Real sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// Gram and Schmidt with the largest row first, in the measure of the inverse mass.
void add_set(Index cover, int component, std::vector<Row> rows, const Real* inverse, int n,
             Lists& to) {
  std::vector<Real> size_at_first;
  for (const Row& row : rows)
    size_at_first.push_back(dot(row.weight, times_inverse(inverse, n, row.weight)));
  int chosen = 0;
  for (; chosen < n; ++chosen) {
    std::size_t best = rows.size();
    Real most = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Real size = dot(rows[r].weight, times_inverse(inverse, n, rows[r].weight));
      if (!(size > independent * size_at_first[r]) || !(size > most)) continue;
      best = r;
      most = size;
    }
    if (best == rows.size()) break;
    Row& row = rows[best];
    row.combine.resize(n, 0);
    row.combine[chosen] += 1;
    const Real scale = 1 / std::sqrt(most);
    for (Real& w : row.weight) w *= scale;
    for (Real& c : row.combine) c *= scale;
    const std::vector<Real> way = times_inverse(inverse, n, row.weight);
    to.point.push_back(row.point);
    to.row.insert(to.row.end(), row.weight.begin(), row.weight.end());
    to.way.insert(to.way.end(), way.begin(), way.end());
    to.combine.insert(to.combine.end(), row.combine.begin(), row.combine.end());
    const Row unit = row;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (r == best) {
        rows[r].weight.assign(n, 0);
        continue;
      }
      const Real share = dot(rows[r].weight, way);
      rows[r].combine.resize(n, 0);
      for (int k = 0; k < n; ++k) {
        rows[r].weight[k] -= share * unit.weight[k];
        rows[r].combine[k] -= share * unit.combine[k];
      }
    }
  }
  if (chosen == 0) return;
  to.cover.push_back(cover);
  to.component.push_back(component);
  to.begin.push_back(static_cast<Index>(to.point.size()));
}

}  // namespace

HeldRows find_held_rows(const Motion::Data& m) {
  const solve::Springs& springs = m.system.springs;
  HeldRows held;
  const int n = held.functions = m.explicit_scheme.functions;
  if (!springs.any()) return held;
  const std::vector<Index> begin = device::to_host(springs.points.begin),
                           unknown = device::to_host(springs.points.unknown);
  const std::vector<Real> weight = device::to_host(springs.points.weight),
                          inverse = device::to_host(m.explicit_scheme.inverse);
  const std::vector<Vec3> is_held = device::copy_to_host(springs.held);
  std::vector<std::vector<Row>> rows(static_cast<std::size_t>(m.covers) * 3);
  for (Index p = 0; p < springs.points.count; ++p)
    for (int d = 0; d < 3; ++d) {
      if (!(is_held[p][d] > 0) || begin[p] == begin[p + 1]) continue;
      Row row{p, std::vector<Real>(n, 0), {}};
      for (Index i = begin[p]; i < begin[p + 1]; ++i)
        row.weight[unknown[i] / m.covers] += weight[i];
      rows[static_cast<std::size_t>(unknown[begin[p]] % m.covers) * 3 + d].push_back(row);
    }
  Lists lists;
  for (std::size_t s = 0; s < rows.size(); ++s)
    if (!rows[s].empty())
      add_set(static_cast<Index>(s / 3), static_cast<int>(s % 3), std::move(rows[s]),
              &inverse[s / 3 * n * n], n, lists);
  held.sets = static_cast<Index>(lists.cover.size());
  std::vector<Index> of_block(m.covers + 1, 0);
  for (const Index p : lists.cover) ++of_block[p + 1];
  std::partial_sum(of_block.begin(), of_block.end(), of_block.begin());
  held.of_block = device::to_device("motion::held_of_block", of_block);
  held.cover = device::to_device("motion::held_cover", lists.cover);
  held.component = device::to_device("motion::held_component", lists.component);
  held.begin = device::to_device("motion::held_begin", lists.begin);
  held.point = device::to_device("motion::held_point", lists.point);
  held.combine = device::to_device("motion::held_combine", lists.combine);
  held.row = device::to_device("motion::held_row", lists.row);
  held.way = device::to_device("motion::held_way", lists.way);
  held.impulse = Array<Real>("rockfold::motion::held_impulse", lists.point.size());
  return held;
}

}  // namespace rockfold::motion
