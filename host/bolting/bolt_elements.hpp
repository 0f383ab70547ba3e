// The model's bolts and shotcrete as elements of an analysis: chains of points of the rock along bolts, and of steel; shotcrete as short bars
// across the joints that it bridges, normal to the wall.
#pragma once

#include "host/bolting/drill.hpp"
#include "host/cover/cover.hpp"
#include "src/arrays/bolt_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct BoltElements {
  DrilledBolts drilled;       ///< those that meet rock
  BoltArrays arrays;          ///< these in their order, then what bridges joints
  std::vector<Real> bridged;  ///< m of joint that each of the latter stands for

  Index bolts() const { return static_cast<Index>(drilled.bolts.size()); }
  /// Before anything moves.
  BoltLines lines() const;
  bool any() const { return arrays.count() > 0; }
};

/// Whether an analysis of the model has bolts, or shotcrete: large kinematics.
bool has_bolts(const Model& model);
bool has_shotcrete(const Model& model);

/// Covering::pieces must still be there. Throws Error(model) as drill_model.
BoltElements bolt_elements(const Cutting& cutting, const Covering& covering,
                           const BlockArrays& blocks, const Model& model);

}  // namespace rockfold
