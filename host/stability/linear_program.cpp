#include "host/stability/linear_program.hpp"

#include <algorithm>

#include <ClpSimplex.hpp>
#include <CoinPackedMatrix.hpp>
#include <fmt/format.h>

#include "src/base/error.hpp"

namespace rockfold {
namespace {

/// CLP's names for what becomes of a column beside the basis.
constexpr unsigned char at_lower_bound = 3;

void start_from(ClpSimplex& clp, const LinearProgram& program, const LinearSolution& before) {
  std::vector<unsigned char> status = before.column_status;
  status.resize(static_cast<std::size_t>(program.columns()), at_lower_bound);
  std::copy(status.begin(), status.end(), clp.statusArray());
  std::copy(before.row_status.begin(), before.row_status.end(),
            clp.statusArray() + program.columns());
}

/// The same in units in which all that is small is far below 1.
struct Sized {
  std::vector<Real> row_size, value, right, cost, upper;

  explicit Sized(const LinearProgram& program)
      : row_size(program.row_size),
        value(program.value),
        right(program.right),
        cost(program.cost),
        upper(program.upper) {
    row_size.resize(right.size(), 1);
    for (std::size_t r = 0; r < right.size(); ++r) right[r] /= row_size[r];
    for (std::size_t c = 0; c < cost.size(); ++c) {
      const Real size = program.column_size[c];
      cost[c] *= size;
      upper[c] /= size;
      for (std::int32_t e = program.begin[c]; e < program.begin[c + 1]; ++e)
        value[e] *= size / row_size[program.row[e]];
    }
  }
};

}  // namespace

LinearSolution solve(const LinearProgram& program, const LinearSolution* before) {
  const int rows = static_cast<int>(program.right.size()), columns = program.columns();
  std::vector<int> length(static_cast<std::size_t>(columns));
  for (int c = 0; c < columns; ++c) length[c] = program.begin[c + 1] - program.begin[c];
  const Sized sized(program);
  const CoinPackedMatrix matrix(true, rows, columns, static_cast<CoinBigIndex>(program.row.size()),
                                sized.value.data(), program.row.data(), program.begin.data(),
                                length.data());
  const std::vector<Real> lower(static_cast<std::size_t>(columns), 0.0);
  ClpSimplex clp;
  clp.setLogLevel(0);
  clp.scaling(
      0);  // the programme comes scaled; with warm starts, CLP's own scaling ended with columns that price in
  clp.loadProblem(matrix, lower.data(), sized.upper.data(), sized.cost.data(), sized.right.data(),
                  sized.right.data());
  clp.setPrimalTolerance(1e-11);  // a hundredth of the imbalance that the verifier allows
  clp.setDualTolerance(1e-9);
  clp.createStatus();
  if (before) {
    start_from(clp, program, *before);
    clp.primal();
  } else {
    clp.dual();
  }
  if (clp.status() != 0) clp.primal();
  if (clp.status() != 0)
    throw Error(
        ErrorKind::analysis,
        fmt::format(
            "the linear programme of {} rows and {} columns found no solution (CLP, status {})",
            rows, columns, clp.status()));
  const auto take = [](const auto* from, int count) { return std::vector(from, from + count); };
  LinearSolution solution{clp.objectiveValue(), take(clp.primalColumnSolution(), columns),
                          take(clp.dualRowSolution(), rows), take(clp.statusArray(), columns),
                          take(clp.statusArray() + columns, rows)};
  for (int r = 0; r < rows; ++r) solution.price[r] /= sized.row_size[r];
  for (int c = 0; c < columns; ++c) solution.x[c] *= program.column_size[c];
  return solution;
}

}  // namespace rockfold
