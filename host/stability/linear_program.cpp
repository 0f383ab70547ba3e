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

}  // namespace

LinearSolution solve(const LinearProgram& program, const LinearSolution* before) {
  const int rows = static_cast<int>(program.right.size()), columns = program.columns();
  std::vector<int> length(static_cast<std::size_t>(columns));
  for (int c = 0; c < columns; ++c) length[c] = program.begin[c + 1] - program.begin[c];
  const CoinPackedMatrix matrix(true, rows, columns, static_cast<CoinBigIndex>(program.row.size()),
                                program.value.data(), program.row.data(), program.begin.data(),
                                length.data());
  const std::vector<Real> lower(static_cast<std::size_t>(columns), 0.0);
  ClpSimplex clp;
  clp.setLogLevel(0);
  clp.scaling(
      0);  // the programme comes scaled; with warm starts, CLP's own scaling ended with columns that price in
  clp.loadProblem(matrix, lower.data(), program.upper.data(), program.cost.data(),
                  program.right.data(), program.right.data());
  clp.setPrimalTolerance(1e-9);
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
  return {clp.objectiveValue(), take(clp.primalColumnSolution(), columns),
          take(clp.dualRowSolution(), rows), take(clp.statusArray(), columns),
          take(clp.statusArray() + columns, rows)};
}

}  // namespace rockfold
