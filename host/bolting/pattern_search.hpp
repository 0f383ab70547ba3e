// The lightest pattern of bolts that holds the key blocks, out of a catalogue.
#pragma once

#include <vector>

#include "host/bolting/bolting.hpp"

namespace rockfold {

/// One pattern of the search, with what it does.
struct PatternTrial {
  Index type = none;  ///< into Model::bolt_types
  Real spacing = 0;   ///< m
  Real length = 0;    ///< m
  Index bolts = 0;
  /// What patterns are compared by: kg, or without masses Σ length × force capacity, N·m, which is in proportion to the mass
  /// of bolts of one steel.
  Real weight = 0;
  Index held = 0;                   ///< of the wanted blocks, those that reach the target
  Index disturbed = 0;              ///< blocks that stay and miss the target because of its bolts
  Real least_factor_of_safety = 0;  ///< of the wanted blocks; NaN without any
};

struct PatternSearchReport {
  bool by_mass = false;
  Index wanted = 0;    ///< key blocks that have to be held
  Index patterns = 0;  ///< spacings × lengths × types
  std::vector<PatternTrial>
      trials;         ///< those tried, by weight: the search ends at the first that holds all
  Index best = none;  ///< into trials; none = no pattern holds all
  /// Where none is best the one that leaves the fewest blocks below the target, of those the lightest; into trials.
  Index nearest = none;
  std::vector<Index> not_held;   ///< wanted blocks that miss the target with the nearest one
  std::vector<Index> disturbed;  ///< and blocks that stay but for its active bolts
};

/// Tries spacings × lengths × types from the lightest on until one holds every key block wanted, with the model's shotcrete
/// but without its other bolts. The bolts of each spacing are drilled once, at the largest length.
PatternSearchReport search_pattern(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                                   const Model& model);

}  // namespace rockfold
