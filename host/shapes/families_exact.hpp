// One function for each family of shapes; shape_geometry.cpp asks the right one. CGAL's numbers: include in .cpp only.
#pragma once

#include "host/shapes/shape_geometry_exact.hpp"

namespace rockfold {

ShapeGeometry box_geometry(const BoxShape& box);
ShapeGeometry halfspaces_geometry(const HalfspacesShape& shape, bool bounded, const Place& place);
ShapeGeometry prism_geometry(const PrismShape& prism, const Place& place);
ShapeGeometry pyramid_geometry(const PyramidShape& pyramid, const Place& place);
ShapeGeometry frustum_geometry(const FrustumShape& frustum, const Place& place);

/// The first corner of the section lies to the right of the axis, seen along it (section_frame.hpp: for a vertical axis to
/// the east), the others follow counter-clockwise.
ShapeGeometry cylinder_geometry(const CylinderShape& cylinder, const Place& place);

/// The icosahedron's edges stand on the axes' ends: its vertices are (0, ±1, ±φ) and their rotations.
ShapeGeometry sphere_geometry(const SphereShape& sphere);

/// One part for each segment of the path and convex piece of the section. At bends the parts end on a common plane through
/// the path point that bisects the angle. It belongs to no face where the sections of both segments meet on it. Where they
/// do not (a path that turns and inclines at once rolls its section; a vertical segment's section is laid out by east), the
/// tunnel is the union of both parts all the same, and what stands out of the other part on that plane belongs to the end
/// face n+1 for the segment before the bend and to the start face n for the one after it.
/// Path points on the straight line between their neighbours (to 1e-10 of its length) are left out.
ShapeGeometry tunnel_geometry(const TunnelShape& tunnel, const Place& place);

ShapeGeometry mesh_geometry(const MeshShape& mesh, const Place& place);

/// The ground, a vertical wall under each edge of its boundary, and the bottom: one rectangle under a rectangular ground
/// (whose edges then hold many corners of the walls), else triangles. 500 × 500 posts take well under a second.
ShapeGeometry terrain_geometry(const TerrainShape& terrain, const Place& place);

/// The corners of the box from min to max, x first.
std::vector<Vec3> box_corners(const Vec3& min, const Vec3& max);
/// The corners of the points' bounding box.
std::vector<Vec3> bounding_corners(const std::vector<Vec3>& points);

/// The plane through the first point and the two neighbours that make the largest triangle with it: of a polygon's
/// triangles about its first corner the one that defines its plane best.
ExactPlane plane_of_polygon(const std::vector<Vec3>& polygon);

}  // namespace rockfold
