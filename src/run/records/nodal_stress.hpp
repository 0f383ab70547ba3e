// Stress at points of a mesh, smooth within each block: what contours are drawn from.
#pragma once

#include <vector>

#include "kernels/time/motion.hpp"
#include "src/io/viewers/element_mesh.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// [K] Pa at the points of `mesh`: the mean over the tetrahedra about a point, weighted by their volume, of the stress that the
/// element of each has at that point. A field that is one polynomial in all elements comes out as it is, at boundaries too. Points
/// belong to one block and one material, so nothing is averaged across a joint. A point of no tetrahedron has none: zeros.
std::vector<Stress> average_nodal_stress(const CoverArrays& covers, const ElementMesh& mesh,
                                         const Motion& motion);

/// The same where the stress [nR + E] is uniform in each element.
std::vector<Stress> average_nodal_stress(const ElementMesh& mesh,
                                         const std::vector<Stress>& element_stress);

/// Whether it is: constant functions in tetrahedra, no initial stress that grows with depth.
bool stress_is_uniform(const CoverArrays& covers, const InitialStress& initial);

}  // namespace rockfold
