// The planes of solids, excavations and merged regions. CGAL's numbers: include in .cpp only.
#pragma once

#include <vector>

#include "host/exact/plane_table.hpp"
#include "host/shapes/shape_geometry_exact.hpp"

namespace rockfold {

/// For each part the half-space of each of its faces, inside. Faces get their planes in the order of their size in the box
/// ±reach about the table's centre, the largest first, whatever the order of the parts; planes that coincide are one (rule 2).
std::vector<std::vector<HalfSpaceId>> part_half_spaces(const std::vector<const ConvexPart*>& parts,
                                                       const Vec3& reach, PlaneTable& planes);

}  // namespace rockfold
