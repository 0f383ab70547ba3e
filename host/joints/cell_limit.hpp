// How many cells a model may make (cut.max_cells), and how many its sets of planes will make at least.
#pragma once

#include <string>
#include <vector>

#include "src/model/model.hpp"

namespace rockfold {

/// A joint set of through-going planes, for estimates.
struct PlaneSet {
  Vec3 normal;       ///< unit, the mean one
  Real count = 0;    ///< planes that meet the box of the rock, or of `within`
  Real spacing = 0;  ///< m, mean
  Real volume = 0;   ///< m³ of that box
  bool fills =
      false;        ///< the planes lie all through the rock, not much farther apart than `widest`
  Real widest = 0;  ///< m
};

struct CellEstimate {
  Real about =
      0;  ///< each plane one more, and one for each meeting point of three families in the rock
  Real least = 0;  ///< by the rock's volume over that of the largest cells
};

/// Of rock of this volume (m³) and diagonal (m).
CellEstimate estimate_cells(const std::vector<PlaneSet>& sets, Real volume, Real diagonal);

/// Throws Error(model) for `what`, with the place of cut.max_cells or, where the model leaves it at its default, of the
/// first joint.
[[noreturn]] void refuse_cells(const Model& model, const std::string& what);

/// "about 1300", "about 2.5e+07": an estimate in two digits.
std::string about_cells(Real cells);

/// refuse_cells for a number of cells, in words: "8", "more than 1000".
[[noreturn]] void refuse_cell_count(const Model& model, const std::string& count);

}  // namespace rockfold
