// Joint pyramids: the cones of translations that the rock around a block leaves open.
// Goodman & Shi, Block Theory and Its Application to Rock Engineering (1985), chapters 3 and 4.
//
// A cone is given by unit normals n: { u : u·n ≤ 0 for every n }. For a block, n are the outward
// normals of its joint faces; u·n > 0 would push the block into its neighbour.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Two directions closer than this (radians) are one. Ten times the angle below which the model
/// reader makes two planes one, and far above the rounding of a normal.
constexpr Real direction_tolerance = 1e-9;

/// A unit direction of the cone, or nothing where the cone is the origin alone ("empty" in block
/// theory).
///
/// Closed half-spaces: a cone that is only a plane, a half-plane or a line (a block between
/// parallel joints) counts as not empty, as Goodman & Shi count repeated joint sets. Cost: O(m²)
/// directions for m normals, each refused by the first normal or two in most cases.
std::optional<Vec3> removable_direction(std::span<const Vec3> normals);

/// All directions in which a block may leave: what removable_direction() finds one of.
struct RemovableSpace {
  /// Unit, in order around the space: its extreme directions. Two opposite ones are the line of a
  /// wedge (or of a channel between parallel joints); none: all of space, a half-space or a plane.
  std::vector<Vec3> edges;
  Real solid_angle = 0;  ///< sr: 4π = anywhere, 2π = a half-space, 0 = only along a plane or line
};

/// The space of removable directions of a cone that is not empty (else: no edges, 0 sr). Cost: O(m³)
/// for m normals.
RemovableSpace removable_space(std::span<const Vec3> normals);

/// The joint pyramid of Goodman & Shi's code, one digit for each joint: 0 the block lies above the
/// joint, 1 below, 2 the joint is no face of the block, 3 the block lies between two joints of that
/// set. `upward` are the joints' upward normals. Throws std::invalid_argument for a code that does
/// not fit.
std::vector<Vec3> joint_pyramid(std::span<const Vec3> upward, std::string_view code);

/// Shi's theorem for a convex block: it is removable if its joint pyramid is not empty and it is
/// finite, that is if the block pyramid (joint pyramid ∩ excavation pyramid) is empty.
/// `excavation`: normals of the free faces that point out of the rock.
bool is_removable(std::span<const Vec3> joints, std::span<const Vec3> excavation);

}  // namespace rockfold
