// [[traction]] on the free faces of blocks, as block theory takes it: one force and moment a face.
#pragma once

#include <optional>
#include <vector>

#include "host/keyblock/face_shape.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A force, and its moment about the origin of coordinates.
struct FaceLoad {
  Vec3 force{};   ///< N
  Vec3 moment{};  ///< N m
};

/// Water before a free face, as the joints behind it feel it.
struct FaceWater {
  std::optional<LinearPressure> pond = {};  ///< of the tractions with a `head`, the highest
  bool closed =
      false;  ///< a `pressure` stands before it, of which nobody knows whether it is water: it lets none out
};

class SurfaceLoads {
 public:
  /// Throws Error(model) for a traction whose region holds no free face. Tables over time are read at t = 1 s, as static
  /// analyses do.
  SurfaceLoads(const BlockArrays& blocks, const Model& model);

  /// On all of a free face, clipped exactly by the regions of the tractions.
  FaceLoad on_face(Index face) const {
    return load_.empty() ? FaceLoad{} : load_[static_cast<std::size_t>(face)];
  }

  FaceWater water_before(Index face) const {
    return water_.empty() ? FaceWater{} : water_[static_cast<std::size_t>(face)];
  }

 private:
  void add_water(const Traction& traction, const LinearPressure& pressure, Index face);

  std::vector<FaceWater> water_;  ///< [faces]; empty: no tractions
  std::vector<FaceLoad> load_;    ///< [faces]; empty: no tractions
};

/// Seconds at which statics and block theory read tables over time: all load is on.
constexpr Real time_of_statics = 1;

}  // namespace rockfold
