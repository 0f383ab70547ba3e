// Key blocks by block theory: removability, sliding modes, batches and the support they need.
// Goodman & Shi (1985); thesis chapter 5, Eq. 5-1 … 5-9, corrected as docs/block_theory.md shows.
//
// Table of contents:
//   pyramid.hpp        cones of directions: joint pyramids and their codes, removability
//   sliding.hpp        the motion that a resultant starts, its driving and resisting forces
//   least_support.hpp  the force that brings it to a factor of safety
//   single_block.hpp   all of this for one block given by its faces
//   keyblock.hpp       the blocks of a model, batch by batch
#pragma once

#include <string>
#include <vector>

#include "host/keyblock/single_block.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct Keyblock {
  Index block = none;
  Index batch = 0;  ///< 1 = moves first
  Real volume = 0;  ///< m³
  Real weight = 0;  ///< N
  SlidingMode mode = SlidingMode::lifting;
  std::vector<std::string> planes;  ///< names of the joints it slides on: 0, 1 or 2
  Vec3 direction{};                 ///< unit, of the motion
  Real sliding_force = 0;           ///< N: driving minus resisting force along `direction`, > 0
  Real factor_of_safety =
      0;  ///< resisting over driving; NaN for lifting, which nothing resists (null in JSON)
  Real free_area = 0;         ///< m² of free faces when its batch moves
  Real support_force = 0;     ///< N for the target factor of safety, along support_direction
  Real support_pressure = 0;  ///< Pa = support_force / free_area
  Vec3 support_direction{};   ///< unit
  std::vector<ContactPlane> contact;  ///< the planes that it leans on
  Movement movement;                  ///< into `contact`
};

struct KeyblockReport {
  std::vector<BlockClass>
      block_class;           ///< [B] key, excavated, or the class once all key blocks are gone
  std::vector<Index> batch;  ///< [B] 0 = not a key block
  std::vector<Keyblock> keyblocks;  ///< ordered by batch, then block
  std::vector<Index> batches;       ///< key blocks in each batch
  /// Blocks that would move without friction and cohesion but are held, once all key blocks are
  /// gone; by block. Their sliding_force is ≤ 0, their batch 0; support_force > 0 where the factor
  /// of safety is below the target.
  std::vector<Keyblock> stable;
};

/// Finds the key blocks in batches: remove the first batch, renew the free faces, look again, until
/// none. A batch is all blocks that move with the same rock still around them: it depends on
/// neither ids nor threads. Blocks of all excavation stages are gone before the first batch: what bounds them is free.
/// Cost: one look at each block with a free face, then one at each
/// neighbour of a removed block.
KeyblockReport find_keyblocks(const BlockArrays& blocks, const Model& model);

}  // namespace rockfold
