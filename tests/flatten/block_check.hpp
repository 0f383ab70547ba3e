// What must hold in every BlockArrays, whatever was cut.
#pragma once

#include <string>
#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold::test {

/// One line for each rule broken (at most 20); empty if the arrays are consistent. `size` is the model's size in m:
/// lengths agree to 1e-9 of it.
///   V − E + F − (holes) = 2·(shells − genus); volume and centroid are those that the faces enclose; areas and normals are
///   those of the loops; the interfaces of a joint face add up to its area, and lie on two sides of one plane; a face
///   without an interface is a solid's.
std::vector<std::string> faults_of(const BlockArrays& blocks, Real size);

}  // namespace rockfold::test
