// A rigid mass on springs in its contacts: how pressure spreads, and whether friction without dilation holds the mass or lets it creep.
//
// Springs press where areas close, and hold slips up to the strength there: friction times the pressure, and cohesion. What does not balance
// moves against a drag, as masses do in the first instant of a fall: mass · (x − x_before) / span, steps with an ever longer span. A mass that
// stands comes to rest; of one that does not, the velocity becomes steady, and that is how it fails. Each step is solved by Newton's method with
// Coulomb's law in its tangent, slips counted from the start, as loads that only grow make them. That law has no potential, and where steps do
// not converge it may even drive what swings: then the mass is shaken to rest, or to where it only creeps, with every slip that stays remembered,
// as friction takes energy alone; steps go on from there with such slips.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "host/stability/mass_scale.hpp"

namespace rockfold {

enum class Ending : std::uint8_t { stands, creeps, undecided };

class SpringMass {
 public:
  explicit SpringMass(const ScaledMass& scaled);
  ~SpringMass();

  /// In the scaled mass' units; a spring of one mean area gives way by 1 under one force.
  struct State {
    std::vector<Real> displacement, velocity;  ///< [rows]
    std::vector<std::array<Real, 2>> slip;     ///< [corners] that stays
    std::vector<Real> pressure;                ///< [corners of all contacts, in order]
    std::vector<Real> tension;                 ///< [ties]
    bool shaken = false;                       ///< then slips are remembered
    Ending ending = Ending::undecided;
  };
  State start() const;

  /// With all strength times `share` = 1/F, from a state near by, until it is at rest or the change of velocity from step to step is no more
  /// than `steady` of it.
  State settle(Real share, State from, Real steady);

  /// Of a state that creeps: all that resists its motion, over what drives it, at full strength: its own factor; the least of those parts
  /// that do not press on each other.
  Real factor(const State& state) const;

  std::vector<BodyVelocity> velocities(const State& state) const {
    return scaled_.velocities(state.velocity);
  }

 private:
  struct Corner {
    std::array<Index, 2> body{};
    Real stiffness = 0;                            ///< along the normal; half of it across
    Real friction = 0, cohesion = 0, tension = 0;  ///< tan φ; forces

    /// What it bears in tension at a share of its strength, up to the apex of its cone.
    Real pull(Real share) const {
      return friction > 0 ? std::min(share * tension, cohesion / friction) : share * tension;
    }
  };
  struct Step;
  struct Equations;

  void weigh_for_shaking();
  void look(Step& step, bool with_tangents = true) const;
  void pull(Step& step) const;
  bool newton(Step& step, Index patience);
  void shake(Step& step) const;

  const ScaledMass& scaled_;
  std::vector<Corner> corners_;
  std::vector<Real> load_, mass_;  ///< [rows]
  std::unique_ptr<Equations> equations_;
};

}  // namespace rockfold
