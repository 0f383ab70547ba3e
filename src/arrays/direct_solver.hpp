// A matrix that is solved by its factors: what the kernels hand to the host where conjugate gradients alone do not get on.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// A symmetric matrix by rows of square blocks, one row for each physical cover. Both halves are given.
struct BlockMatrix {
  int width = 0;              ///< of a block
  std::vector<Index> begin;   ///< [P+1]
  std::vector<Index> column;  ///< [blocks] ascending in a row
  std::vector<Real> value;    ///< [blocks][width of the column][width of the row]

  Index rows() const { return static_cast<Index>(begin.size()) - 1; }
};

/// z = B r with B ≈ A⁻¹ for a symmetric A that is positive but for rounding. B is symmetric and positive semi-definite: of functions that
/// depend on each other it moves only some. It is the same for any number of threads.
class DirectSolver {
 public:
  DirectSolver() = default;
  virtual ~DirectSolver() = default;
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  /// Looks at where the blocks stand; values may be missing. False where factors would take more memory or operations than is
  /// sensible: then there is nothing to solve with.
  virtual bool analyse(const BlockMatrix& a) = 0;
  /// Multiplications of a factorisation, and entries of the factors, once analysed.
  virtual double operations() const = 0;
  virtual double entries() const = 0;
  /// The factors of A, which is as analysed, scaled to a unit diagonal. Pivots up to `least_pivot` count as none: what they stand for
  /// gets no answer. False where a signal came before the end.
  virtual bool factorise(const BlockMatrix& a, Real least_pivot) = 0;
  /// r becomes z; [P · width], by covers.
  virtual void solve(std::vector<Real>& r) = 0;
};

using MakeDirectSolver = std::function<std::unique_ptr<DirectSolver>()>;

}  // namespace rockfold
