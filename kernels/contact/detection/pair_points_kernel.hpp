// The contact points of one pair of parts, given its separating plane: all overlaps of a face of a that looks down upon it with a face of
// b that looks up, seen along its normal. So a face on a face, a vertex on a face and two crossing edges are one case: as a block
// tilts, areas change steadily, and corners keep their names.
//
// Faces steeper than `most_strain` (cosine to the normal) are left out, and so are overlaps beside a joint that are narrower than this share
// of its size: there are many, and the pivot of a block moves by no more.
//
// Of faces that turn in their plane while they slide (Plane::turning) all overlaps carry as a joint's do, and half-way to their corners too.
#pragma once

#include "kernels/contact/detection/overlap_kernel.hpp"
#include "kernels/contact/detection/point_set_kernel.hpp"

namespace rockfold::contact {

/// The share κ by which corners alone carry an overlap (exact to degree 1). A joint has a stiffness against turning, which points inside
/// get right. Faces that met are rigid: they take up an impact at their corners, and a block that rocks loses what it must (Housner 1963).
inline constexpr Real all_in_corners = 0.5;

/// Cosine of 10°: by more a normal does not turn in a step.
inline constexpr Real nearly_parallel = 0.984807753012208;

struct PointOptions {
  Real search_distance = 0;              ///< m: points with a larger gap are none
  Array<std::int16_t> law_of_pair = {};  ///< [materials][materials] where no joint joined the faces
  Index materials = 1;                   ///< of faces, with none
  bool starting = false;                 ///< step 0: joints of the cut are whole, their gaps zero
};

/// Where the points of a pair are put.
struct Room {
  Array<ContactPoint> point;
  std::size_t begin = 0;
  Index capacity = 0;
};

class PairPoints {
 public:
  KOKKOS_INLINE_FUNCTION PairPoints(const Surfaces& surfaces, const Pose& pose, Index a, Index b,
                                    const Plane& plane, const PointOptions& options,
                                    const Room& room)
      : s_(surfaces),
        pose_(pose),
        a_(a),
        b_(b),
        n_(direction(surfaces, pose, plane)),
        turning_(plane.turning != 0),
        options_(options),
        room_(room) {}

  /// Returns how many points there are: of more than the capacity, the first.
  KOKKOS_INLINE_FUNCTION Index run() {
    add_overlaps(true);
    add_overlaps(false);
    return count_;
  }

  /// Whether every overlap is a strip that is narrower than it is deep: then the parts are nearer to being apart in another direction.
  KOKKOS_INLINE_FUNCTION bool deeper_than_wide() const { return count_ > 0 && deepest_ > width_; }

 private:
  /// Those of the two sides of a joint, or all others.
  KOKKOS_INLINE_FUNCTION void add_overlaps(bool joined) {
    for (Index fa = s_.part_face_begin(a_); fa < s_.part_face_begin(a_ + 1); ++fa) {
      const Vector na = at(pose_.normal, fa);
      if (!(dot(na, n_) < -most_strain)) continue;
      for (Index fb = s_.part_face_begin(b_); fb < s_.part_face_begin(b_ + 1); ++fb) {
        const Vector nb = at(pose_.normal, fb);
        if (!(dot(nb, n_) > most_strain) || (joint_of(fa, fb) != none) != joined) continue;
        const bool parallel = dot(na, nb) <= -nearly_parallel;
        // While the sides of a joint lie on each other, faces at an angle to each other only touch at its rim.
        if (on_joint_ && !joined && !parallel) continue;
        const Index before = count_;
        add_overlap(fa, fb, joined, parallel);
        on_joint_ = on_joint_ || (joined && parallel && count_ > before);
      }
    }
  }

  /// The joint that both faces are sides of, or none.
  KOKKOS_INLINE_FUNCTION Index joint_of(Index fa, Index fb) const {
    return s_.face_joint(fa) == s_.face_joint(fb) ? s_.face_joint(fa) : none;
  }

  /// Of an overlap beside a joint: narrower than sides shift.
  KOKKOS_INLINE_FUNCTION bool is_left_out(const OverlapRule& rule) const {
    return rule.width * rule.width < most_strain * most_strain * joint_area_;
  }

  KOKKOS_INLINE_FUNCTION void add_overlap(Index fa, Index fb, bool joined, bool parallel) {
    const Chart chart = make_chart(at(pose_.x, s_.corner_vertex(s_.corner_begin(fb))), n_);
    const Outline one(s_, pose_.x, chart, fa, true), two(s_, pose_.x, chart, fb, false);
    if (are_apart(one, two)) return;
    OverlapRule rule = overlap_rule(one, two, s_.tolerance);
    width_ = math::fmax(width_, rule.width);
    if (!(rule.area > 0) || (!joined && is_left_out(rule))) return;
    const bool turning = turning_ && parallel;
    if (joined) joint_area_ += rule.area;
    if (turning)
      add_between(one, two, s_.tolerance, rule);
    else if (!joined)
      rule.corner = all_in_corners;
    for_each_segment(one, two, s_.tolerance,
                     [&](const Flat& p, const Flat& q, const Clipped& c, Index side, bool swapped) {
                       const Real area =
                           0.5 * math::fmax(0.0, cross(p - rule.centre, q - rule.centre));
                       const Outline& own = swapped ? two : one;
                       const Outline& other = swapped ? one : two;
                       for (const bool end : {false, true}) {
                         const OverlapCorner corner =
                             corner_at(own, side, other, c, end ? c.to : c.from,
                                       end ? c.cut_to : c.cut_from, swapped, s_.tolerance);
                         add_corner(one, two, corner, rule.corner * area);
                         if (rule.between > 0)
                           add_between_corner(one, two, corner, 0.5 * (rule.centre + (end ? q : p)),
                                              rule.between * area);
                       }
                     });
    if (joined || turning) add_inside(one, two, rule);
  }

  /// Whether a side of either has all of the other beyond it; quick, and most pairs of faces are.
  KOKKOS_INLINE_FUNCTION bool are_apart(const Outline& one, const Outline& two) const {
    Real low[2][2], high[2][2];
    for (int k = 0; k < 2; ++k) {
      const Outline& o = k == 0 ? one : two;
      for (Index i = 0; i < o.count; ++i) {
        const Flat p = o.point(i);
        low[k][0] = i == 0 ? p.u : math::fmin(low[k][0], p.u);
        high[k][0] = i == 0 ? p.u : math::fmax(high[k][0], p.u);
        low[k][1] = i == 0 ? p.v : math::fmin(low[k][1], p.v);
        high[k][1] = i == 0 ? p.v : math::fmax(high[k][1], p.v);
      }
    }
    return low[0][0] >= high[1][0] || low[1][0] >= high[0][0] || low[0][1] >= high[1][1] ||
           low[1][1] >= high[0][1];
  }

  KOKKOS_INLINE_FUNCTION void add_corner(const Outline& one, const Outline& two,
                                         const OverlapCorner& c, Real area) {
    if (c.kind == OverlapCorner::of_first) {
      const Index v = one.vertex(c.first);
      add(make_key(PointKind::vertex_face, v, two.face), {{v, v, v}, {1, 0, 0}},
          carriers_of(two, one.point(c.first)), area, one.face, two.face);
    } else if (c.kind == OverlapCorner::of_second) {
      const Index v = two.vertex(c.second);
      add(make_key(PointKind::face_vertex, one.face, v), carriers_of(one, two.point(c.second)),
          {{v, v, v}, {1, 0, 0}}, area, one.face, two.face);
    } else {
      add(make_key(PointKind::side_side, one.side(c.first), two.side(c.second)),
          on_side(one, c.first, c.along_first), on_side(two, c.second, c.along_second), area,
          one.face, two.face);
    }
  }

  /// Half-way from the centre to a corner.
  KOKKOS_INLINE_FUNCTION void add_between_corner(const Outline& one, const Outline& two,
                                                 const OverlapCorner& c, const Flat& place,
                                                 Real area) {
    std::int64_t key = 0;
    if (c.kind == OverlapCorner::of_first)
      key = make_key(PointKind::vertex_face, between_flag | one.corner(c.first), two.face);
    else if (c.kind == OverlapCorner::of_second)
      key = make_key(PointKind::face_vertex, between_flag | one.face, two.corner(c.second));
    else
      key =
          make_key(PointKind::side_side, between_flag | one.corner(c.first), two.corner(c.second));
    add(key, carriers_of(one, place), carriers_of(two, place), area, one.face, two.face);
  }

  KOKKOS_INLINE_FUNCTION static Carriers on_side(const Outline& o, Index i, Real t) {
    const Index p = o.vertex(i), q = o.vertex(i + 1);
    return {{p, q, p}, {1 - t, t, 0}};
  }

  KOKKOS_INLINE_FUNCTION void add_inside(const Outline& one, const Outline& two,
                                         const OverlapRule& rule) {
    const bool single = rule.apart.u == 0 && rule.apart.v == 0;
    if (!(rule.inside() > 0)) return;
    const Real area = rule.inside() * rule.area / (single ? 1 : 2);
    for (int k = 0; k < (single ? 1 : 2); ++k) {
      const Flat place = rule.centre + (k == 0 ? 1.0 : -1.0) * rule.apart;
      add(make_key(PointKind::inside, 2 * one.face + k, two.face), carriers_of(one, place),
          carriers_of(two, place), area, one.face, two.face);
    }
  }

  /// A point that several overlaps have in common is one with the sum of their areas; a joint and faces beside it have one each.
  KOKKOS_INLINE_FUNCTION void add(std::int64_t key, const Carriers& first, const Carriers& second,
                                  Real area, Index fa, Index fb) {
    const Index joint = joint_of(fa, fb);
    const Index stored = count_ < room_.capacity ? count_ : room_.capacity;
    for (Index k = 0; k < stored; ++k) {
      ContactPoint& p = room_.point(room_.begin + k);
      if (p.key != key || (joint == none) != (p.joint == none)) continue;
      p.area += area;
      return;
    }
    Real gap = 0;
    for (int k = 0; k < 3; ++k)
      gap += first.share[k] * dot(n_, at(pose_.x, first.vertex[k])) -
             second.share[k] * dot(n_, at(pose_.x, second.vertex[k]));
    if (!(gap < options_.search_distance)) return;
    deepest_ = math::fmax(deepest_, -gap);
    if (count_++ >= room_.capacity) return;
    set_point(room_.point(room_.begin + count_ - 1), key, first, second, area, fa, fb);
  }

  KOKKOS_INLINE_FUNCTION void set_point(ContactPoint& p, std::int64_t key, const Carriers& first,
                                        const Carriers& second, Real area, Index fa,
                                        Index fb) const {
    p = ContactPoint{};
    p.key = key;
    p.area = area;
    for (int k = 0; k < 3; ++k) {
      p.vertex[k] = first.vertex[k];
      p.weight[k] = first.share[k];
      p.vertex[3 + k] = second.vertex[k];
      p.weight[3 + k] = -second.share[k];
    }
    const Index joint = joint_of(fa, fb);
    const Index ma = s_.face_material(fa), mb = s_.face_material(fb);
    p.surfaces = static_cast<std::int16_t>((ma + 1) * options_.materials + mb + 1);
    p.law = joint != none && ma != none && ma == mb ? static_cast<std::int16_t>(ma)
                                                    : options_.law_of_pair(p.surfaces);
    p.joint = joint;
    begin_memory(p, joint != none, fa, fb);
  }

  /// What has been apart has no bonds.
  KOKKOS_INLINE_FUNCTION void begin_memory(ContactPoint& p, bool joined, Index fa, Index fb) const {
    p.memory.broken = p.memory.met = p.memory.loose = 1;
    if (!options_.starting || !joined) return;
    const Vector d = between(p, pose_.x);
    const Real gap = dot(n_, d);
    // The two sides of one joint, as near to each other as slivers are wide.
    if (dot(at(pose_.normal, fa), at(pose_.normal, fb)) > -near_direction ||
        math::fabs(gap) > 2 * s_.tolerance)
      return;
    p.memory = ContactMemory{};
    p.memory.state = Contact::stick;
    p.offset = -gap;
  }

  const Surfaces& s_;
  const Pose& pose_;
  const Index a_, b_;
  const Vector n_;
  const bool turning_;
  const PointOptions& options_;
  const Room& room_;
  Index count_ = 0;
  bool on_joint_ = false;  ///< the sides of a joint lie on each other …
  Real joint_area_ = 0;    ///< … on so much, m²
  Real deepest_ = 0, width_ = 0;
};

}  // namespace rockfold::contact
