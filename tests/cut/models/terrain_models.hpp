// Surveyed ground: elevations rounded to few decimals, so that thousands of neighbouring triangles are coplanar but for the last digit.
#pragma once

#include <memory>
#include <string>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

struct TerrainModel {
  std::string kind;  ///< "rough, 2 decimals, map, 23 posts, cell 0.3"
  Model model;
  Real size = 1;  ///< m, the ground's extent
  bool subtracted =
      false;  ///< a tunnel or a shaft is no rock: the ground's volume is not that of the blocks
  long double ground_volume = 0;  ///< m³, exact
};

/// 6 to `most_posts` posts a side; flat, smooth, rough, terraced, planar in parts; near the origin or at map coordinates; joints,
/// discs, a tunnel, a shaft.
TerrainModel terrain_model(unsigned seed, int most_posts);

/// The same with each elevation off by up to `by`, m.
Model jittered(const Model& model, Real by, unsigned seed);

}  // namespace rockfold::test
