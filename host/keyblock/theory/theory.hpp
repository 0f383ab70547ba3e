// Block theory of joint sets alone, without a cut model: the classical tables. docs/block_theory.md,
// "Joint sets alone".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/keyblock/theory/monte_carlo.hpp"
#include "host/keyblock/theory/theory_block.hpp"
#include "src/base/stage_keys.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// One joint pyramid of all sets.
struct PyramidEntry {
  std::string code;
  bool exists = false;  ///< it is not empty
  RemovableSpace space;
  TheoryBlock unit;                         ///< its block of weight 1 N, without cohesion and water
  std::vector<std::string> removable_from;  ///< names of tunnels and slopes
};

/// A tunnel axis or a slope direction of a scan.
struct ScanEntry {
  Real direction = 0;         ///< deg: trend of the axis, dip direction of the slope
  Real plunge = 0;            ///< deg, of a tunnel
  Index key_blocks = 0;       ///< joint pyramids whose largest block moves
  Real largest_volume = 0;    ///< m³, of a key block
  Real largest_support = 0;   ///< N, of a key block
  Real largest_pressure = 0;  ///< Pa
};
struct Scan {
  std::vector<ScanEntry> entries;
  Index best = none, worst = none;  ///< least and most support force; of equals the first
};

/// What the sets make of one excavation.
struct ExcavationTheory {
  std::string name;
  bool tunnel = true;
  Real direction = 0, plunge = 0;  ///< deg, as in a scan
  std::vector<TheoryBlock>
      blocks;  ///< largest blocks, of all removable pyramids of 3 (slopes: 2, 3) sets
  std::optional<Scan> scan;
  std::optional<MonteCarloResult> monte_carlo;
};

struct TheoryReport {
  std::vector<TheorySet> sets;
  std::vector<PyramidEntry> pyramids;  ///< all 2^n, ascending
  std::vector<ExcavationTheory> excavations;
};

StageKeys keys_of_theory(const Model& model);

/// Throws Error(model) at a tunnel whose Monte Carlo simulation is not possible.
TheoryReport joint_set_theory(const Model& model);

/// The largest blocks of a tunnel, in the order of codes_of(n, 3).
std::vector<TheoryBlock> tunnel_blocks(const std::vector<TheorySet>& sets, const TheoryLoads& loads,
                                       const TheoryTunnel& tunnel);
/// The largest blocks of a slope that dips to dip_direction, of pairs and triples of sets.
std::vector<TheoryBlock> slope_blocks(const std::vector<TheorySet>& sets, const TheoryLoads& loads,
                                      const TheorySlope& slope, Real dip_direction);

}  // namespace rockfold
