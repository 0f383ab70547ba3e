#include "host/cover/points/rows_apart.hpp"

#include <Eigen/Dense>

namespace rockfold {

namespace {

constexpr Real most = 100;  // times: more would slow the solver down for what rock hardly does

Real product(const std::map<Index, Real>& a, const std::map<Index, Real>& b) {
  Real sum = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (i->first < j->first)
      ++i;
    else if (j->first < i->first)
      ++j;
    else
      sum += i++->second * j++->second;
  }
  return sum;
}

}  // namespace

void RowsApart::take_in() {
  const MaterialPoints& points = fixed_.points;
  for (; next_ < points.size(); ++next_) {
    const Index n = static_cast<Index>(next_);
    if (points.begin[n + 1] - points.begin[n] == 1) {
      at_rest_.insert(points.unknown[points.begin[n]]);
      continue;
    }
    for (Index i = points.begin[next_]; i < points.begin[next_ + 1]; ++i) {
      const Index unknown = points.unknown[i];
      if (at_rest_.count(unknown) > 0) continue;
      row_[n][unknown] += points.weight[i];
      if (of_unknown_[unknown].empty() || of_unknown_[unknown].back() != n)
        of_unknown_[unknown].push_back(n);
    }
  }
}

std::vector<Index> RowsApart::neighbours(const std::map<Index, Real>& row) const {
  std::set<Index> found;
  for (const auto& [unknown, weight] : row)
    if (const auto at = of_unknown_.find(unknown); at != of_unknown_.end())
      found.insert(at->second.begin(), at->second.end());
  return {found.begin(), found.end()};
}

Real RowsApart::stiffening(const std::vector<Index>& unknown, const std::vector<Real>& weight) {
  take_in();
  std::map<Index, Real> row;
  Real whole = 0;
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    whole += weight[i] * weight[i];
    if (at_rest_.count(unknown[i]) == 0) row[unknown[i]] += weight[i];
  }
  Real own = product(row, row);
  const std::vector<Index> near = neighbours(row);
  if (const auto count = static_cast<Eigen::Index>(near.size()); count > 0) {
    Eigen::MatrixXd gram(count, count);
    Eigen::VectorXd right(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto& other = row_.at(near[i]);
      right[i] = product(other, row);
      for (Eigen::Index j = 0; j <= i; ++j)
        gram(i, j) = gram(j, i) = product(other, row_.at(near[j]));
    }
    own -= right.dot(gram.completeOrthogonalDecomposition().solve(right));
  }
  return own > whole / most ? whole / own : most;
}

}  // namespace rockfold
