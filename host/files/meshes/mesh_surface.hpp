// From the polygons of a mesh file to triangles that a solid or joints can be made of.
#pragma once

#include <vector>

#include "host/files/meshes/polygon_soup.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct MeshTriangles {
  TriangleSurface surface;
  std::vector<int> line;  ///< [triangles] of the file; 0 in binary files
};

/// Corners of identical coordinates become one vertex, numbered in the order of their first use;
/// polygons of more than 3 corners are triangulated (CGAL's constrained Delaunay triangulation in the
/// plane; of a convex quadrilateral along its shorter diagonal).
/// Throws Error(model) for polygons that are not planar to 1e-3 of their size, or by what coordinates rounded to `digit` (m) explain, or that touch
/// themselves, and for triangles without area. With `drop_collapsed`, triangles of two or three equal corners are left
/// out instead: what lies around them fits together without them.
MeshTriangles make_triangles(const PolygonSoup& soup, bool drop_collapsed, Faults& faults,
                             Real digit = 0);

/// What a surface that meets itself is said to be, if it holds several bodies.
enum class MeshHint { nothing, may_be_bodies, bodies_share_corners };

/// Throws Error(model), saying where and how many, for a surface that does not bound a solid: one with
/// open edges, edges of more than two triangles, neighbours of opposite sense, points where it touches
/// itself, intersections (exact), or components that are inside out (outer shells must be oriented
/// outward, cavities inward).
void check_solid(const MeshTriangles& mesh, Faults& faults, MeshHint hint = MeshHint::nothing);

}  // namespace rockfold
