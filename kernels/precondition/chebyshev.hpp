// Chebyshev's iteration as a smoother, and the eigenvalue that it needs to know.
#pragma once

#include <algorithm>
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

}  // namespace rockfold::solve
