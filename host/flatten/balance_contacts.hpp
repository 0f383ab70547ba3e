// Contact of two sides of a joint that slivers show in different parts.
#pragma once

#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// Makes the contact of each face add up to its area, as far as faces beside it have what it lacks.
///
/// Where triangles of a joint are one plane but for rounding, cells between them are slivers, and the two sides of the joint may show them
/// as parts of different triangles. `interfaces` are told by the blocks of lower numbers; on the other block the face is the one that
/// shows most of the cell's face. Whatever such a face has above its area, another face of the same joint on the same block lacks: it goes
/// there, from the interfaces with faces that look straight at it. Moves nothing else. O(F + I log I).
void balance_contacts(BlockArrays& blocks);

}  // namespace rockfold
