// Models that are as hard to cut as the numbers of a model file allow: planes and finite joints that nearly coincide, nearly concur,
// meet at tiny angles, share edges and corners to rounding; slabs, needles, wedges and flakes.
#pragma once

#include <optional>
#include <string>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

struct NastyModel {
  std::string kind;  ///< what is in it, "needle + fan, oblique, map"
  Model model;
  Real size = 1;  ///< m, the model's size to a factor 3
  /// What is known of the answer beside what holds for every model.
  long double volume = 0;  ///< m³ of the rock
  Real volume_error = 0;   ///< relative, of `volume`: 0 where the solids are boxes along the axes
  std::optional<Index> blocks;
};

/// The kinds of joints, each of which can stand alone.
int nasty_kind_count();

/// One kind alone or up to three together, in one of several bodies, near the origin or at map coordinates, straight or
/// under an oblique affine map.
NastyModel nasty_model(unsigned seed);

/// Of the kind alone, in a single body.
NastyModel nasty_model_of_kind(int kind, unsigned seed);

}  // namespace rockfold::test
