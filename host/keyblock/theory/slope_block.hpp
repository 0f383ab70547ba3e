// Wedges that joint sets make in a long slope. docs/block_theory.md, "Slopes".
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/keyblock/theory/theory_block.hpp"

namespace rockfold {

/// A slope face from its toe at the origin to its crest, and the ground behind.
struct SlopeFrame {
  Vec3 face{}, upper{};  ///< upward unit normals
  Real height = 0;       ///< m
};
SlopeFrame slope_frame(const TheorySlope& slope, Real dip_direction);

/// Normals of the free faces, that point out of the rock: for is_removable().
std::vector<Vec3> excavation_normals(const SlopeFrame& slope);

/// The largest block of a joint pyramid (outward normals, two or more) in the slope: of two joints,
/// the wedge whose line comes out at the toe, up to the ground behind the crest; of three or more,
/// the block in the face alone that reaches from toe to crest. Nothing where no finite one exists.
std::optional<TheoryShape> largest_block(const SlopeFrame& slope, std::span<const Vec3> normals);

}  // namespace rockfold
