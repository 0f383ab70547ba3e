// Factors of a mass, with all that the program proves of them checked.
#pragma once

#include <gtest/gtest.h>

#include "host/stability/sliding.hpp"
#include "host/stability/verify.hpp"

namespace rockfold::test {

struct Factors {
  Bound bound;      ///< with dilation
  Sliding sliding;  ///< without
};

/// Checked: proved from both sides, which meet.
inline Bound bound_of(const RigidMass& mass) {
  Progress silent;
  Bound bound = find_bound(mass, silent);
  if (!bound.below.force.empty() && !bound.above.velocity.empty()) {
    const Verdict verdict = verify({mass, bound.below, bound.above, {}, {}});
    EXPECT_TRUE(verdict.holds()) << verdict.wrong;
    EXPECT_LE(bound.above.factor / bound.below.factor - 1, 2 * bound_tolerance);
    EXPECT_GE(bound.above.factor, bound.below.factor);
  }
  return bound;
}

/// Checked: what is found is a state of collapse, not above the bound, and the mass stands a little below.
inline Factors factors_of(const RigidMass& mass) {
  Progress silent;
  Factors found{bound_of(mass), {}};
  found.sliding = find_sliding(mass, found.bound, silent);
  if (const auto& [bound, sliding] = found; sliding.answer == Sliding::Answer::fails) {
    EXPECT_TRUE(sliding.proved());
    EXPECT_TRUE(sliding.stands_below);
    EXPECT_LE(sliding.factor, bound.above.factor);
    const Verdict verdict =
        verify({mass, bound.below, bound.above, sliding.balance, sliding.mechanism});
    EXPECT_TRUE(verdict.holds()) << verdict.wrong;
  }
  return found;
}

inline Sliding sliding_of(const RigidMass& mass) {
  return factors_of(mass).sliding;
}

}  // namespace rockfold::test
