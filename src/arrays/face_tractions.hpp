// In-situ stress on the faces of blocks: from the continuum that src/app/joint_stress.hpp solves to host/keyblock.
#pragma once

#include <algorithm>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// The mean of σ·n over each face of BlockArrays, n its outward normal: what the rock behind it does to the block, per area.
/// Example: openings before the first stage and at stage 2: stage = {0, 2}; of_face[1] is that once stage 2 is excavated.
struct FaceTractions {
  std::vector<Index> stage;                ///< [S] ascending
  std::vector<std::vector<Vec3>> of_face;  ///< [S][F] Pa; 0 on faces that no rock can lean on

  bool any() const { return !stage.empty(); }
  /// Once a stage is excavated.
  const std::vector<Vec3>& after(Index excavated) const {
    const auto later = std::upper_bound(stage.begin() + 1, stage.end(), excavated);
    return of_face[static_cast<std::size_t>(later - stage.begin()) - 1];
  }
};

}  // namespace rockfold
