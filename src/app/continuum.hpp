// The rock round openings as one elastic body: what of a model the redistribution of in-situ stress is computed on.
#pragma once

#include <optional>

#include "host/joints/disc.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Excavations and subtracted solids.
struct Openings {
  Extent box{};     ///< m, of what of them lies within the rock's box
  Real radius = 0;  ///< m: half the least width of the narrowest; a tunnel's is that of its section
  Real size = 0;    ///< m: likewise of the widest, or of all together
};

/// None where no stage opens anything within the rock. Files have been read before (host/files).
std::optional<Openings> measure_openings(const Model& model);
/// m, between boxes; 0 where they meet.
Real distance(const Extent& a, const Extent& b);

/// How fine and how far. docs/block_theory.md says what errors these numbers leave.
struct ContinuumRule {
  Real cells_a_radius = 6;     ///< lattice cells, with constant functions
  Real reach = 6;              ///< sizes: rock farther from the openings is left out
  Index most_cells = 100'000;  ///< lattice cells; where the rule asks for more, all are larger
};

/// One state of excavation.
struct Continuum {
  Model model;  ///< without joints; with a cover, to be held by hold_continuum()
  Openings openings;
  Real spacing = 0;  ///< m, the largest of the lattice's three
  Index original_solids =
      0;  ///< those from this one on are not openings but cut off what lies beyond the reach
  bool coarser = false;  ///< than the rule asks for
  bool is_made_free(const FaceOrigin& origin) const;
};

/// The rock once `stage` is excavated; none where nothing is open yet. Files have been read before (host/files).
std::optional<Continuum> continuum_after(const Model& model, Index stage,
                                         const ContinuumRule& rule = {});

/// Where the rock goes on, by `continues` or because it was cut off. Faces that openings meet: rollers. Others: springs of 2G/R (Pa/m), R the
/// distance of their plane from the openings' middle, which give way as the rock beyond does: round a circular tunnel u ~ 1/r and
/// σ_r = 2G u/r. Where that leaves a direction free, faces are held in all. `blocks`: of the continuum.
void hold_continuum(Continuum& continuum, const BlockArrays& blocks);

}  // namespace rockfold
