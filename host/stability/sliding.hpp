// The factor at which a mass of rigid blocks fails whose slips do not dilate: friction takes room for none of them.
//
// Limit analysis does not hold for it: forces that balance the mass do not show that it stands, and more than one state of collapse may
// exist. What is sought is the one that a mass reaches whose joints are springs, all loads put on at once (spring_mass.hpp): blocks one by one
// with all others held, then the whole. Then a state of collapse of rigid blocks is made of it that is exact: slips that neither dilate nor
// overlap, and forces that balance every block and are at their strength on these slips (Gilbert, Casapulla & Ahmed 2006 solve the same linear
// programme, in turns with its dual).
#pragma once

#include "host/stability/bound.hpp"
#include "host/stability/certificate.hpp"
#include "host/stability/rigid_mass.hpp"
#include "src/base/progress.hpp"

namespace rockfold {

struct Sliding {
  enum class Answer : std::uint8_t {
    fails,     ///< at `factor`, by `mechanism`
    falls,     ///< at any strength: factor 0
    stands,    ///< at any: factor infinite
    not_found  ///< the search did not end
  };
  Answer answer = Answer::not_found;
  Real factor = 0;
  Mechanism mechanism;  ///< empty where it stands or none is found
  /// Forces that make a state of collapse of it; empty where none were found.
  Balance balance;
  /// One per cent below the factor the whole mass on springs was seen to stand; else it may fail earlier, by other blocks.
  bool stands_below = false;

  bool proved() const { return !balance.force.empty(); }
};

/// Relative distance of factors at which it was seen to stand and to fail.
constexpr Real sliding_tolerance = 1e-3;
/// A mass that fails at all factors down to this one falls.
constexpr Real least_factor = 0.01;

Sliding find_sliding(const RigidMass& mass, const Bound& bound, Progress& progress);

}  // namespace rockfold
