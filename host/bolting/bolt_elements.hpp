// The model's bolts as elements of an analysis: chains of points of the rock along them, and of steel.
#pragma once

#include "host/bolting/drill.hpp"
#include "host/cover/cover.hpp"
#include "src/arrays/bolt_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct BoltElements {
  DrilledBolts drilled;  ///< those that meet rock
  BoltArrays arrays;     ///< in their order

  bool any() const { return arrays.count() > 0; }
};

/// Whether an analysis of the model has bolts: large kinematics.
bool has_bolts(const Model& model);

/// Covering::pieces must still be there. Throws Error(model) as drill_model.
BoltElements bolt_elements(const Cutting& cutting, const Covering& covering,
                           const BlockArrays& blocks, const Model& model);

}  // namespace rockfold
