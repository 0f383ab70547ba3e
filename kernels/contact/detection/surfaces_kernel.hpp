// SurfaceArrays on the device, and what they look like in one pose.
#pragma once

#include "kernels/contact/vector_kernel.hpp"
#include "src/arrays/surface_arrays.hpp"

namespace rockfold::contact {

/// The arrays of SurfaceArrays by the same names.
struct Surfaces {
  Index parts = 0, vertices = 0, faces = 0;
  Index shown_faces = 0;  ///< those that are no hull faces come first
  Real tolerance = 0;
  Real thinnest = 0;       ///< m, the least of part_width
  Array<Real> part_width;  ///< [parts] m, in place: the least extent along a normal of a face
  Array<Real> block_mass;
  Array<Index> part_block, part_vertex_begin, part_vertex, part_face_begin, part_edge_begin;
  Array<Index> part_far_begin, part_far_face;
  Array<Index> corner_begin, corner_vertex, corner_side, face_joint, face_material;
  Array<Index> face_centre;  ///< [F] a vertex, or none
  Array<Index> corner_face;  ///< [C] the face of each corner
  Array<Index> edge_vertex, edge_face;
  Array<std::uint8_t> edge_far;
};
Surfaces upload(const SurfaceArrays& surfaces);

/// Where all vertices are, and the unit outward normals of the faces there.
struct Pose {
  Field x;       ///< [V] m
  Field normal;  ///< [F]
};
Pose make_pose(const Surfaces& surfaces);
/// Copies the places and finds the normals: of a face that is no longer plane, those of its area vector.
void set_pose(const Surfaces& surfaces, const Field& x, const Pose& pose);

/// The corner after c of the face that ends before `end`.
KOKKOS_INLINE_FUNCTION Index next_corner(const Surfaces& s, Index face, Index c) {
  return c + 1 < s.corner_begin(face + 1) ? c + 1 : s.corner_begin(face);
}

/// The largest distance of a vertex between two sets of places, m.
Real largest_shift(const Field& one, const Field& two);

/// The largest length of a vector of the field.
Real largest_length(const Field& field);

}  // namespace rockfold::contact
