// Facets of one rough surface as the few planes that they are, but for their roughness.
// docs/block_theory.md, "Joints from meshes".
#pragma once

#include <span>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct SurfaceFacet {
  Vec3 normal{};  ///< unit, outward
  Real area = 0;  ///< m², > 0
};

/// Facets that together are less than this share of the surface begin no plane. One that had to carry a block alone would
/// bear 10⁴ times the mean stress: under a metre of rock (27 kPa) 270 MPa, which crushes granite.
constexpr Real least_plane_share = 1e-4;

/// The mean normal of the plane that each facet belongs to, unit: the facets of a plane are within `flatness` (deg) of the
/// mean of their normals, weighted by area. Bit for bit the same whatever the order of the facets. With a flatness of 0
/// each facet keeps its own normal.
///
/// All facets are one plane if they can be. Otherwise there are at first as many as there are facets more than twice the
/// flatness apart, since no two of them can share a plane. Facets go to the nearest mean, means are taken anew until
/// nothing changes (Lloyd 1982), and as long as a facet is too far from its mean, it begins another plane.
/// Cost: O(F log F) for F facets, and F times the number of planes.
std::vector<Vec3> mean_plane_normals(std::span<const SurfaceFacet> facets, Real flatness);

}  // namespace rockfold
