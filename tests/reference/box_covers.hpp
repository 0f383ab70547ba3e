// Covers of convex bodies by plain clipping in double: an oracle for tests that shares nothing with host/.
#pragma once

#include <functional>
#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"

namespace rockfold::reference {

/// The points with normal · x ≤ offset.
struct HalfSpace {
  Vec3 normal{};
  Real offset = 0;
};

/// A convex part of the rock. Regions of one body are welded: they share covers. Regions must not overlap.
struct Region {
  std::vector<HalfSpace> planes;
  Index material = 0;
  Index block = 0;
  Index body = 0;
};

Region box(const Vec3& low, const Vec3& high, Index material = 0, Index block = 0, Index body = 0);

/// Cubes of side `spacing` with a node at `node`, turned by the angles (rad) about z, then x; large enough to hold the sphere.
Lattice turned_lattice(const Vec3& node, Real spacing, Real about_z, Real about_x,
                       const Vec3& centre, Real radius);

struct CoveredRegions {
  CoverArrays arrays;
  std::vector<Index> cover_body;    ///< [P]
  std::vector<Index> element_body;  ///< [E]
};

/// Lays the lattice over the regions. Pieces thinner than `least_volume` of a cell are left out.
CoveredRegions cover_regions(const Lattice& lattice, const std::vector<Region>& regions,
                             Real least_volume = 1e-13);

/// Points of a body, which must hold them. They may lie on its boundary.
MaterialPoints locate(const CoveredRegions& covered, const std::vector<Vec3>& points,
                      Index body = 0);

/// All vertices of pieces and all nodes of regular cells that `wanted` says yes to, each place once, m.
std::vector<Vec3> corner_points(const CoveredRegions& covered,
                                const std::function<bool(const Vec3&)>& wanted);

/// All three components of points fixed.
FixedPoints fix(const CoveredRegions& covered, const std::vector<Vec3>& points,
                const std::function<Vec3(const Vec3&)>& value, Real stiffness, bool augmented,
                Index body = 0);

/// The field at the covers' nodes: the exact representation of a linear field.
std::vector<Vec3> sample_at_nodes(const CoverArrays& covers,
                                  const std::function<Vec3(const Vec3&)>& field);

}  // namespace rockfold::reference
