// Anderson's acceleration of a fixed-point iteration x ← x + f(x) (Anderson 1965; Walker & Ni 2011, type II): of the last few
// pairs of changes it forms the combination that would have made f smallest. For the linear, symmetric iteration of the
// multipliers this is as good as conjugate gradients on them, but does not mind that f is known inexactly.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold::solve {

class Anderson {
 public:
  explicit Anderson(std::size_t depth) : depth_(depth) {}

  /// The next x, from x and f(x).
  std::vector<Real> next(const std::vector<Real>& x, const std::vector<Real>& f);

  /// A new right-hand side: f has moved by a constant. What was learned of its slope stays true.
  void begin_again() { last_x_.clear(); }
  /// The slope of f has changed.
  void forget();

  /// What it knows of the slope, as numbers; [pairs][2][n].
  std::vector<Real> knowledge() const;
  /// `n`: unknowns. Throws std::invalid_argument where the numbers are not so many.
  void learn(const std::vector<Real>& knowledge, std::size_t n);

 private:
  /// A change of x and the change of f that comes with it; the df of all pairs are orthonormal. Where f is linear any
  /// combination of pairs is a pair, so that old ones can go one by one.
  struct Pair {
    std::vector<Real> dx, df;
  };
  void learn(Pair pair);

  std::size_t depth_;
  std::deque<Pair> pairs_;  ///< oldest first
  std::vector<Real> last_x_, last_f_;
};

}  // namespace rockfold::solve
