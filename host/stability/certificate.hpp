// What proves a factor of the whole mass: forces that balance it and break no strength, velocities at which the loads do more work than
// the strength can take up. Checked by sums in rational arithmetic, by code that shares nothing with what found them.
#pragma once

#include <string>
#include <vector>

#include "host/stability/rigid_mass.hpp"

namespace rockfold {

/// Forces on the first body of each contact, N, at force_points() of the mass and in their order; all strength of joints divided by `factor`.
struct Balance {
  Real factor = 0;
  std::vector<Vec3> force;
  std::vector<Real> tension;  ///< N, of the mass' ties
};

struct BodyVelocity {
  Vec3 velocity{};  ///< of its centre, m/s; all velocities of a mechanism may be scaled together
  Vec3 spin{};      ///< rad/s
};

/// Velocities of all bodies; strength divided by `factor`.
struct Mechanism {
  Real factor = 0;
  std::vector<BodyVelocity> velocity;  ///< [bodies]
};

struct Certificate {
  RigidMass mass;
  /// The mass stands at `below.factor` if its slips dilate, and none moves at any factor above `above.factor` … in the sense of limit
  /// analysis: below.factor ≤ bound ≤ above.factor.
  Balance below;
  Mechanism above;  ///< empty where none is known
  /// A state of collapse without dilation; empty where none was found.
  Balance sliding_balance;
  Mechanism sliding_mechanism;
};

/// One thing that is wrong with a certificate; empty text: nothing.
struct Verdict {
  std::string
      wrong;  ///< "contact 12, corner 3: the force lies outside the friction cone by 2.1e-3 of it"
  Real residual = 0;  ///< the largest imbalance found, of the sizes of all forces on its body
  bool holds() const { return wrong.empty(); }
};

}  // namespace rockfold
