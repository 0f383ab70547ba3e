// Rotation of a block about an edge or a corner where it stays in touch with the rock. Mauldon &
// Goodman (1996), without their limits to tetrahedra and to moments along the axis (Tonon 1998).
// docs/block_theory.md, "Rotation".
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Where a block leans on rock that stays: one plane of contact.
struct ContactPatch {
  Vec3 normal{};              ///< unit, outward
  std::vector<Vec3> corners;  ///< m, convex hull of the contact, in order around it; 3 or more
  Index face = none;          ///< the block's face, to name the plane after
  Real friction = 0;          ///< tan φ
};

/// What a block's rotation depends on beside its contacts.
struct RigidBody {
  Vec3 centroid{};  ///< m
  Mat3 inertia{};   ///< kg m², about the centroid
  Real mass = 0;    ///< kg
  Vec3 force{};     ///< r, N
  Vec3 moment{};    ///< N m, of the loads about the centroid
  /// Of active anchors: N, and N m about the centroid. It presses on hinges with r; its moment counts on the driving side.
  Vec3 pull{}, pull_moment{};
};

/// A rotation that no contact prevents. The moments are about the axis: of the loads that turn the
/// block, and of those that press it back on the plane that it leaves; of anchors' pull the sum is on the driving side.
struct Rotation {
  enum class About { edge, corner };  ///< edge: or a line through corners of two planes
  About about = About::edge;
  Index face =
      none;  ///< the patch's, whose edge or corner it is: the plane that the block lifts off, of two the one pressed more
  Vec3 point{};        ///< m, on the axis
  Vec3 axis{};         ///< unit; the block turns counter-clockwise seen against it
  Real driving = 0;    ///< N m, > 0
  Real resisting = 0;  ///< N m, ≥ 0
  Real safety =
      0;  ///< resisting over driving; about a corner without the twist about the plane's normal
  Real pressed = 0;  ///< N, by which r presses on that plane
  Vec3 velocity{};   ///< m, of the centroid at 1 rad/s: axis × (centroid − point)

  /// Resisting over driving; NaN where nothing resists.
  Real factor_of_safety() const;
  /// The force at the centroid that does the net moment's work, N; > 0 where the block turns.
  Real sliding_force() const;
};

/// The turn about edge k of a patch (from corner k to the next) that lifts the patch's inside; without its moments.
Rotation about_edge(const ContactPatch& patch, std::size_t k);

/// The rotations of a block with these contacts that are both possible (no corner of a contact moves into the rock) and
/// driven, the least safe one first. About an edge of a contact, or the line through corners of two, the block
/// may turn as soon as the net moment lifts it; about a corner, where the free motion that the loads
/// start, J⁻¹ M, enters no rock. The hinge must be pressed on its planes by r. A plane that r presses on and that no corner
/// leaves resists by its friction.
/// Cost: O(k³) for k corners in all; lines are left out of blocks with more than 64 planes of contact.
std::vector<Rotation> find_rotations(std::span<const ContactPatch> patches, const RigidBody& body);

/// The least safe one.
std::optional<Rotation> find_rotation(std::span<const ContactPatch> patches, const RigidBody& body);

}  // namespace rockfold
