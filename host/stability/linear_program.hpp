// Linear programmes, solved by CLP (COIN-OR).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Least cost·x where A x = right and 0 ≤ x ≤ upper; A by columns.
struct LinearProgram {
  explicit LinearProgram(std::vector<Real> right_side) : right(std::move(right_side)) {}

  std::vector<Real> right;        ///< [rows]
  std::vector<Real> row_size;     ///< [rows] what is small in a row is so in these units; empty: 1
  std::vector<Real> cost, upper;  ///< [columns]
  std::vector<Real> column_size;  ///< [columns] likewise
  std::vector<std::int32_t> begin{0};  ///< [columns + 1] into row and value
  std::vector<Index> row;
  std::vector<Real> value;

  Index columns() const { return static_cast<Index>(cost.size()); }
  /// One entry more of the column that add_column() ends.
  void add_entry(Index at, Real coefficient) {
    row.push_back(at);
    value.push_back(coefficient);
  }
  void add_column(Real of_cost, Real most, Real size = 1) {
    cost.push_back(of_cost);
    upper.push_back(most);
    column_size.push_back(size);
    begin.push_back(static_cast<std::int32_t>(row.size()));
  }
};

struct LinearSolution {
  Real cost = 0;
  std::vector<Real> x;      ///< [columns]
  std::vector<Real> price;  ///< [rows] what one unit more of `right` costs
  std::vector<unsigned char> column_status, row_status;  ///< CLP's basis
};

/// `before`: a solution of a programme with the same rows and of which this one's columns begin with the same; its basis is
/// where the search starts. Throws Error(analysis) if CLP finds none: programmes with a solution are the caller's duty.
LinearSolution solve(const LinearProgram& program, const LinearSolution* before = nullptr);

}  // namespace rockfold
