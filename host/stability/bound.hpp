// The factor by which the strength of all joints may be divided before forces no longer balance a mass of rigid blocks: limit analysis.
//
// Strength divided by F, some forces at contact points balance all bodies within it: F is below the bound (lower bound theorem). Some
// velocities part areas nowhere by less than friction makes them dilate, w_n ≥ (tan φ / F) |w_t|, and the loads do more work at them than
// cohesion and tension take up: F is above it (upper bound theorem). Drucker, Prager & Greenberg (1952); Livesley (1978) for blocks.
// Both come from one linear programme at a given F: the least sum of forces that must be added to the loads for a balance. Its dual is the
// mechanism; the sum and its slope over 1/F lead to the next F (Newton), so that a handful of programmes bring the two together.
// Friction cones are polygons whose edges are added where a mechanism slips (cutting planes): they end as round as it takes.
#pragma once

#include <optional>

#include "host/stability/certificate.hpp"
#include "host/stability/contact_columns.hpp"
#include "host/stability/rigid_mass.hpp"
#include "src/base/progress.hpp"

namespace rockfold {

/// below.factor ≤ bound ≤ above.factor.
struct Bound {
  /// Infinite: the mass stands without friction or cohesion; most_factor: it stands at that; then `above` is empty. 0: nothing balances it, and
  /// `below` is empty.
  Real factor = 0;
  Balance below;
  Mechanism above;
  Index programs = 0;  ///< linear programmes solved
  BalanceBasis basis;  ///< of `below`
};

/// Relative distance of the two sides that is sought.
constexpr Real bound_tolerance = 1e-5;
/// A mass that no strength this many times larger balances has factor 0.
constexpr Real most_strength = 100;
/// A mass that stands at this factor is held by forces that press on each other, not by its strength: no bound is looked for beyond.
constexpr Real most_factor = 1000;

Bound find_bound(const RigidMass& mass, Progress& progress);

}  // namespace rockfold
