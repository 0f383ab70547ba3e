#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/operator/operator_rows_kernel.hpp"
#include "kernels/precondition/direct_kernel.hpp"
#include "src/base/interrupt.hpp"

namespace rockfold::solve {
namespace {

/// Of systems with more covers no factors have been within reach.
constexpr Index most_covers = 300000;

/// Where the blocks of the operator's rows stand, padding included.
struct LoadedRows {
  Array<Index> begin;         ///< [P+1]
  std::vector<Index> column;  ///< none: padding
};

LoadedRows load_columns(const OperatorRows& rows, Index covers) {
  const auto count = device::allocate<Index>("solve::row_blocks", covers);
  device::for_each(
      "rockfold::solve::count_blocks", covers,
      KOKKOS_LAMBDA(const Index i) { count(i) = rows.count(i); });
  std::vector<Index> begin{0};
  for (Index n : device::to_host(count)) begin.push_back(begin.back() + n);
  LoadedRows loaded{device::to_device("solve::row_begin", begin), {}};
  const auto first = loaded.begin;
  const auto column = device::allocate<Index>("solve::row_column", begin.back());
  device::for_each(
      "rockfold::solve::load_columns", covers, KOKKOS_LAMBDA(const Index i) {
        for (Index m = first(i); m < first(i + 1); ++m) column(m) = rows.column(i, m - first(i));
      });
  loaded.column = device::to_host(column);
  return loaded;
}

/// The points of the terms on the host.
struct HostPoints {
  HostPoints(const PointTerms& terms, Index unknowns) : row_of(unknowns, none) {
    if (!terms.any()) return;
    begin = device::to_host(terms.points.begin);
    unknown = device::to_host(terms.points.unknown);
    weight = device::to_host(terms.points.weight);
    row_begin = device::to_host(terms.row_begin);
    row_point = device::to_host(terms.row_point);
    row_weight = device::to_host(terms.row_weight);
    const std::vector<Index> row = device::to_host(terms.row);
    for (std::size_t t = 0; t < row.size(); ++t) row_of[row[t]] = static_cast<Index>(t);
    tangent.resize(terms.points.count);  // arrays may have room for more
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), terms.tangent);
    for (std::size_t n = 0; n < tangent.size(); ++n)
      for (int m = 0; m < 6; ++m) tangent[n][m] = host(n, m);
  }

  /// f(point, weight of the unknown, entry): all that is coupled with an unknown, point by point.
  template <class F>
  void for_each_coupling(Index of, const F& f) const {
    if (row_of[of] == none) return;
    for (Index k = row_begin[row_of[of]]; k < row_begin[row_of[of] + 1]; ++k)
      for (Index j = begin[row_point[k]]; j < begin[row_point[k] + 1]; ++j)
        f(row_point[k], row_weight[k], j);
  }

  std::vector<Index> begin, unknown;
  std::vector<Real> weight;
  std::vector<Index> row_of;  ///< [unknowns] none: no point acts on it
  std::vector<Index> row_begin, row_point;
  std::vector<Real> row_weight;
  std::vector<std::array<Real, 6>> tangent;
};

BlockMatrix find_pattern(const Operator& op, const TermLists& terms) {
  const LoadedRows rows = load_columns(rows_of(op, {}), op.covers);
  const std::vector<Index> begin = device::to_host(rows.begin);
  std::vector<HostPoints> points;
  for (const PointTerms* list : terms) points.emplace_back(*list, op.unknowns);
  std::vector<Index> seen_by(op.covers, none), columns;
  BlockMatrix a;
  a.width = 3 * op.functions;
  a.begin = {0};
  for (Index i = 0; i < op.covers; ++i) {
    columns.clear();
    const auto add = [&](Index column) {
      if (column == none || seen_by[column] == i) return;
      seen_by[column] = i;
      columns.push_back(column);
    };
    for (Index m = begin[i]; m < begin[i + 1]; ++m) add(rows.column[m]);
    for (const HostPoints& list : points)
      for (int k = 0; k < op.functions; ++k)
        list.for_each_coupling(k * op.covers + i,
                               [&](Index, Real, Index j) { add(list.unknown[j] % op.covers); });
    std::sort(columns.begin(), columns.end());
    a.column.insert(a.column.end(), columns.begin(), columns.end());
    a.begin.push_back(static_cast<Index>(a.column.size()));
  }
  return a;
}

Index find_block(const BlockMatrix& a, Index row, Index column) {
  const auto begin = a.column.begin();
  return static_cast<Index>(
      std::lower_bound(begin + a.begin[row], begin + a.begin[row + 1], column) - begin);
}

void add_terms(BlockMatrix& a, Index covers, int functions, const HostPoints& points) {
  const std::size_t width = a.width, size = width * width;
  std::vector<Index> block(covers);  // of the row's columns
  for (Index i = 0; i < covers; ++i) {
    for (Index m = a.begin[i]; m < a.begin[i + 1]; ++m) block[a.column[m]] = m;
    for (int k = 0; k < functions; ++k)
      points.for_each_coupling(k * covers + i, [&](Index n, Real of_row, Index j) {
        const Index column = points.unknown[j];
        Real* to = &a.value[block[column % covers] * size + 3 * (column / covers) * width + 3 * k];
        const Real w = of_row * points.weight[j];
        for (int d = 0; d < 3; ++d)
          for (int e = 0; e < 3; ++e)
            to[d * width + e] += w * points.tangent[n][symmetric_entry(d, e)];
      });
  }
}

void fill_values(BlockMatrix& a, const Operator& op, const Combination& c, const TermLists& terms) {
  const std::size_t width = a.width, size = width * width;
  const OperatorRows rows = rows_of(op, c);
  const LoadedRows loaded = load_columns(rows, op.covers);
  const auto first = loaded.begin;
  const auto value = device::allocate<Real>("solve::row_value", loaded.column.size() * size);
  device::for_each(
      "rockfold::solve::load_blocks", op.covers,
      KOKKOS_LAMBDA(const Index i) {
        for (Index m = first(i); m < first(i + 1); ++m)
          rows.load(i, m - first(i), &value(m * size));
      },
      static_cast<Index>(size));
  const std::vector<Real> of_rows = device::to_host(value);
  const std::vector<Index> begin = device::to_host(first);
  a.value.assign(a.column.size() * size, 0);
  for (Index i = 0; i < op.covers; ++i)
    for (Index m = begin[i]; m < begin[i + 1]; ++m)
      if (loaded.column[m] != none)
        std::copy_n(&of_rows[m * size], size, &a.value[find_block(a, i, loaded.column[m]) * size]);
  for (const PointTerms* list : terms)
    add_terms(a, op.covers, op.functions, HostPoints(*list, op.unknowns));
}

Field diagonal_of(const BlockMatrix& a) {
  const Index covers = a.rows();
  const std::size_t width = a.width;
  std::vector<Vec3> diagonal(covers * width / 3);
  for (Index i = 0; i < covers; ++i)
    for (std::size_t e = 0; e < width; ++e)
      diagonal[e / 3 * covers + i][e % 3] = a.value[(find_block(a, i, i) * width + e) * width + e];
  Field field = device::make_field("solve::matrix_diagonal", static_cast<Index>(diagonal.size()));
  device::copy_to_device(diagonal, field);
  return field;
}

/// Where unknown u stands among those by covers.
std::size_t by_covers(const Factors& factors, std::size_t u) {
  const std::size_t covers = factors.pattern.rows(), width = factors.pattern.width;
  return u % covers * width + 3 * (u / covers);
}

}  // namespace

bool analyse(Factors& factors, const Operator& op, const TermLists& terms) {
  if (factors.analysed) return !factors.too_large;
  factors.analysed = true;
  if (!factors.solver) factors.solver = factors.make();
  if (op.covers > most_covers) {
    factors.too_large = true;
    return false;
  }
  BlockMatrix pattern = find_pattern(op, terms);
  if (pattern.begin == factors.pattern.begin && pattern.column == factors.pattern.column)
    return !factors.too_large;
  factors.pattern = std::move(pattern);
  factors.current = factors.of_this_step = false;
  factors.too_large = !factors.solver->analyse(factors.pattern);
  return !factors.too_large;
}

bool factorise(Factors& factors, const Operator& op, const Combination& c, const TermLists& terms,
               Real no_pivot) {
  factors.current = factors.of_this_step = false;
  if (interrupt_signal) return false;
  BlockMatrix a = factors.pattern;
  fill_values(a, op, c, terms);
  if (!factors.solver->factorise(a, no_pivot)) return false;
  factors.current = factors.of_this_step = true;
  factors.pivot = no_pivot;
  factors.diagonal = diagonal_of(a);
  return !interrupt_signal;
}

Real rounding_of_product(const Factors& factors, const KrylovWork& work, const Field& x) {
  // A sum of n products, many of which may be as large as the diagonal's, is off by some n roundings of those, and
  // its terms are sums themselves.
  const Real entries = static_cast<Real>(factors.pattern.column.size()) /
                       static_cast<Real>(factors.pattern.rows()) * factors.pattern.width;
  const Real unit = 4 * entries * std::numeric_limits<Real>::epsilon();
  const Field d = factors.diagonal, q = work.q;
  device::for_each(
      "rockfold::solve::product_rounding", static_cast<Index>(x.extent(0)),
      KOKKOS_LAMBDA(const Index u) {
        for (int i = 0; i < 3; ++i) q(u, i) = unit * d(u, i) * x(u, i);
      });
  return std::sqrt(dot(work, q, q));
}

void precondition(const Factors& factors, const Field& r, const Field& z) {
  std::vector<Vec3> field = device::copy_to_host(r);
  std::vector<Real> values(3 * field.size());
  for (std::size_t u = 0; u < field.size(); ++u)
    std::copy_n(field[u].data(), 3, &values[by_covers(factors, u)]);
  factors.solver->solve(values);
  for (std::size_t u = 0; u < field.size(); ++u)
    std::copy_n(&values[by_covers(factors, u)], 3, field[u].data());
  device::copy_to_device(field, z);
}

}  // namespace rockfold::solve
