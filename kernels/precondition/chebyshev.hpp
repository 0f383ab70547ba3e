// Chebyshev's iteration as a smoother, and the eigenvalue that it needs to know.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold::solve {

/// Chebyshev's iteration on [share · largest, largest] (Saad, algorithm 12.1): step k is old · previous step + now · B r.
class Chebyshev {
 public:
  Chebyshev(Real largest, Real share)
      : middle_(0.5 * (1 + share) * largest),
        half_(0.5 * (1 - share) * largest),
        rho_(half_ / middle_) {}
  Real first() const { return 1 / middle_; }
  void next() {
    const Real rho = 1 / (2 * middle_ / half_ - rho_);
    old_ = rho * rho_;
    now_ = 2 * rho / half_;
    rho_ = rho;
  }
  Real old_share() const { return old_; }
  Real new_share() const { return now_; }

 private:
  Real middle_, half_, rho_;
  Real old_ = 0, now_ = 0;
};

/// The largest eigenvalue of a symmetric tridiagonal matrix, by bisection (Golub & Van Loan 8.4.1).
inline Real largest_of_tridiagonal(const std::vector<Real>& diagonal,
                                   const std::vector<Real>& beside) {
  Real low = 0, high = 0;
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    high = std::max(
        high, diagonal[i] + (i > 0 ? beside[i - 1] : 0) + (i < beside.size() ? beside[i] : 0));
  for (int k = 0; k < 40; ++k) {
    const Real middle = 0.5 * (low + high);
    Real q = 1;
    bool all_below = true;
    for (std::size_t i = 0; i < diagonal.size() && all_below; ++i) {
      q = diagonal[i] - middle - (i > 0 ? beside[i - 1] * beside[i - 1] / q : 0);
      all_below = q < 0;
    }
    (all_below ? high : low) = middle;
  }
  return high;
}

/// The largest eigenvalue of D⁻¹A to a few percent, from above: Lanczos' method by way of conjugate gradients (Saad, §6.7.3).
/// `cg` is one system on a level: begin() gives r·Br of a random r, with d = B r; curvature() d·A d; advance(α) takes α A d off r and gives
/// the new r·Br; turn(β) makes d = B r + β d.
template <class ConjugateGradients>
Real estimate_largest_eigenvalue(ConjugateGradients& cg) {
  constexpr int steps = 12;     // find it to a few percent, from below
  constexpr Real margin = 1.1;  // for the rest: Chebyshev's iteration diverges above its interval
  std::vector<Real> diagonal, beside;
  Real energy = cg.begin(), alpha_before = 1, beta = 0;
  for (int k = 0; k < steps && energy > 0; ++k) {
    const Real alpha = energy / cg.curvature();
    if (!(alpha > 0) || !std::isfinite(alpha)) break;
    diagonal.push_back(1 / alpha + beta / alpha_before);
    const Real next = cg.advance(alpha);
    beta = next / energy;
    energy = next;
    alpha_before = alpha;
    cg.turn(beta);
    if (k + 1 < steps && energy > 0) beside.push_back(std::sqrt(beta) / alpha);
  }
  if (diagonal.empty()) return 1;
  beside.resize(diagonal.size() - 1);
  return margin * largest_of_tridiagonal(diagonal, beside);
}

/// The smoother of a coarsest level that is too large to be solved: its degree, and the share of the largest eigenvalue down to which it works.
inline constexpr int coarsest_degree = 16;
inline constexpr Real coarsest_share = 1.0 / 200;

}  // namespace rockfold::solve
