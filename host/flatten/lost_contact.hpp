// Whether every face of a joint leans on rock: an invariant of the cutting.
#pragma once

#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// Faces of a joint on a block whose contact does not add up to their areas.
struct LostContact {
  Index block = none;
  Index origin = none;  ///< of the joint
  Real area = 0;        ///< m², of the joint's faces on the block
  Real lost = 0;        ///< m², of it without contact
  Real surplus = 0;     ///< m², of contact beyond the areas of other faces
  Vec3 place{};         ///< m, in the middle of the face that is off most
};

/// Joints have rock on both sides, so that each face's area equals that of its interfaces with faces that look at it and are not free: what
/// a face lacks block theory takes for free, and what it has too much for contact twice. Lists where more than 1e-6 of a joint's area is
/// off; what is less, slivers of 1e-9 of the model's size explain. O(faces + interfaces).
std::vector<LostContact> lost_contact(const BlockArrays& blocks);

}  // namespace rockfold
