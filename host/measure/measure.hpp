// All that is measured of a cut rock: its blocks, the intensity of its joints, its stages.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/cut/cut.hpp"
#include "host/measure/block_statistics.hpp"
#include "host/measure/lines.hpp"
#include "host/measure/sections.hpp"
#include "src/base/stage_keys.hpp"

namespace rockfold {

/// Intensities of the joints of one origin, P_xy: dimension of the region sampled, dimension of what is measured in it
/// (Dershowitz & Herda 1992). Measured in the rock, not of the joints as placed.
struct OriginIntensity {
  std::string name;
  Index joints = 0;  ///< distinct joints with a part in the rock
  Real area = 0;     ///< m², in the rock, each joint counted once
  Real p30 = 0;      ///< 1/m³: joints / volume of the rock
  Real p32 = 0;      ///< m²/m³: area / volume
  Real p20 = 0;      ///< 1/m²: traces on the three sections / their area
  Real p21 = 0;      ///< m/m²: length of these traces / their area
  Real p10 = 0;      ///< 1/m: crossings of the scanlines / their length in rock
};

struct RockMeasures {
  BlockStatistics blocks;
  std::vector<OriginIntensity> intensities;  ///< one for each joint origin, ordered by name
  OriginIntensity all_joints;                ///< the sums of these
  /// Volumetric joint count, joints/m³: Σ 1/S over the origins, S the mean spacing (Palmström 2005), with 1/S = P32,
  /// which holds for parallel joints whatever their spacings and extent.
  Real volumetric_joint_count = 0;
  std::vector<LineMeasure> lines;
  /// RQD over all lines, weighted by their length in rock, [0, 1]; NaN without rock on them.
  Real rqd = 0;
  std::array<SectionMeasure, 3> sections;
  std::vector<StageReport> stages;
};

StageKeys keys_of_measuring();

/// Measures the rock. Deterministic; linear in cells, fragments and vertices.
RockMeasures measure_rock(const Cutting& cutting, const BlockArrays& blocks, const Model& model);

}  // namespace rockfold
