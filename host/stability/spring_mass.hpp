// A rigid mass on springs in its contacts: how pressure spreads, and how the mass creeps where friction does not hold it.
//
// Springs press where areas close and hold slips up to a limit a point, which is given: so the state is the least of a convex potential, found by
// Newton's method with a line search. Limits that are friction times pressure follow by iteration over the pressure (settle()). A little drag
// on all velocities keeps a mass that nothing holds from running away: it creeps, as fast as what drives it over the drag.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "host/stability/mass_scale.hpp"

namespace rockfold {

class SpringMass {
 public:
  explicit SpringMass(const ScaledMass& scaled);
  ~SpringMass();

  /// In the scaled mass' units; a spring of one mean area gives way by 1 under one force.
  struct State {
    std::vector<Real> displacement;  ///< [rows]
    std::vector<Real> pressure;  ///< [corners of all contacts, in order] that limits are made of
    bool settled = false;        ///< pressure and limits agree
    Real fastest = 0;            ///< the largest jump across a contact
  };
  /// Undeformed, under an even pressure.
  State start() const;

  /// With all strength times `share` = 1/F, from a state near by.
  State settle(Real share, State from);

  /// Whether what holds the mass gives way by so little that it is no creep.
  static bool stands(const State& state) { return state.fastest < creeping; }

  /// Of a state that creeps: all that resists its motion, over what drives it, at full strength: its own factor.
  Real factor(const State& state) const;

  std::vector<BodyVelocity> velocities(const State& state) const {
    return scaled_.velocities(state.displacement);
  }

 private:
  static constexpr Real drag = 1e-8;
  /// Half way, in powers of ten, between what springs give and what drag leaves of a motion that nothing resists.
  static constexpr Real creeping = 1e5;

  struct Corner {
    ForcePoint point;
    std::array<Vec3, 3> axis;                      ///< normal and tangents
    Real stiffness = 0;                            ///< along the normal; half of it across
    Real friction = 0, cohesion = 0, tension = 0;  ///< tan φ; forces
  };
  struct Look {
    Real potential = 0;
    std::vector<Real> rest;      ///< [rows] forces that do not balance
    std::vector<Real> pressure;  ///< [corners]
    Real fastest = 0;
  };
  struct Equations;

  Look look(Real share, const State& state, bool with_tangent);
  void relax(Real share, State& state, Look& look);

  const ScaledMass& scaled_;
  std::vector<Corner> corners_;
  std::vector<Real> load_;  ///< [rows]
  std::unique_ptr<Equations> equations_;
};

}  // namespace rockfold
