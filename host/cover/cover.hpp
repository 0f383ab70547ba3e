// Mathematical covers over the cut rock: manifold elements, physical covers, and the points of the material that
// conditions, loads and monitors refer to. Thesis 2.3 and 4.1.
#pragma once

#include <memory>
#include <vector>

#include "host/cut/cut.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

struct PieceIndex;  // piece_index.hpp

struct Covering {
  CoverArrays arrays;
  std::shared_ptr<const PieceIndex> pieces;  ///< for locating points
};

/// What stands for an element with next to no rock: its own functions, or those of a well filled one beside it, continued.
enum class Slivers : std::uint8_t { as_they_are, passed_over };

/// Lays the model's lattice (model.cover must be set) over the cutting. Deterministic numbering.
Covering build_covers(const Cutting& cutting, const Model& model, Progress& progress);

/// Throws Error(model) if a volume of rock (m³) makes more than cover.max_elements elements, however it lies. O(1)
void check_cover_size(const CoverSpec& cover, Real volume);

/// Points of the material by position, m. A point on a face or vertex belongs to the lowest block that has it.
/// Returns element = none for a point outside the rock.
MaterialPoints locate_points(const Covering& covering, const std::vector<Vec3>& points,
                             Slivers slivers = Slivers::as_they_are);

/// The vertices of the blocks, in the order of BlockArrays::vertex, each in its own block; slivers are passed over.
MaterialPoints locate_block_vertices(const Covering& covering, const BlockArrays& blocks);
/// Vertices `x` of the surfaces that blocks touch with, each of its block. The stress in a sliver is in balance with the tractions on its surface: these act
/// on its own functions. They are pressures, and press it by as much as it is small.
MaterialPoints locate_surface(const Covering& covering, const std::vector<Vec3>& x,
                              const std::vector<Index>& block);

/// The points at which the model's [[fixed]] hold, by springs of 1000 E/h per area (penalty) or exactly. Throws Error(model) naming the `fixed` entry where a region holds nothing.
FixedPoints fixed_points(const Cutting& cutting, const Covering& covering, const Model& model);

}  // namespace rockfold
