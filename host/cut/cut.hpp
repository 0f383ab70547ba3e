// Exact block cutting: a model's solids and joints become a complex of convex cells, and its cells blocks.
// DESIGN.md "Cutting"; the geometry itself is host/cut/complex.hpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "src/base/progress.hpp"
#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct Complex;  // complex.hpp

/// How often the given numbers were taken for what the user meant (DESIGN.md, "Intent is kept at the door").
struct IntentReport {
  Index planes_identified = 0;  ///< given planes that coincide with another to 1e-10
  Index vertices_identified =
      0;  ///< vertices taken to lie on a plane that they miss by up to 1e-10 of the model's size
  Index near_decisions = 0;  ///< distances within a factor 100 of that tolerance, on either side
  std::vector<std::string> near_planes;  ///< names of the planes of those (at most 20), sorted
};

struct CutTotals {
  Index cells = 0;
  Real solid_volume = 0;         ///< m³, of the solids before any joint cuts them
  Real joint_area = 0;           ///< m², joints inside the rock, each counted once
  Real dangling_joint_area = 0;  ///< m², of these with one block on both sides
  IntentReport intent;
};

struct Cutting {
  std::shared_ptr<const Complex> complex;
  CutTotals totals;
};

/// Throws what cut_blocks would throw before joints cut the rock: of shapes, the placing of joints, merges, estimated cells.
/// Returns the volume of the rock that no stage removes, m³.
Real check_cutting(const Model& model);

/// Cuts the model's solids by its joints. Throws Error(model) if no rock remains or the joints would make too many cells.
/// Independent of the number of threads, bit for bit, and of the order of joints but for the last digits of areas: where
/// polygons of one plane overlap, the first listed is taken away from the others.
Cutting cut_blocks(const Model& model, Progress& progress);

}  // namespace rockfold
