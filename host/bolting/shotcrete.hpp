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

/// Where shotcrete bridges the joint between two blocks at the wall: on both sides of it there are sprayed faces.
struct ShotcreteTrace {
  Vec3 from{}, to{};  ///< m
  Index block[2] = {none, none};
  Vec3 into_rock{};  ///< unit, the mean of the two faces'
};

/// Which faces of the model are under shotcrete.
class ShotcreteCover {
 public:
  ShotcreteCover(const BlockArrays& blocks, const Shotcrete& shotcrete);

  /// Punching shear (Barrett & McCreath 1995): τ t for each metre of the edge of the block's sprayed faces, or adhesion
  /// strength × bond width if that is less. Edges between two sprayed faces of the block are no edge, nor are those at a
  /// joint between blocks that move together.
  ShotcreteHold hold(const std::vector<Index>& members) const;

  /// All of them: each once, by blocks.
  std::vector<ShotcreteTrace> traces() const;
  /// N/m, along an edge.
  Real strength() const { return strength_; }

 private:
  /// Whether a face touches another of the members.
  bool is_inside(Index face, const std::vector<Index>& members) const;
  void add(Index block, const std::vector<Index>& members, ShotcreteHold& sum) const;
  struct Edge {
    Vec3 from{}, to{};
    Index face = none;  ///< sprayed, of the block
  };
  std::vector<Edge> edges_of(Index block) const;
  void add_traces(Index block, std::vector<ShotcreteTrace>& traces) const;

  const BlockArrays& blocks_;
  FaceInterfaces interfaces_;
  std::vector<bool> sprayed_;  ///< [origins]
  Real strength_ = 0;          ///< N/m
};

}  // namespace rockfold
