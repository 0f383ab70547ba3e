// How far points of a region are apart from each other for the covers that move them.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// Multipliers hold what little of a displacement does not follow from others as strictly as the rest; springs resist it by its square. These
/// have to be as much stiffer where penalty is to hold the same.
class RowsApart {
 public:
  /// `fixed`: whose rows from `first` on count.
  RowsApart(const FixedPoints& fixed, std::size_t first) : fixed_(fixed), next_(first) {}

  /// Times which the spring of a row, by unknowns and weights, has to be stiffer than one whose row is across those held so far.
  Real stiffening(const std::vector<Index>& unknown, const std::vector<Real>& weight);

 private:
  /// The rows since the last call.
  void take_in();
  std::vector<Index> neighbours(const std::map<Index, Real>& row) const;

  const FixedPoints& fixed_;
  std::size_t next_;
  std::set<Index> at_rest_;  ///< unknowns that are held each by itself
  std::map<Index, std::map<Index, Real>>
      row_;  ///< [point] the others' weights by unknowns that are not at rest
  std::map<Index, std::vector<Index>> of_unknown_;  ///< their points
};

}  // namespace rockfold
