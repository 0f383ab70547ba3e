// Whether every face of a joint leans on rock: an invariant of the cutting.
#pragma once

#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// Area of a joint on a block that no other block is in contact with.
struct LostContact {
  Index block = none;
  Index origin = none;  ///< of the joint
  Real area = 0;        ///< m², of the joint's faces on the block
  Real lost = 0;        ///< m², of it without contact
  Vec3 place{};         ///< m, a corner of the face that lacks most
};

/// Joints have rock on both sides, so that their faces' areas equal those of their interfaces with faces that look at them and
/// are not free. Lists where more than 1e-6 of a joint's area is missing; what is less, slivers of 1e-9 of the model's size
/// explain. O(faces + interfaces).
std::vector<LostContact> lost_contact(const BlockArrays& blocks);

}  // namespace rockfold
