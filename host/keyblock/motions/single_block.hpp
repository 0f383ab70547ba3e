// Block theory of one block: its faces in, its class and motion out. Knows nothing of how blocks
// were made.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/keyblock/motions/rotation.hpp"
#include "host/keyblock/motions/sliding.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// The least safe translation under the resultant r, N, with what in-situ stress holds against it; none at rest.
std::optional<Movement> governing_movement(std::span<const ContactPlane> planes, const Vec3& r);

/// What block theory says of a block.
enum class BlockClass {
  infinite,     ///< the rock goes on beyond one of its faces
  tapered,      ///< no free face, or no direction that its joint faces allow
  stable,       ///< removable, but the resistance is no less than the driving force
  key,          ///< removable, and moves without support
  excavated,    ///< removed by an excavation before any block moves
  not_examined  ///< only blocks of the last batch that was looked for keep it in place
};

/// A face of a block as block theory sees it.
struct BlockFace {
  Vec3 normal{};          ///< unit, outward; of a mesh's facet that of the plane that it is part of
  Real area = 0;          ///< m²
  Real contact_area = 0;  ///< m², against rock that stays: 0 = a free face, otherwise ≤ area
  Real friction = 0;      ///< tan φ of the joint
  Real cohesion = 0;      ///< Pa
  Vec3 water{};           ///< N, ∫ p n dA over the part in contact, beside a uniform pressure
  Real clamping = 0;      ///< N, in-situ normal force on the part in contact
  Vec3 in_situ_shear{};   ///< N, in-situ force of the rock on that part along the face
  bool clamping_holds = true;  ///< as of a contact plane
  Real normal_stiffness = 0;   ///< Pa/m of the joint; only with clamping
  Real shear_stiffness = 0;    ///< Pa/m
  bool continues = false;      ///< the rock goes on beyond
};

struct BlockVerdict {
  BlockClass block_class = BlockClass::tapered;
  Vec3 resultant{};                  ///< r: the load and the water's push, N; zero unless removable
  Real free_area = 0;                ///< m²; zero unless removable
  std::vector<ContactPlane> planes;  ///< empty unless removable
  std::optional<Movement> movement;  ///< of a removable block that r would move without friction
  /// Of a removable block whose shape is known; the least safe one first.
  std::vector<Rotation> rotations;
  std::vector<ContactPatch> patches;  ///< what the rotations were found from; else empty
  RigidBody body;

  /// Whether it is the rotation, not the translation, that governs: the lower factor of safety.
  bool rotates() const;
  /// Of the motion that governs, N; there must be one.
  Real sliding_force() const;
};

/// Completes a removable block's verdict by its rotations, the least safe one first.
void add_rotations(BlockVerdict& verdict, std::vector<Rotation> rotations);

/// The class and motion of a block under `load` (weight, earthquake, …; N) and a water pressure
/// (Pa, ≥ 0) on the faces in contact, which, with the faces' own water, pushes the block off them:
/// r = load − Σ p A n. Translation alone. Any shape: the faces are taken as they are (docs/block_theory.md, "Concave blocks").
BlockVerdict judge_block(std::span<const BlockFace> faces, const Vec3& load, Real water_pressure);

/// The faces in contact, those with one outward normal (to direction_tolerance) together. A face
/// whose normal is not a unit vector (a face that rounded to nothing) is left out.
std::vector<ContactPlane> contact_planes(std::span<const BlockFace> faces);

}  // namespace rockfold
