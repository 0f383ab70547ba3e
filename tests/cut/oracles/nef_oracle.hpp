// Blocks by CGAL's Nef polyhedra: rock less its joints as infinitely thin facets. An oracle for solids and polygons of any
// position; exact, slow, and shares nothing with host/.
#pragma once

#include <vector>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

/// A volume of the Nef polyhedron after dead-end joints are taken out of its boundary; counts by the definitions of
/// docs/user_guide.md, but that all joints are of one origin, and all faces of solids too: coplanar neighbours of two origins
/// count as one face.
struct NefBlock {
  Real volume = 0;  ///< m³, rounded once
  Vec3 centroid{};
  Counts counts;
  Index shells = 0, genus = 0;
  Real dead_end_area = 0, joint_area = 0;  ///< m², of joints between it and other blocks
};

/// Solids: boxes, half-spaces, prisms. Joints by normals, with polygons (projected on their planes exactly) or none.
/// Numbers are taken as they are: no tolerance anywhere.
std::vector<NefBlock> nef_blocks(const Model& model);

/// What differs, one line each (at most 20): block by block, matched by volume and centroid. Volumes to 1e-10 of the rock's.
std::vector<std::string> differences(const Blocks& found, const std::vector<NefBlock>& expected);

}  // namespace rockfold::test
