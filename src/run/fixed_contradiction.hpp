// Prescribed displacements that cannot be true at once.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Two [[fixed]] that prescribe different displacements of the same rock.
struct Contradiction {
  std::array<Index, 2> condition{none, none};  ///< into Model::fixed, ascending
  int axis = 0;                                ///< in which direction: 0, 1, 2
  Index row = none;                            ///< of FixedPoints: where
  Real from = 0;                               ///< s: up to there they agree
  Real time =
      0;  ///< s, ≥ from: when they differ as follows; where they differ from the start, `from`
  std::array<Real, 2> displacement{};  ///< m, what each prescribes there and then
  /// Whether they hold the same point, or one all that moves the other's; else the covers alone cannot follow both.
  bool same_rock = false;
};

/// The first contradiction between t = 0 and `end` (s), of the same rock if there is one; nothing where there is none. Rows contradict each other where some combination
/// of them moves nothing and yet is prescribed to: A u = b(t) has no solution. That is looked for by elimination, of rows that come
/// to no more than 64 unknowns on the way, and between rows that are alike. Springs of given stiffness contradict nothing: they give.
std::optional<Contradiction> find_contradiction(const FixedPoints& fixed,
                                                const std::vector<Fixed>& conditions, Real end);

}  // namespace rockfold
