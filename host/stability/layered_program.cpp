#include "host/stability/layered_program.hpp"

#include <algorithm>

namespace rockfold {
namespace {

/// CLP's name for what becomes of a column or row beside the basis.
constexpr unsigned char at_lower_bound = 3;
/// Of the cost: a layer that costs no more bears what is passed on to it.
constexpr Real free_of_cost = 1e-9;

/// Some of the rows and columns.
struct Part {
  std::vector<Index> rows, columns;
};

class Layers {
 public:
  Layers(const LinearProgram& program, const std::vector<Index>& layer)
      : program_(program), layer_(layer), place_(layer.size(), none) {
    const auto columns = static_cast<std::size_t>(program.columns());
    first_layer_.assign(columns, none);
    for (Index c = 0; c < program.columns(); ++c) {
      for (std::int32_t e = program.begin[c]; e < program.begin[c + 1]; ++e) {
        const Index reached = layer[program.row[e]];
        first_layer_[c] = first_layer_[c] == none ? reached : std::min(first_layer_[c], reached);
      }
    }
    solution_.x.assign(columns, 0);
    solution_.column_status.assign(columns, at_lower_bound);
    solution_.row_status.assign(layer.size(), at_lower_bound);
  }

  LinearSolution solve_all() {
    const Index count = 1 + *std::max_element(layer_.begin(), layer_.end());
    for (Index k = 0; k < count; ++k) {
      const Part own = part(k, k);
      const Real cost = keep(own, solve(programme(own, passed_on(k))));
      if (k == 0 || k + 1 == count || cost <= free_of_cost) continue;
      const Part all = part(0, k);
      const LinearSolution start = basis(all);
      keep(all, solve(programme(all, program_.right), &start));
    }
    return solve(program_, &solution_);
  }

 private:
  Part part(Index first, Index last) const {
    const auto within = [&](Index layer) { return first <= layer && layer <= last; };
    Part part;
    for (Index r = 0; r < static_cast<Index>(layer_.size()); ++r)
      if (within(layer_[r])) part.rows.push_back(r);
    for (Index c = 0; c < program_.columns(); ++c)
      if (within(first_layer_[c])) part.columns.push_back(c);
    return part;
  }

  /// What layers before one leave of the right side.
  std::vector<Real> passed_on(Index layer) const {
    std::vector<Real> right = program_.right;
    for (Index c = 0; c < program_.columns(); ++c) {
      if (first_layer_[c] >= layer || solution_.x[c] == 0) continue;
      for (std::int32_t e = program_.begin[c]; e < program_.begin[c + 1]; ++e)
        right[program_.row[e]] -= solution_.x[c] * program_.value[e];
    }
    return right;
  }

  LinearProgram programme(const Part& part, const std::vector<Real>& right) {
    LinearProgram program({});
    std::fill(place_.begin(), place_.end(), none);
    for (const Index r : part.rows) {
      place_[r] = static_cast<Index>(program.right.size());
      program.right.push_back(right[r]);
      program.row_size.push_back(program_.row_size[r]);
    }
    for (const Index c : part.columns) {
      for (std::int32_t e = program_.begin[c]; e < program_.begin[c + 1]; ++e)
        if (const Index r = place_[program_.row[e]]; r != none)
          program.add_entry(r, program_.value[e]);
      program.add_column(program_.cost[c], program_.upper[c], program_.column_size[c]);
    }
    return program;
  }

  LinearSolution basis(const Part& part) const {
    LinearSolution basis;
    for (const Index c : part.columns) basis.column_status.push_back(solution_.column_status[c]);
    for (const Index r : part.rows) basis.row_status.push_back(solution_.row_status[r]);
    return basis;
  }

  Real keep(const Part& part, const LinearSolution& solved) {
    for (std::size_t k = 0; k < part.columns.size(); ++k) {
      solution_.x[part.columns[k]] = solved.x[k];
      solution_.column_status[part.columns[k]] = solved.column_status[k];
    }
    for (std::size_t k = 0; k < part.rows.size(); ++k)
      solution_.row_status[part.rows[k]] = solved.row_status[k];
    return solved.cost;
  }

  const LinearProgram& program_;
  const std::vector<Index>& layer_;
  std::vector<Index> first_layer_;  ///< [columns] that it reaches
  std::vector<Index> place_;        ///< [rows] in the part looked at
  LinearSolution solution_;         ///< of the layers so far
};

}  // namespace

LinearSolution solve_in_layers(const LinearProgram& program, const std::vector<Index>& layer) {
  return Layers(program, layer).solve_all();
}

}  // namespace rockfold
