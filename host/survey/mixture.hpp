// Sets among poles as a mixture of distributions: each set Fisher's about an axis, its poles pointing either way, and beside all of
// them poles that are uniform. With t = μ·x, relative to uniform poles,
//
//   f(x) = π₀ + Σ_k π_k g(x; μ_k, κ_k),   g = κ cosh(κ t)/sinh κ.
//
// The most likely μ, κ and π are found by expectation and maximisation (Dempster, Laird & Rubin, J. R. Stat. Soc. B 39, 1977; for
// Fisher's distribution Banerjee et al., J. Mach. Learn. Res. 6, 2005), sets added one by one where they raise the likelihood most
// (Verbeek, Vlassis & Kröse, Neural Comput. 15, 2003). How many there are is for the Bayesian criterion to say (Schwarz, Ann. Stat. 6,
// 1978): −2 ln L + 4 K ln N is least, with four numbers (two of the mean, κ, π) to a set.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// One set of a mixture.
struct AxialSet {
  Vec3 mean{};     ///< unit
  Real kappa = 0;  ///< at most narrowest_kappa
  Real share = 0;  ///< π_k of all poles, by weight
};

struct AxialMixture {
  std::vector<AxialSet> sets;  ///< the largest share first
  Real background = 1;         ///< π₀
  Real log_likelihood =
      0;               ///< Σ w ln f, weights scaled so that they add up to Kish's effective number
  Real criterion = 0;  ///< Schwarz's

  /// The chance that an axis belongs to each set, and last to none.
  std::vector<Real> memberships(const Vec3& axis) const;
};

/// A compass reading is good to a degree or two (ISRM, Int. J. Rock Mech. Min. Sci. 15, 1978, 319–368), so no set is narrower than with
/// σ = 1°: κ = 1/σ². Without a limit a set of coinciding poles would have an infinite likelihood.
inline constexpr Real narrowest_kappa = 3282.8;  // (180/π)²
/// A set has four numbers: fewer than five poles do not tell of it.
inline constexpr Real least_poles_of_set = 5;
/// Most sets that are looked for unasked, and at all: a net with more of them is not read any more.
inline constexpr std::size_t most_sets_unasked = 8, most_sets = 12;

/// The criterion of each number of sets, from 0, and the mixture that has been chosen.
struct SetSearch {
  AxialMixture found;
  std::vector<Real>
      criteria;  ///< [K + 1] up to the last number tried; one more would make sets of fewer than five poles
};

/// Unit vectors of either sign and weights > 0. With `count` exactly that many sets, 0 ≤ count ≤ most_sets. No chance is in it: the same
/// poles in the same order give the same sets.
SetSearch find_axial_sets(std::span<const Vec3> poles, std::span<const Real> weights,
                          std::optional<std::size_t> count = {});

}  // namespace rockfold
