// The points of all pairs at one time, and how a point is named.
#pragma once

#include "kernels/contact/detection/separating_plane_kernel.hpp"
#include "src/arrays/contact_arrays.hpp"

namespace rockfold::contact {

/// Pairs of parts of two blocks whose boxes are near: a < b, ascending.
struct Pairs {
  Index count = 0;
  Array<Index> a, b;  ///< [count] or longer
};

/// Pairs with their planes and points.
struct PointSet {
  Pairs pairs;
  Array<Plane> plane;        ///< [pairs]
  Array<Index> point_begin;  ///< [pairs+1]
  Array<ContactPoint> point;
  Index count = 0;      ///< of points
  Field found_at;       ///< [V] m, where vertices were when they were found
  Index detection = 0;  ///< by which one
};

/// The pair of two parts, or none.
KOKKOS_INLINE_FUNCTION Index find_pair(const Pairs& pairs, Index a, Index b) {
  Index low = 0, high = pairs.count;
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    const Index p = pairs.a(middle);
    if (p < a || (p == a && pairs.b(middle) < b))
      low = middle + 1;
    else
      high = middle;
  }
  return low < pairs.count && pairs.a(low) == a && pairs.b(low) == b ? low : none;
}

/// What a point is made of. Two points inside the overlap of two faces are told apart by the last bit of `first`. A point between the centre
/// of an overlap and one of its corners is named as the corner is, by corners of both faces for vertices and sides: overlaps have a centre each.
enum class PointKind : std::int32_t { vertex_face, face_vertex, side_side, inside };

/// Of `first`: a point between centre and corner. Features are fewer than 2^30.
inline constexpr Index between_flag = 1 << 30;

/// 2 bits of kind, 31 of each feature: vertices, faces, names of sides.
KOKKOS_INLINE_FUNCTION std::int64_t make_key(PointKind kind, Index first, Index second) {
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(kind) << 62) |
                                   (static_cast<std::uint64_t>(first) << 31) |
                                   static_cast<std::uint64_t>(second));
}
KOKKOS_INLINE_FUNCTION PointKind kind_of(std::int64_t key) {
  return static_cast<PointKind>(static_cast<std::uint64_t>(key) >> 62);
}
KOKKOS_INLINE_FUNCTION Index first_of(std::int64_t key) {
  return static_cast<Index>((static_cast<std::uint64_t>(key) >> 31) & 0x3fffffffu);
}
KOKKOS_INLINE_FUNCTION Index second_of(std::int64_t key) {
  return static_cast<Index>(static_cast<std::uint64_t>(key) & 0x7fffffffu);
}

/// The first tangential direction of a point: a side of the feature that names it, made tangential. It turns with the material.
KOKKOS_INLINE_FUNCTION Vector material_direction(const Surfaces& s, const Pose& pose,
                                                 std::int64_t key, const Vector& n) {
  const PointKind kind = kind_of(key);
  Index corner = first_of(key);
  if (kind == PointKind::vertex_face) corner = s.corner_begin(second_of(key));
  if (kind == PointKind::face_vertex) corner = s.corner_begin(first_of(key));
  if (kind == PointKind::inside) corner = s.corner_begin(first_of(key) >> 1);
  const Index next = next_corner(s, s.corner_face(corner), corner);
  const Vector d = unit(at(pose.x, s.corner_vertex(next)) - at(pose.x, s.corner_vertex(corner)));
  const Vector t = d - dot(d, n) * n;
  // A face so steep that its side runs along n has next to no area in the overlap.
  return dot(t, t) > near_plane * near_plane ? unit(t) : any_across(n);
}

/// Σ weight · x(vertex): of places, the first side from the second.
KOKKOS_INLINE_FUNCTION Vector between(const ContactPoint& p, const Field& x) {
  Vector d;
  for (int k = 0; k < 6; ++k) d = d + p.weight[k] * at(x, p.vertex[k]);
  return d;
}

}  // namespace rockfold::contact
