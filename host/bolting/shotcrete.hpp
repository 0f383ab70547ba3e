// Shotcrete against a block that punches through it.
#pragma once

#include <optional>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct ShotcreteHold {
  Real edge = 0;  ///< m, of the block's free faces under shotcrete
  Vec3 force{};   ///< N, on the block: from each part of the edge along the normal into the rock
};

/// Which faces of the model are under shotcrete.
class ShotcreteCover {
 public:
  ShotcreteCover(const BlockArrays& blocks, const Shotcrete& shotcrete);

  /// Punching shear (Barrett & McCreath 1995): τ t for each metre of the edge of the block's sprayed faces, or adhesion
  /// strength × bond width if that is less. Edges between two sprayed faces of the block are no edge.
  ShotcreteHold hold(Index block) const;

 private:
  const BlockArrays& blocks_;
  std::vector<bool> sprayed_;  ///< [origins]
  Real strength_ = 0;          ///< N/m
};

}  // namespace rockfold
