// The separating plane of two convex parts a and b: its normal n points from b to a, and the gap along it is
// min over a of n·x − max over b of n·x. Parts are apart where some gap is positive (separating axis theorem: for convex polyhedra it
// is enough to try the normals of faces and the cross products of edges whose normals' arcs cross; Gregorius, GDC 2013).
//
// A plane persists. While a pair touches, only planes whose normals are within ten degrees of the one before are looked at,
// so that a small overlap sideways never wins over the plane that carries the load, and an overrun reads as deep penetration. A pair that was
// apart at the start of a step touches on the plane, turned by no more than that, which it crossed last (the moving separating axis test: Ericson, Real-Time
// Collision Detection, 2005, 5.5.8). Edges that are parallel, and corners, may touch on a whole cone of planes: see cone_kernel.hpp.
#pragma once

#include "kernels/contact/detection/surfaces_kernel.hpp"

namespace rockfold::contact {

/// A separating plane, by what it lies on.
struct Plane {
  enum Kind : std::int32_t { unknown, face_of_a, face_of_b, edges, middle };
  std::int32_t kind = unknown;
  /// A face; an edge of a and one of b; of the middle of a cone the faces of a and b that it turns with.
  Index first = none, second = none;
  std::int32_t turning = 0;  ///< 1: faces turn in it while they slide (turning_kernel.hpp)
  Vector in_a{}, in_b{};     ///< the normal of a middle in the frames of both faces
};

/// A normal that turns by more than this in a step halves it: planes of one contact from step to step lie closer. cos 10°.
inline constexpr Real near_direction = 0.984807753012208;
/// sin 10°.
inline constexpr Real near_plane = 0.17364817766693;

/// Rock under load strains by less than this, so that faces turn and their sides shift by as little.
inline constexpr Real most_strain = 1e-4;

KOKKOS_INLINE_FUNCTION Vector edge_direction(const Surfaces& s, const Pose& pose, Index e) {
  return at(pose.x, s.edge_vertex(2 * e + 1)) - at(pose.x, s.edge_vertex(2 * e));
}

/// Axes that turn with a face: along its first side, across it, out of it.
struct FaceFrame {
  Vector u, v, n;

  KOKKOS_INLINE_FUNCTION Vector into(const Vector& d) const {
    return {dot(d, u), dot(d, v), dot(d, n)};
  }
  KOKKOS_INLINE_FUNCTION Vector out_of(const Vector& d) const {
    return d.x * u + d.y * v + d.z * n;
  }
};
KOKKOS_INLINE_FUNCTION FaceFrame face_frame(const Surfaces& s, const Pose& pose, Index face) {
  const Index c = s.corner_begin(face);
  const Vector n = at(pose.normal, face);
  const Vector side = at(pose.x, s.corner_vertex(c + 1)) - at(pose.x, s.corner_vertex(c));
  const Vector u = unit(side - dot(side, n) * n);
  return {u, cross(n, u), n};
}

/// n of a plane in a pose; zero where two edges are parallel. The middle of a cone turns by the mean of both parts' turns.
KOKKOS_INLINE_FUNCTION Vector direction(const Surfaces& s, const Pose& pose, const Plane& p) {
  if (p.kind == Plane::face_of_a) return -at(pose.normal, p.first);
  if (p.kind == Plane::face_of_b) return at(pose.normal, p.first);
  if (p.kind == Plane::middle)
    return unit(face_frame(s, pose, p.first).out_of(p.in_a) +
                face_frame(s, pose, p.second).out_of(p.in_b));
  const Vector ea = edge_direction(s, pose, p.first), eb = edge_direction(s, pose, p.second);
  const Vector n = cross(ea, eb);
  // Parallel to rounding: their faces' normals serve.
  if (dot(n, n) < 1e-20 * dot(ea, ea) * dot(eb, eb)) return {};
  const Vector outward =
      at(pose.normal, s.edge_face(2 * p.second)) + at(pose.normal, s.edge_face(2 * p.second + 1));
  return unit(dot(n, outward) < 0 ? -n : n);
}

/// The lowest (sign 1) or highest (sign −1) place of a part along n, times sign.
KOKKOS_INLINE_FUNCTION Real support(const Surfaces& s, const Pose& pose, Index part,
                                    const Vector& n, Real sign) {
  Real least = 0;
  const Index begin = s.part_vertex_begin(part);
  for (Index i = begin; i < s.part_vertex_begin(part + 1); ++i) {
    const Real h = sign * dot(n, at(pose.x, s.part_vertex(i)));
    if (i == begin || h < least) least = h;
  }
  return least;
}

/// The gap along any direction.
KOKKOS_INLINE_FUNCTION Real gap_along(const Surfaces& s, const Pose& pose, Index a, Index b,
                                      const Vector& n) {
  return support(s, pose, a, n, 1) + support(s, pose, b, n, -1);
}

/// Whether the arcs of normals of an edge of a and of one of b turned round cross: then both are extreme along their normal.
KOKKOS_INLINE_FUNCTION bool arcs_cross(const Surfaces& s, const Pose& pose, Index ea, Index eb) {
  const Vector a = at(pose.normal, s.edge_face(2 * ea)),
               b = at(pose.normal, s.edge_face(2 * ea + 1));
  const Vector c = -at(pose.normal, s.edge_face(2 * eb)),
               d = -at(pose.normal, s.edge_face(2 * eb + 1));
  const Vector ba = cross(b, a), dc = cross(d, c);
  const Real cba = dot(c, ba), dba = dot(d, ba), adc = dot(a, dc), bdc = dot(b, dc);
  return cba * dba < 0 && adc * bdc < 0 && cba * bdc > 0;
}

KOKKOS_INLINE_FUNCTION bool is_of(const Surfaces& s, Index part, Index f) {
  return f >= s.part_face_begin(part) && f < s.part_face_begin(part + 1);
}

/// Whether the plane lies on nothing that the parts show: on a virtual face, on an edge of virtual faces, or on what bounds another patch of
/// the convex body that a part is one of. What comes near to it there touches another part.
KOKKOS_INLINE_FUNCTION bool is_far(const Surfaces& s, Index a, Index b, const Plane& p) {
  if (p.kind == Plane::edges) return s.edge_far(p.first) != 0 || s.edge_far(p.second) != 0;
  return (p.kind == Plane::face_of_a && !is_of(s, a, p.first)) ||
         (p.kind == Plane::face_of_b && !is_of(s, b, p.first));
}

/// The gap along n, the normal of a face or a far face of a or b. The face is extreme there.
KOKKOS_INLINE_FUNCTION Real gap_on_face(const Surfaces& s, const Pose& pose, Index a, Index b,
                                        const Plane& p, const Vector& n) {
  const Real place = dot(n, at(pose.x, s.corner_vertex(s.corner_begin(p.first))));
  return p.kind == Plane::face_of_a ? place + support(s, pose, b, n, -1)
                                    : support(s, pose, a, n, 1) - place;
}

/// The gap along a plane found in another pose: its face or edges may no longer be extreme.
KOKKOS_INLINE_FUNCTION Real gap_along(const Surfaces& s, const Pose& pose, Index a, Index b,
                                      const Plane& p, const Vector& n) {
  return p.kind != Plane::edges && is_far(s, a, b, p) ? gap_on_face(s, pose, a, b, p, n)
                                                      : gap_along(s, pose, a, b, n);
}

/// How a plane is chosen.
enum class Search {
  widest,  ///< the largest gap at the end
  swept,  ///< of those that were open at the start: the largest gap at the end, or the one crossed last; far ones where they still part
  local   ///< the largest gap at the end among those near `direction` that are not far
};

struct Query {
  Index a, b;
  Search how;
  Vector near{};    ///< of Search::local
  Real enough = 0;  ///< m: a plane with a larger gap ends the search
};

/// The best of the planes tried so far.
struct Choice {
  Plane plane{};
  Real score = 0, gap = 0;
};

class PlaneSearch {
 public:
  KOKKOS_INLINE_FUNCTION PlaneSearch(const Surfaces& surfaces, const Pose& before, const Pose& now,
                                     const Query& query)
      : s_(surfaces), before_(before), now_(now), q_(query) {}

  KOKKOS_INLINE_FUNCTION Choice run() {
    try_faces(q_.a, Plane::face_of_a);
    try_faces(q_.b, Plane::face_of_b);
    for (Index ea = s_.part_edge_begin(q_.a); ea < s_.part_edge_begin(q_.a + 1) && !done_; ++ea) {
      if (q_.how == Search::local && (s_.edge_far(ea) || !may_be_near(ea, -q_.near))) continue;
      for (Index eb = s_.part_edge_begin(q_.b); eb < s_.part_edge_begin(q_.b + 1) && !done_; ++eb) {
        if (q_.how == Search::local && (s_.edge_far(eb) || !may_be_near(eb, q_.near))) continue;
        if (arcs_cross(s_, now_, ea, eb)) try_plane({Plane::edges, ea, eb});
      }
    }
    return best_;
  }

 private:
  KOKKOS_INLINE_FUNCTION void try_faces(Index part, Plane::Kind kind) {
    for (Index f = s_.part_face_begin(part); f < s_.part_face_begin(part + 1) && !done_; ++f)
      try_plane({kind, f, none});
    if (q_.how == Search::local) return;
    for (Index i = s_.part_far_begin(part); i < s_.part_far_begin(part + 1) && !done_; ++i)
      try_plane({kind, s_.part_far_face(i), none});
  }

  /// Whether an edge can be extreme along a direction within ten degrees of n: it is nearly across it and on that side.
  KOKKOS_INLINE_FUNCTION bool may_be_near(Index e, const Vector& n) const {
    const Vector d = edge_direction(s_, now_, e);
    const Real along = dot(d, n);
    if (along * along > near_plane * near_plane * dot(d, d)) return false;
    const Vector outward =
        at(now_.normal, s_.edge_face(2 * e)) + at(now_.normal, s_.edge_face(2 * e + 1));
    return dot(outward, n) > -near_plane * length(outward);
  }

  KOKKOS_INLINE_FUNCTION Real gap_of(const Pose& pose, const Plane& p, const Vector& n) const {
    if (p.kind != Plane::edges) return gap_on_face(s_, pose, q_.a, q_.b, p, n);
    return dot(n,
               at(pose.x, s_.edge_vertex(2 * p.first)) - at(pose.x, s_.edge_vertex(2 * p.second)));
  }

  /// How good a plane with that gap at the end is. False where it is none of those looked for.
  KOKKOS_INLINE_FUNCTION bool find_score(const Plane& p, const Vector& n, Real gap,
                                         Real& score) const {
    score = gap;
    if (q_.how != Search::swept) return true;
    if (!(gap > 0) && is_far(s_, q_.a, q_.b, p)) return false;
    // Edges that were not extreme at the start say nothing about it: there the direction itself is asked.
    const Vector m = direction(s_, before_, p);
    if (!(dot(m, n) > near_direction)) return false;
    const Real start =
        p.kind == Plane::edges ? gap_along(s_, before_, q_.a, q_.b, m) : gap_of(before_, p, m);
    if (!(start > 0)) return false;
    score = gap > 0 ? 1 + gap : start / (start - gap);  // the time of crossing, up to 1
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool is_better(const Plane& p, Real score) const {
    // A plane of edges has to be better by more than rounding: faces carry more points.
    const Real margin = p.kind == Plane::edges ? s_.tolerance : 0;
    return best_.plane.kind == Plane::unknown || score > best_.score + margin;
  }

  KOKKOS_INLINE_FUNCTION void try_plane(const Plane& p) {
    const Vector n = direction(s_, now_, p);
    if (dot(n, n) == 0) return;
    if (q_.how == Search::local && dot(n, q_.near) < near_direction) return;
    Real gap = gap_of(now_, p, n), score = 0;
    if (!find_score(p, n, gap, score) || !is_better(p, score)) return;
    // Of edges that are parallel but for rounding, and of faces that are no wider than it, it may point anywhere: then parts reach beyond.
    const Real whole = gap_along(s_, now_, q_.a, q_.b, n);
    if (p.kind == Plane::edges ? whole < gap - s_.tolerance : whole < gap - q_.enough) {
      gap = whole;
      if (!find_score(p, n, gap, score) || !is_better(p, score)) return;
    }
    best_.plane = p;
    best_.score = score;
    best_.gap = gap;
    done_ = gap > q_.enough;
  }

  const Surfaces& s_;
  const Pose &before_, &now_;
  const Query& q_;
  Choice best_{};
  bool done_ = false;
};

}  // namespace rockfold::contact
