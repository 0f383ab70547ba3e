// A block that joint sets and an excavation would make, and how it moves: what the sections on
// tunnels and slopes of the theory share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/keyblock/motions/pyramid.hpp"
#include "host/keyblock/motions/sliding.hpp"
#include "host/keyblock/water/outline.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A joint set as block theory of joint sets alone sees it.
struct TheorySet {
  std::string name;
  Vec3 upward{};                 ///< unit normal
  Real friction = 0;             ///< tan φ
  Real cohesion = 0;             ///< Pa
  const Water* water = nullptr;  ///< of the model; null: TheoryLoads::water_pressure
};
std::vector<TheorySet> theory_sets(const Model& model);

/// What acts on every block.
struct TheoryLoads {
  Real density = 0;         ///< kg/m³
  Vec3 gravity{};           ///< m/s²
  Vec3 seismic{};           ///< fraction of g
  Real water_pressure = 0;  ///< Pa on joint faces of sets without a [[water]]
  Real target_safety = 1.5;
};
TheoryLoads theory_loads(const Model& model);

/// Geometry of a block: as many joint faces as its code has digits 0 and 1, in the order of the sets.
struct TheoryShape {
  Real volume = 0;               ///< m³
  Real free_area = 0;            ///< m²
  std::vector<Real> joint_area;  ///< m²
  /// In the order of the areas, with the slope's toe at the origin; empty of tunnels: where their blocks lie is not known.
  std::vector<JointOutline> joint_outline = {};
};

struct TheoryBlock {
  std::string code;  ///< Goodman & Shi's
  TheoryShape shape;
  Real weight = 0;                   ///< N
  std::optional<Movement> movement;  ///< planes are indices into the code's faces
  std::vector<std::string> planes;   ///< names of the sets it slides on
  bool key = false;                  ///< it moves
  Real support_force = 0;            ///< N, to the target factor of safety
  Real support_pressure = 0;         ///< Pa
};

/// The sets of a code's digits 0 and 1.
std::vector<std::size_t> sets_of(const std::string& code);

/// How a removable block of this code and shape moves. Throws std::invalid_argument for a code that
/// does not fit the sets.
TheoryBlock judge_theory_block(const std::vector<TheorySet>& sets, const std::string& code,
                               const TheoryShape& shape, const TheoryLoads& loads);

/// All codes that give `digits` of n sets the sides 0 and 1, and the others 2: 2^digits times n over
/// digits, in the order of the sets and ascending.
std::vector<std::string> codes_of(std::size_t n, std::size_t digits);

/// Names of the sets' upward normals in order.
std::vector<Vec3> upward_normals(const std::vector<TheorySet>& sets);

}  // namespace rockfold
