// Rock support as the user means it: bolts, patterns of bolts, shotcrete, and the search for a pattern.
// docs/support_design.md says what each of them does.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/base/error.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Classes of reinforcement by how load passes between bolt and rock (thesis 3.2.3; Windsor & Thompson 1993).
enum class Coupling {
  cmc,   ///< continuously mechanically coupled: grouted all along
  cfc,   ///< continuously frictionally coupled: friction all along
  dmfc,  ///< discretely coupled: held at an anchor and a plate only
};

/// How a bolt enters the factor of safety.
enum class BoltAction {
  active,   ///< tensioned: it takes from the driving force
  passive,  ///< loaded by the block's motion: it adds to the resistance
};

/// What is left of the tensile capacity of a bolt that the block does not pull straight.
enum class BoltEfficiency {
  full,    ///< all of it
  cosine,  ///< times the cosine between bolt and motion
};

/// A kind of bolt with its capacities.
struct BoltType {
  std::string name;  ///< of the [[bolt_type]]; "" = given with the bolts
  Coupling coupling = Coupling::cmc;
  Real force_capacity = 0;            ///< N in tension, > 0
  Real displacement_capacity = 0;     ///< m, > 0
  Real plate_capacity = 0;            ///< N, ≥ 0; 0 = no plate; default force_capacity
  std::optional<Real> bond_strength;  ///< N per m of bolt, > 0; none = the bond never gives way
  std::optional<Real> anchor_length;  ///< m, > 0, of the anchor at the far end; dmfc only
  Real shear_capacity = 0;            ///< N across the bolt, ≥ 0
  Real stiffness = 0;                 ///< N/m, > 0; default force_capacity / displacement_capacity
  BoltAction action = BoltAction::passive;  ///< default active for dmfc
  BoltEfficiency efficiency = BoltEfficiency::full;
  std::optional<Real> mass_per_metre;  ///< kg/m, > 0

  // As elements of an analysis (host/bolting/bolt_law.hpp says what stands for those that are not given):
  std::optional<Real> young_modulus;   ///< Pa, > 0, of the steel
  std::optional<Real> diameter;        ///< m, > 0
  std::optional<Real> yield;           ///< Pa, > 0; at most force_capacity over the section
  std::optional<Real> rupture;         ///< > 0, strain
  std::optional<Real> bond_stiffness;  ///< N/m per m of bolt, > 0
  std::optional<Real> pretension;      ///< N, ≥ 0; at most force_capacity
};

/// Faces that bolts are drilled from: walls of an excavation or faces of a solid.
struct WallFaces {
  std::string name;         ///< as the model says it: "tunnel", "tunnel.side", "rock.xmin"
  bool excavation = false;  ///< of Model::excavations, else of Model::solids
  Index owner = none;
  std::vector<Index> faces;  ///< into face_names(shape)

  bool hold(const FaceOrigin& origin) const {
    return origin.lies_on(excavation ? FaceOrigin::Kind::excavation : FaceOrigin::Kind::solid_face,
                          owner, faces);
  }
  bool shares_faces_with(const WallFaces& other) const {
    return excavation == other.excavation && owner == other.owner &&
           std::find_first_of(faces.begin(), faces.end(), other.faces.begin(), other.faces.end()) !=
               faces.end();
  }
};

/// One bolt at a place of its own.
struct SpotBolt {
  std::string name;
  Vec3 collar{};     ///< m
  Vec3 direction{};  ///< unit, into the rock
  Real length = 0;   ///< m, > 0
  BoltType type;
  Index install = 0;  ///< into Analysis::stages: it acts from the start of that one
  Place place = {};
};

/// A grid of bolts over unrolled faces. Rows run along `spacing[0]`: round a tunnel, or level on a plane.
struct BoltPattern {
  std::string name;
  std::vector<WallFaces> on;          ///< each has a grid of its own
  bool staggered = false;             ///< every second row is moved by half a spacing
  std::array<Real, 2> spacing{0, 0};  ///< m within a row, and of the rows; > 0
  std::array<Real, 2> offset{0, 0};   ///< m, by which the grid is moved
  Real length = 0;                    ///< m, > 0
  std::optional<Vec3> direction;      ///< unit, into the rock; none = normal to the face
  /// deg above the horizontal of the normal into the rock: a face out of this range gets no bolts
  std::array<Real, 2> inclination{-90, 90};
  BoltType type;
  Index install = 0;  ///< as SpotBolt
  Place place = {};
};

/// Sprayed concrete over walls, failing by punching shear along the edge of a block.
struct Shotcrete {
  std::vector<WallFaces> on;
  Real thickness = 0;                     ///< m, > 0
  Real shear_strength = 0;                ///< Pa, > 0
  std::optional<Real> adhesion_strength;  ///< Pa, > 0; none = the bond to the rock is not looked at
  Real bond_width = 0.03;                 ///< m along the edge that the adhesion acts on
  Index install = 0;                      ///< as SpotBolt
  Place place = {};
};

/// Which key blocks a pattern has to hold.
enum class HoldTarget { all, first_batch };

/// The search for the lightest pattern that holds the key blocks.
struct PatternSearch {
  BoltPattern pattern;         ///< where and how; spacing, length and type are what is looked for
  std::vector<Real> spacings;  ///< m, square grids
  std::vector<Real> lengths;   ///< m
  std::vector<Index> types;    ///< into Model::bolt_types
  HoldTarget hold = HoldTarget::all;
  Real smallest_block = 0;  ///< m³: smaller ones are left to mesh or shotcrete
  Place place = {};
};

}  // namespace rockfold
