// Shotcrete against a block that punches through it.
#pragma once

#include <optional>
#include <vector>

#include "host/keyblock/face_interfaces.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct ShotcreteHold {
  Real edge = 0;  ///< m, of the block's free faces under shotcrete
  Vec3 force{};   ///< N, on the block: from each part of the edge along the normal into the rock
  Vec3 point{};   ///< m, the middle of the edge, where the force acts
};

/// Which faces of the model are under shotcrete.
class ShotcreteCover {
 public:
  ShotcreteCover(const BlockArrays& blocks, const Shotcrete& shotcrete);

  /// Punching shear (Barrett & McCreath 1995): τ t for each metre of the edge of the block's sprayed faces, or adhesion
  /// strength × bond width if that is less. Edges between two sprayed faces of the block are no edge, nor are those at a
  /// joint between blocks that move together.
  ShotcreteHold hold(const std::vector<Index>& members) const;

 private:
  /// Whether a face touches another of the members.
  bool is_inside(Index face, const std::vector<Index>& members) const;
  void add(Index block, const std::vector<Index>& members, ShotcreteHold& sum) const;

  const BlockArrays& blocks_;
  FaceInterfaces interfaces_;
  std::vector<bool> sprayed_;  ///< [origins]
  Real strength_ = 0;          ///< N/m
};

}  // namespace rockfold
