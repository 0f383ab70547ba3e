// Rock mass classification of a model, beside what block theory asks for. docs/support_design.md, "Classification".
#pragma once

#include <array>
#include <optional>
#include <string>

#include "host/classification/q_system.hpp"
#include "host/classification/rmr.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/measure/measure.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// What the cut model says of the parameters.
struct MeasuredJointing {
  Real rqd = 100;  ///< %, along the scanlines; without rock on them 110 − 2.5 J_v (Palmström 2005)
  Real volumetric_joint_count = 0;  ///< joints/m³
  Index sets = 0;  ///< joint sets with joints in the rock; parallel ones (to 20°) are one
  bool random_joints = false;  ///< single joints, meshes or tables besides
  Real closest_spacing = 0;    ///< m, 1/P32 of the densest set; infinite without sets
  Real block_size = 0;         ///< m, cube root of the median block volume, by volume
};

struct QReport {
  QParameters parameters;  ///< Jn with its factor for portals and intersections
  bool rqd_proposed = false, jn_proposed = false;  ///< from the cut model
  Real value = 0;
  Real unsupported_span = 0;                         ///< m
  std::optional<Real> equivalent_span;               ///< m, span / ESR
  std::optional<bool> needs_support;                 ///< span over the unsupported one
  std::optional<Real> roof_bolts, wall_bolts;        ///< m
  Real roof_pressure = 0, roof_pressure_simple = 0;  ///< Pa
};

struct RmrReport {
  /// Strength, RQD, spacing, condition of joints, groundwater, orientation.
  std::array<Real, 6> ratings{};
  bool rqd_proposed = false, spacing_proposed = false;
  Real rqd = 0;      ///< %
  Real spacing = 0;  ///< m
  Real value = 0;
  int number = 0;  ///< of the class, 1 … 5
  StandUp stand_up;
  RmrSupport support;
  std::optional<Real> roof_pressure;  ///< Pa, Unal
  Real deformation_modulus = 0;       ///< Pa
};

/// What block theory asks for, to compare.
struct BlockTheoryDemand {
  Index keyblocks = 0;
  Real support_force = 0;     ///< N, of all key blocks
  Real largest_pressure = 0;  ///< Pa, of one key block
  Real mean_pressure = 0;     ///< Pa, all their force over all their free area
  Real deepest = 0;           ///< m, of a key block behind its largest free face
  Index deepest_block = none;
};

struct ClassificationReport {
  MeasuredJointing measured;
  std::optional<QReport> q;
  std::optional<RmrReport> rmr;
  BlockTheoryDemand demand;
};

MeasuredJointing measured_jointing(const RockMeasures& measures, const Model& model);

ClassificationReport classify(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                              const RockMeasures& measures, const Model& model);

}  // namespace rockfold
