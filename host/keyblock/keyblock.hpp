// Key blocks by block theory: removability, sliding modes, batches and the support they need.
// Goodman & Shi (1985); thesis chapter 5, Eq. 5-1 … 5-9, corrected as docs/block_theory.md shows.
//
// Table of contents:
//   keyblock.hpp       the blocks of a model, stage by stage and batch by batch
//   bodies.hpp         blocks of a model as rigid bodies, alone or several as one
//   groups.hpp         blocks that fail together where none can alone
//   first_look.hpp     what of it can be done again with other strengths and loads
//   face_shape.hpp     polygons of faces: water on them, where they touch, inertia
//   mean_planes.hpp    rough surfaces as planes; mesh_planes.hpp: those of joint meshes on blocks
//   motions/           one block given by its faces: the directions it may take (pyramid), how a resultant moves it (sliding, rotation),
//                      what in-situ stress adds (in_situ), the force that brings it to a factor of safety (least_support)
//   theory/            joint sets alone, without a cut model
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/keyblock/motions/pyramid.hpp"
#include "host/keyblock/motions/single_block.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/face_tractions.hpp"
#include "src/base/stage_keys.hpp"
#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// How many planes a joint mesh is on a block.
struct MeshPlaneCount {
  std::string mesh;
  Index planes = 0;
};

/// A block, or a group of blocks, that moves or would without friction and cohesion.
struct Keyblock {
  Index block = none;          ///< the first of its members
  std::vector<Index> members;  ///< ascending; more than one: they fail together
  Index batch = 0;             ///< 1 = moves first
  Index stage = 0;             ///< of the excavation after which it moves; 0 = before any
  Real volume = 0;             ///< m³
  Real weight = 0;             ///< N
  SlidingMode mode = SlidingMode::lifting;
  std::vector<std::string> planes;  ///< names of the joints it slides on: 0, 1 or 2
  Vec3 direction{};                 ///< unit, of the motion (of the centroid, in rotation)
  Real driving_force = 0;           ///< N, along `direction`
  Real resisting_force = 0;         ///< N
  std::vector<Real> normal_forces;  ///< N, on each of `planes`; empty in rotation
  Real sliding_force = 0;           ///< N: driving minus resisting force, > 0
  /// Resisting over driving; NaN where nothing resists (null in JSON).
  Real factor_of_safety = 0;
  /// The same on joints that have slipped (JointMaterial's residual strength), of the motion that governs then.
  Real residual_factor_of_safety = 0;
  RemovableSpace removable;  ///< translations that no neighbour prevents
  /// The least safe one first; it governs where the mode is rotation.
  std::vector<Rotation> rotations;
  Real free_area = 0;      ///< m² of free faces when its batch moves
  Index free_face = none;  ///< the largest of these: a place for a bolt
  /// N for the target factor of safety, along support_direction, of translation and all rotations; infinite where no force
  /// along it suffices.
  Real support_force = 0;
  Real support_pressure = 0;                ///< Pa = support_force / free_area
  Vec3 support_direction{};                 ///< unit
  std::vector<ContactPlane> contact;        ///< the planes that it leans on
  std::vector<MeshPlaneCount> mesh_planes;  ///< of each joint mesh that it leans on, by name
  std::optional<Movement> movement;         ///< the translation, into `contact`, if there is one
  Vec3 resultant{};                         ///< r, N
  /// What the rotations follow from. Both empty in models without active bolts, and where rotation is not looked at.
  std::vector<ContactPatch> patches;
  RigidBody body;
};

struct KeyblockReport {
  std::vector<BlockClass>
      block_class;           ///< [B] key, excavated, or the class once all key blocks are gone
  std::vector<Index> batch;  ///< [B] 0 = not a key block
  std::vector<Keyblock> keyblocks;  ///< ordered by batch, then block
  std::vector<Index> batches;       ///< key blocks in each batch (a group counts as one)
  std::vector<Index> batch_stage;   ///< [batches] the excavation stage that it follows
  /// Blocks that would move without friction and cohesion but are held, once all key blocks are
  /// gone; by block. Their sliding_force is ≤ 0, their batch 0; support_force > 0 where the factor
  /// of safety is below the target.
  std::vector<Keyblock> stable;
  /// Removable blocks that nothing drives, once all key blocks are gone; by block. Active anchors may drive them: empty in
  /// models without.
  std::vector<Keyblock> at_rest;
  /// Whether the limit of batches ended a search in which groups had not been looked for yet.
  bool groups_left = false;
  Real smallest_block = 0;  ///< m³: tables leave smaller ones out
};

/// Faces named in a [[fixed]] count where support.joint_faces_only is false.
StageKeys keys_of_keyblocks(const Model& model);

/// Whether the model has bolts, or searches a pattern of bolts, that are active.
bool has_active_bolts(const Model& model);

/// How many batches are looked for after each stage; 0: all.
Index most_batches(const Model& model);

/// Finds the key blocks in batches: remove the first batch, renew the free faces, look again, until
/// none. A batch is all blocks that move with the same rock still around them: it depends on
/// neither ids nor threads. Where no block moves alone, groups that fail together are a batch.
/// Excavations follow in the order of their stages, each when nothing moves any more; rock that a
/// later stage excavates stays until then.
/// Cost: one look at each block with a free face, then one at each neighbour of a removed block.
/// `in_situ`: where in-situ stress on joints is that round openings; null: far from them.
KeyblockReport find_keyblocks(const BlockArrays& blocks, const Model& model,
                              const FaceTractions* in_situ = nullptr);

}  // namespace rockfold
