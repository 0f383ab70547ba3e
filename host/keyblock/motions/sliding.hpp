// How a removable block moves under its resultant force, and what the joints hold against it.
// Thesis Eq. 5-1 … 5-9 as the vector method that they mean: Goodman & Shi (1985), chapter 9;
// docs/block_theory.md.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// How a block moves; rotation is found by rotation.hpp, at_rest is no Movement: nothing drives the block.
enum class SlidingMode { lifting, single_plane, two_planes, rotation, at_rest };

/// All faces of one block that lie against rock that stays and share one outward normal.
struct ContactPlane {
  Vec3 normal{};      ///< unit, outward: from the block into the rock that it leans on
  Real area = 0;      ///< m², in contact
  Real friction = 0;  ///< tan φ; weighted by area where parallel faces have several joint materials
  Real cohesion = 0;  ///< N: Σ c A
  Vec3 water{};       ///< N: Σ ∫ p n dA, which pushes the block the other way
  Real clamping = 0;  ///< N: Σ of the in-situ normal force, compression positive (in_situ.hpp)
  bool clamping_holds =
      true;              ///< false: the clamping counts only where it makes the block less safe
  Vec3 in_situ_shear{};  ///< N: Σ of what the rock did along the plane before the block moved
  Real normal_stiffness = 0;  ///< N/m: Σ k_n A
  Real shear_stiffness = 0;   ///< N/m: Σ k_s A
  Index face = none;          ///< the face with the largest contact, to name the plane after
};

/// The motion that a resultant r starts: r = T s + Σ N n with T > 0, N ≥ 0, s in the joint pyramid,
/// s·n = 0 where N > 0.
struct Movement {
  SlidingMode mode = SlidingMode::lifting;
  std::array<Index, 2> planes{none, none};  ///< into the contact planes: those that it slides on
  Vec3 direction{};                         ///< s, unit
  Real driving = 0;                         ///< T = r·s, N
  std::array<Real, 2> normal_force{0, 0};   ///< N of each plane, compression positive, N
  Real resisting = 0;  ///< Σ (N tan φ + c A), N; and what in-situ stress adds

  Real sliding_force() const { return driving - resisting; }
  /// Resisting over driving; NaN where nothing resists lifting.
  Real factor_of_safety() const;
};

/// The motions of a block with these contact planes under the resultant r, N; none where r has no component along any
/// direction that the joints allow (the block is at rest without any friction). Several differ by nothing but which planes
/// carry the block (more than two along one line): statics leaves that open.
std::vector<Movement> possible_movements(std::span<const ContactPlane> planes, const Vec3& r);

/// The one with the largest sliding force, of equals (to rounding) the first.
std::optional<Movement> least_safe(std::span<const Movement> movements, const Vec3& r);

/// The least safe one of the possible movements.
std::optional<Movement> find_movement(std::span<const ContactPlane> planes, const Vec3& r);

/// b with b·n_i = 1, b·n_j = 0 in the plane of n_i and n_j: N_i = r·b is the normal force on plane
/// i of two. n_i and n_j must not be parallel.
Vec3 reciprocal_normal(const Vec3& n_i, const Vec3& n_j);

}  // namespace rockfold
