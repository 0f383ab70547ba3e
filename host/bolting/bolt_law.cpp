#include "host/bolting/bolt_law.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace rockfold {
namespace {

constexpr Real steel_modulus = 200e9;  // Pa
constexpr Real steel_yield = 500e6;    // Pa

/// Of the bar, what does not give is as much stiffer.
constexpr Real rigid = 1e6;
/// Of its stiffness, what a bar has that is pushed: it leaves its hole.
constexpr Real pushed = 1e-6;

Real section_of(const BoltType& type) {
  const Real d = diameter_of(type);
  return std::numbers::pi / 4 * d * d;
}

}  // namespace

Real diameter_of(const BoltType& type) {
  return type.diameter.value_or(
      std::sqrt(4 / std::numbers::pi * type.force_capacity / steel_yield));
}

BoltLaw bolt_law(const BoltType& type, Real length) {
  const bool discrete = type.coupling == Coupling::dmfc;
  BoltLaw law;
  law.section = discrete && !type.diameter
                    ? type.stiffness * length
                    : type.young_modulus.value_or(steel_modulus) * section_of(type);
  law.strength = type.force_capacity;
  law.yield = type.yield ? std::min(*type.yield * section_of(type), law.strength) : law.strength;
  law.rupture = type.rupture.value_or(0);
  law.reach = type.displacement_capacity;
  law.stiffness = type.stiffness;
  law.shear_strength = type.shear_capacity;
  law.bond_stiffness =
      type.bond_stiffness.value_or(discrete ? rigid * law.section / (length * length)
                                            : 4 * type.stiffness * type.stiffness / law.section);
  law.bond_strength = type.bond_strength.value_or(std::numeric_limits<Real>::infinity());
  law.plate_stiffness = rigid * law.section / length;
  law.plate_strength = type.plate_capacity;
  law.pretension = type.pretension.value_or(type.action == BoltAction::active ? law.strength : 0);
  law.pushed = pushed;
  return law;
}

Dowel dowel_of(const BoltType& type, const Material& rock) {
  const Real d = diameter_of(type), fourth = d * d * d * d;
  const Real bending = type.young_modulus.value_or(steel_modulus) * std::numbers::pi / 64 * fourth;
  const Real modulus = 0.65 * std::pow(rock.young_modulus * fourth / bending, 1.0 / 12) *
                       rock.young_modulus / (1 - rock.poisson_ratio * rock.poisson_ratio);
  const Real beta = std::pow(modulus / (4 * bending), 0.25);
  return {modulus / (4 * beta), 2 * std::numbers::pi / (4 * beta)};
}

}  // namespace rockfold
