// The linear system of all physical covers: y = (αK + βM + γ NᵀkN) x, and its solution with fixed points.
// K: linear elastic stiffness, M: consistent mass, both integrated exactly; N: weights of the fixed points, k their stiffness.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "kernels/constraints/solve_report.hpp"
#include "kernels/operator/cover_vector.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/direct_solver.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold {

/// How the operator's rows are stored, for reports and benchmarks.
struct OperatorSize {
  Index stencil_rows = 0;       ///< covers whose couplings are constants of the lattice
  Index block_rows = 0;         ///< covers whose couplings are stored
  std::int64_t neighbours = 0;  ///< of the latter, summed
  int functions = 1;            ///< of a cover

  /// Stored 3×3 blocks that an application reads: all pairs of functions of neighbours, and of a cover with itself if it has
  /// more than one (of one function only the mass is read).
  double block_entries() const {
    return double(functions) * functions * (double(neighbours) + (functions > 1 ? block_rows : 0));
  }
  /// What one application must move, counted as STREAM counts (no write-allocate): 24 bytes of x and 24 of y a row, 80 of
  /// values an entry, 4 of column a neighbour.
  double bytes() const {
    return 48.0 * functions * (double(stencil_rows) + block_rows) + 80.0 * block_entries() +
           4.0 * double(neighbours);
  }
};

struct SystemCoefficients {
  Real stiffness = 1;  ///< α
  Real mass = 0;       ///< β, 1/s²
  Real springs = 1;    ///< γ
};

struct SolveOptions {
  Real tolerance = 1e-8;  ///< ‖r‖ / ‖b‖
  Index max_iterations = 5000;
};

class CoverSystem {
 public:
  CoverSystem(const CoverArrays& covers, const PieceMoments& moments,
              const std::vector<ElasticMaterial>& materials, const FixedPoints& fixed = {},
              Preconditioner preconditioner = Preconditioner::automatic,
              const MakeDirectSolver& direct = {});
  ~CoverSystem();
  CoverSystem(CoverSystem&&) noexcept;
  CoverSystem& operator=(CoverSystem&&) noexcept;

  Index covers() const;
  Index unknowns() const;  ///< U, see CoverArrays: the length of all vectors here
  OperatorSize size() const;

  void apply(const SystemCoefficients& c, const CoverVector& x, CoverVector& y) const;
  std::vector<Vec3> apply(const SystemCoefficients& c, const std::vector<Vec3>& x) const;

  /// Contact points with their symmetric tangents D, N/m, in place of those before: `solve` has Σ Nᵀ D N in its matrix.
  void set_contacts(const MaterialPoints& points, const std::vector<Mat3>& tangent);

  /// Solves (αK + βM + γ NᵀkN) x = b + γ Nᵀ k ū from the x given, with N x = ū at points that are held.
  SolveReport solve(const SystemCoefficients& c, const std::vector<Vec3>& b, std::vector<Vec3>& x,
                    const SolveOptions& options = {});

  /// [N] N: the force of each fixed point on the rock that moves by x, after a solve.
  std::vector<Vec3> reactions(const std::vector<Vec3>& x) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace rockfold
