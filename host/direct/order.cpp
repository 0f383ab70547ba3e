#include "host/direct/order.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <metis.h>

namespace rockfold::host {

std::vector<Index> order_by_degree(const BlockMatrix& a) {
  using Pattern = Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>;
  const Index n = a.rows();
  const std::vector<Real> ones(a.column.size(), 1);
  const Eigen::Map<const Pattern> pattern(n, n, static_cast<Index>(a.column.size()), a.begin.data(),
                                          a.column.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> order;
  Eigen::AMDOrdering<Index>()(Pattern(pattern).selfadjointView<Eigen::Upper>(), order);
  // order.indices()[k]: the row that is eliminated as the k-th
  std::vector<Index> place(n);
  for (Index k = 0; k < n; ++k) place[order.indices()[k]] = k;
  return place;
}

std::vector<Index> order_by_dissection(const BlockMatrix& a) {
  const Index n = a.rows();
  std::vector<idx_t> begin{0}, neighbour, order(n), place(n);
  begin.reserve(n + 1);
  neighbour.reserve(a.column.size());
  for (Index i = 0; i < n; ++i) {
    for (Index m = a.begin[i]; m < a.begin[i + 1]; ++m)
      if (a.column[m] != i) neighbour.push_back(a.column[m]);
    begin.push_back(static_cast<idx_t>(neighbour.size()));
  }
  idx_t options[METIS_NOPTIONS], sizes[2];
  METIS_SetDefaultOptions(options);
  // As METIS_NodeND, but without handlers of its own for the signals that end a run.
  const int status = METIS_NodeNDP(n, begin.data(), neighbour.data(), nullptr, 1, options,
                                   order.data(), place.data(), sizes);
  if (status != METIS_OK) return {};
  return {place.begin(), place.end()};
}

}  // namespace rockfold::host
