// Where two parts touch along parallel edges, or at a corner of one and a corner or an edge of the other, a whole cone of planes separates
// them: the directions in which either is extreme there. Its extreme directions are normals of faces and cross products of edges, all of
// the same gap; which of them would be the plane is a matter of order. The plane is the middle of the cone, the axis of the narrowest
// circular cone round it: of two mirror images the mirror image, and whatever the order of faces is.
//
// Parts that touch so lie on each other at the middle until they have come by `slack` along it; then one has slid onto a face of the other.
#pragma once

#include "kernels/contact/detection/separating_plane_kernel.hpp"

namespace rockfold::contact {

/// m, by how much edges may miss each other and yet touch: what the thinner part may strain.
KOKKOS_INLINE_FUNCTION Real slack_of(const Surfaces& s, const Pose& pose, Index a, Index b,
                                     const Vector& n) {
  const auto thickness = [&](Index part) {
    return -(support(s, pose, part, n, 1) + support(s, pose, part, n, -1));
  };
  return most_strain * math::fmin(thickness(a), thickness(b));
}

/// The extreme directions of a cone.
class Cone {
 public:
  /// Corners of rock have three faces or a few more; of a cone with more the first count.
  static constexpr int room = 12;

  KOKKOS_INLINE_FUNCTION void add(const Vector& n) {
    for (int i = 0; i < count_; ++i)
      if (length(cross(n_[i], n)) < most_strain && dot(n_[i], n) > 0) return;
    if (count_ < room) n_[count_++] = n;
  }
  KOKKOS_INLINE_FUNCTION int count() const { return count_; }

  /// The axis of the narrowest circular cone round all of them: it touches two of them, across from each other, or three.
  KOKKOS_INLINE_FUNCTION Vector middle() const {
    Vector best;
    Real most = -1;
    const auto attempt = [&](const Vector& axis, const Vector& on_it) {
      const Real width = dot(axis, on_it);
      if (!(width > most)) return;
      for (int i = 0; i < count_; ++i)
        if (dot(axis, n_[i]) < width - rounding) return;
      best = axis;
      most = width;
    };
    for (int i = 0; i < count_; ++i)
      for (int j = i + 1; j < count_; ++j) attempt(unit(n_[i] + n_[j]), n_[i]);
    if (most > -1) return best;
    for (int i = 0; i < count_; ++i)
      for (int j = i + 1; j < count_; ++j)
        for (int k = j + 1; k < count_; ++k) {
          const Vector axis = unit(cross(n_[j] - n_[i], n_[k] - n_[i]));
          attempt(dot(axis, n_[i]) < 0 ? -axis : axis, n_[i]);
        }
    return best;
  }

 private:
  static constexpr Real rounding = 1e-12;
  Vector n_[room];
  int count_ = 0;
};

/// The cone of planes beside the one that was chosen.
class ConeSearch {
 public:
  KOKKOS_INLINE_FUNCTION ConeSearch(const Surfaces& surfaces, const Pose& before, const Pose& now,
                                    const Query& query, const Choice& chosen)
      : s_(surfaces), before_(before), now_(now), q_(query), chosen_(chosen) {
    slack_ = slack_of(s_, now_, q_.a, q_.b, direction(s_, now_, chosen.plane));
  }

  /// The chosen plane, or the middle of the cone where there is one.
  KOKKOS_INLINE_FUNCTION Plane run() {
    const Index fa = s_.part_face_begin(q_.a), fb = s_.part_face_begin(q_.b);
    if (!touches() || fa == s_.part_face_begin(q_.a + 1) || fb == s_.part_face_begin(q_.b + 1))
      return chosen_.plane;
    collect();
    if (cone_.count() < 2 || lies_on_joint_) return chosen_.plane;
    const Vector n = cone_.middle();
    if (!is_one_of_it(now_, n)) return chosen_.plane;
    return {Plane::middle,
            fa,
            fb,
            0,
            face_frame(s_, now_, fa).into(n),
            face_frame(s_, now_, fb).into(n)};
  }

 private:
  KOKKOS_INLINE_FUNCTION bool swept() const { return q_.how == Search::swept; }

  KOKKOS_INLINE_FUNCTION bool touches() const {
    return swept() ? !(chosen_.gap > 0) : math::fabs(chosen_.gap) <= slack_;
  }

  KOKKOS_INLINE_FUNCTION void collect() {
    for (Index f = s_.part_face_begin(q_.a); f < s_.part_face_begin(q_.a + 1); ++f)
      if (is_one_of_it(now_, -at(now_.normal, f))) add_face(f, q_.b, -at(now_.normal, f));
    for (Index f = s_.part_face_begin(q_.b); f < s_.part_face_begin(q_.b + 1); ++f)
      if (is_one_of_it(now_, at(now_.normal, f))) add_face(f, q_.a, at(now_.normal, f));
    for (Index ea = s_.part_edge_begin(q_.a); ea < s_.part_edge_begin(q_.a + 1); ++ea)
      for (Index eb = s_.part_edge_begin(q_.b); eb < s_.part_edge_begin(q_.b + 1); ++eb) {
        if (s_.edge_far(ea) || s_.edge_far(eb) || !arcs_cross(s_, now_, ea, eb)) continue;
        const Vector n = direction(s_, now_, {Plane::edges, ea, eb});
        if (dot(n, n) > 0 && is_one_of_it(now_, n)) cone_.add(n);
      }
  }

  /// Where joints cross, blocks across from each other touch at an edge with faces on one joint: others lie between them, and the joint
  /// is the plane.
  KOKKOS_INLINE_FUNCTION void add_face(Index f, Index other, const Vector& n) {
    cone_.add(n);
    for (Index g = s_.part_face_begin(other); g < s_.part_face_begin(other + 1); ++g)
      if ((s_.face_joint(f) != none || s_.face_joint(g) != none) &&
          length(cross(at(now_.normal, f), at(now_.normal, g))) < most_strain &&
          is_one_of_it(now_, n))
        lies_on_joint_ = lies_on_joint_ || dot(at(now_.normal, f), at(now_.normal, g)) < 0;
  }

  /// Whether parts touch along n as they do along the plane chosen: with the same gap, or crossed in the same place.
  KOKKOS_INLINE_FUNCTION bool is_one_of_it(const Pose& pose, const Vector& n) const {
    const Real gap = gap_along(s_, pose, q_.a, q_.b, n);
    if (!swept()) return chosen_.gap - gap <= slack_;
    const Real start = gap_along(s_, before_, q_.a, q_.b, n);
    return start > 0 && chosen_.score * (start - gap) - start <= slack_;
  }

  const Surfaces& s_;
  const Pose &before_, &now_;
  const Query& q_;
  const Choice& chosen_;
  Cone cone_{};
  Real slack_ = 0;
  bool lies_on_joint_ = false;
};

/// Whether parts that were on the middle of a cone touch on the plane chosen now: a part has come by more than the slack along the middle,
/// or, where they met in this step, crossed the plane by more than that after the middle.
KOKKOS_INLINE_FUNCTION bool leaves_middle(const Surfaces& s, const Pose& before, const Pose& now,
                                          const Query& q, const Plane& middle,
                                          const Choice& chosen) {
  if (chosen.plane.kind == Plane::unknown) return false;
  const Vector n = direction(s, now, middle);
  const Real slack = slack_of(s, now, q.a, q.b, n), gap = gap_along(s, now, q.a, q.b, n);
  if (q.how == Search::swept && !(chosen.gap > 0)) {
    const Real start = gap_along(s, before, q.a, q.b, direction(s, before, middle));
    return chosen.score * (start - gap) - start > slack;
  }
  return chosen.gap - dot(direction(s, now, chosen.plane), n) * gap > slack;
}

}  // namespace rockfold::contact
