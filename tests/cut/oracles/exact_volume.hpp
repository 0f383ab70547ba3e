// Volumes of what a model says, in integers: each number is the shortest decimal that reads back as its double (decision 5,
// rule 1), which for map coordinates differs from the double by up to 1e-10 m. Shares nothing with host/.
#pragma once

#include "src/model/model.hpp"

namespace rockfold::test {

/// m³, below a ground surface and above the base elevation; rounded once.
long double volume_below(const TriangleSurface& ground, Real base);

/// m³, enclosed by a closed surface; negative if it is inside out.
long double signed_volume(const TriangleSurface& surface);

/// m³, of axis-parallel boxes added and subtracted in the order of the list. All solids must be boxes.
long double volume_of_boxes(const std::vector<Solid>& solids);

}  // namespace rockfold::test
