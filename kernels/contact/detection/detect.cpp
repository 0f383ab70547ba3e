#include <cmath>
#include <utility>

#include "kernels/contact/contact_kernel.hpp"
#include "kernels/contact/detection/cone_kernel.hpp"
#include "kernels/contact/detection/handover_kernel.hpp"
#include "kernels/contact/detection/pair_points_kernel.hpp"
#include "kernels/contact/detection/turning_kernel.hpp"
#include "kernels/device/sums_kernel.hpp"

namespace rockfold::contact {

namespace {

using device::grow;

/// All that a kernel over pairs reads.
struct Scene {
  Surfaces s;
  Pose before, now;
  Field speed_before;
  Pairs pairs;
  PointSet accepted;
  PointOptions points;
  Array<JointLaw> laws;
  bool started;
};

/// Parts that were on the middle of a cone stay there until one has slid onto a face of the other.
KOKKOS_INLINE_FUNCTION bool follow_middle(const Scene& e, Index a, Index b, Plane& plane) {
  const Real gap = gap_along(e.s, e.now, a, b, plane, direction(e.s, e.now, plane));
  if (gap > 0) return gap < e.points.search_distance;
  const bool met = gap_along(e.s, e.before, a, b, plane, direction(e.s, e.before, plane)) > 0;
  const Query q{a, b, met ? Search::swept : Search::widest, {}, e.points.search_distance};
  const Choice best = PlaneSearch(e.s, e.before, e.now, q).run();
  if (!leaves_middle(e.s, e.before, e.now, q, plane, best)) return true;
  plane = best.plane;
  return best.gap < e.points.search_distance && !is_far(e.s, a, b, plane);
}

/// The plane of a pair in the new pose, and whether it is near enough to have points.
KOKKOS_INLINE_FUNCTION bool find_plane(const Scene& e, Index pair, Plane& plane) {
  const Index a = e.pairs.a(pair), b = e.pairs.b(pair);
  const Index old = e.started ? find_pair(e.accepted.pairs, a, b) : none;
  plane = old == none ? Plane{} : e.accepted.plane(old);
  if (plane.kind == Plane::middle) return follow_middle(e, a, b, plane);
  Query q{a, b, e.started ? Search::swept : Search::widest, {}, e.points.search_distance};
  if (plane.kind != Plane::unknown) {
    const Vector n = direction(e.s, e.now, plane), m = direction(e.s, e.before, plane);
    if (dot(n, m) >
        near_direction) {  // that of two edges may turn by any angle where they are nearly parallel
      const Real gap = gap_along(e.s, e.now, a, b, plane, n);
      // It still separates them.
      if (gap > 0) return gap < e.points.search_distance && !is_far(e.s, a, b, plane);
      q.near = n;
      // What had come beyond a plane where nothing touches is looked at from all sides.
      if (!is_far(e.s, a, b, plane) && !(gap_along(e.s, e.before, a, b, plane, m) > 0))
        q.how = Search::local;
    }
  }
  Choice best = PlaneSearch(e.s, e.before, e.now, q).run();
  if (best.plane.kind == Plane::unknown) {
    q.how = Search::widest;
    best = PlaneSearch(e.s, e.before, e.now, q).run();
  }
  plane = best.plane;
  if (!(best.gap < e.points.search_distance) || is_far(e.s, a, b, plane)) return false;
  if (q.how != Search::local) plane = ConeSearch(e.s, e.before, e.now, q, best).run();
  return true;
}

/// √(m/K) of the two blocks and all points between them that carry load or may.
KOKKOS_INLINE_FUNCTION Real period_of(const Scene& e, Index a, Index b, const Span& points) {
  Real stiffness = 0;
  for (Index i = 0; i < points.count; ++i)
    stiffness += e.laws(points[i].law).normal_stiffness * points[i].area;
  const Real ma = e.s.block_mass(e.s.part_block(a)), mb = e.s.block_mass(e.s.part_block(b));
  return stiffness > 0 ? math::sqrt(ma * mb / (ma + mb) / stiffness) : 0;
}

/// Frames now and at the start of the step, and what was between the two sides then.
KOKKOS_INLINE_FUNCTION void set_frames(const Scene& e, const Vector& n, const Vector& n_before,
                                       const Span& points) {
  for (Index i = 0; i < points.count; ++i) {
    ContactPoint& p = points[i];
    store(n, p.normal);
    store(material_direction(e.s, e.now, p.key, n), p.along);
    const Vector a = material_direction(e.s, e.before, p.key, n_before);
    const Vector d = between(p, e.before.x);
    p.gap_before = dot(n_before, d) + p.offset;
    p.shear_before[0] = dot(a, d);
    p.shear_before[1] = dot(cross(n_before, a), d);
    p.speed_before = dot(n_before, between(p, e.speed_before));
  }
}

/// How many points a pair has on its plane, and whether their overlaps are all narrower than deep.
struct Staged {
  Index count = 0;
  bool strips = false;
};

KOKKOS_INLINE_FUNCTION Staged place_points(const Scene& e, Index pair, const Plane& plane,
                                           const Room& room) {
  PairPoints points(e.s, e.now, e.pairs.a(pair), e.pairs.b(pair), plane, e.points, room);
  const Index count = points.run();
  return {count, points.deeper_than_wide()};
}

/// The points that a pair had at the last accepted step.
KOKKOS_INLINE_FUNCTION Span accepted_points(const Scene& e, Index a, Index b) {
  const Index pair = e.started ? find_pair(e.accepted.pairs, a, b) : none;
  if (pair == none) return {e.accepted.point, 0, 0};
  const Index begin = e.accepted.point_begin(pair);
  return {e.accepted.point, static_cast<std::size_t>(begin),
          e.accepted.point_begin(pair + 1) - begin};
}

/// What the points of a pair inherit.
KOKKOS_INLINE_FUNCTION void inherit(const Scene& e, Index pair, const Plane& plane,
                                    const Room& room, Index count) {
  const Index a = e.pairs.a(pair), b = e.pairs.b(pair);
  const Vector n = direction(e.s, e.now, plane);
  const Span now{room.point, room.begin, count < room.capacity ? count : room.capacity};
  Vector n_before = direction(e.s, e.before, plane);
  if (dot(n_before, n_before) == 0) n_before = n;
  const Span old = accepted_points(e, a, b);
  if (old.count > 0) keep_memories(old, now, e.laws);
  set_frames(e, n, n_before, now);
  if (old.count > 0)
    hand_over_shear(
        old, now, e.laws,
        [](const ContactPoint& p, Vector& normal, Vector& along) {
          normal = to_vector(p.normal);
          along = to_vector(p.along);
        },
        [&](const ContactPoint& p, Vector& normal, Vector& along) {
          normal = n_before;
          along = material_direction(e.s, e.before, p.key, n_before);
        });
  const Real period = period_of(e, a, b, now);
  for (Index i = 0; i < now.count; ++i) now[i].period = period;
}

/// Planes of all candidates, and the pairs near enough to have points. Returns how many.
Index find_planes(DeviceContacts& c, const Scene& e, const Array<Plane>& plane) {
  const Index pairs = e.pairs.count;
  grow(c.near, "contact::near", pairs + 1);
  grow(c.near_pair, "contact::near_pair", pairs);
  const auto near = c.near;
  const auto near_pair = c.near_pair;
  device::for_each(
      "rockfold::contact::planes", pairs,
      KOKKOS_LAMBDA(const Index i) {
        Plane p;
        near(i) = find_plane(e, i, p) ? 1 : 0;
        plane(i) = p;
      },
      64);
  const Index count = to_offsets(near, pairs);
  device::for_each(
      "rockfold::contact::near_pairs", pairs, KOKKOS_LAMBDA(const Index i) {
        if (near(i + 1) > near(i)) near_pair(near(i)) = i;
      });
  return count;
}

/// Plane::turning of a pair from here on.
KOKKOS_INLINE_FUNCTION std::int32_t turns(const Scene& e, Index a, Index b) {
  const Span points = accepted_points(e, a, b);
  if (points.count == 0) return 0;
  const bool did = e.accepted.plane(find_pair(e.accepted.pairs, a, b)).turning != 0;
  return turns_in_plane(points, e.before.x, e.speed_before, did) ? 1 : 0;
}

/// m, of the thinner part.
KOKKOS_INLINE_FUNCTION Real half_width(const Scene& e, Index a, Index b) {
  return 0.5 * math::fmin(e.s.part_width(a), e.s.part_width(b));
}

/// Whether an impact has taken the pair deeper than half the width of the thinner one: it is on its way back, and the nearest way out may be through.
KOKKOS_INLINE_FUNCTION bool is_hit(const Scene& e, Index a, Index b) {
  const Real half = half_width(e, a, b);
  const Span points = accepted_points(e, a, b);
  for (Index i = 0; i < points.count; ++i) {
    const ContactPoint& p = points[i];
    const Real gap = dot(to_vector(p.normal), between(p, e.before.x)) + p.offset,
               depth = p.memory.dilation - gap;
    if (p.memory.state != Contact::open && depth > half && 2 * p.memory.approach * p.period > depth)
      return true;
  }
  return false;
}

/// Points of a pair on its plane. Where it touches nowhere in that plane, or has touched for longer in strips alone that are narrower than
/// deep, it is looked at again from all sides: the plane along which the overlap is least deep then has the least energy, since the volume is
/// the same. (Rock that touches at an edge alone, where joints cross, is as near to one joint as to the other until it moves.) What
/// has met in this step keeps the plane that it crossed: it may have come out on the other side.
KOKKOS_INLINE_FUNCTION Index stage_pair(const Scene& e, Index pair, Plane& plane,
                                        const Room& room) {
  const Index a = e.pairs.a(pair), b = e.pairs.b(pair);
  const auto gap_in = [&](const Pose& pose) {
    return gap_along(e.s, pose, a, b, plane, direction(e.s, pose, plane));
  };
  plane.turning = turns(e, a, b);
  Staged staged = place_points(e, pair, plane, room);
  if (staged.count == 0 || (staged.strips && plane.kind != Plane::middle &&
                            !(gap_in(e.before) > e.s.tolerance) && !is_hit(e, a, b))) {
    const Query q{a, b, Search::widest, {}, e.points.search_distance};
    const Choice best = PlaneSearch(e.s, e.before, e.now, q).run();
    if (best.plane.kind != Plane::unknown && (staged.count == 0 || best.gap > gap_in(e.now))) {
      plane = best.plane;
      plane.turning = 0;
      const bool near = best.gap < e.points.search_distance && !is_far(e.s, a, b, plane);
      staged = near ? place_points(e, pair, plane, room) : Staged{};
    }
  }
  if (staged.count > 0) inherit(e, pair, plane, room, staged.count);
  return staged.count;
}

/// The points of the near pairs, each pair in a place of its own.
void stage_points(DeviceContacts& c, const Scene& e, const Array<Plane>& plane, Index near) {
  grow(c.staged_count, "contact::staged_count", near + 1);
  for (;;) {
    grow(c.staged, "contact::staged", static_cast<std::size_t>(near) * c.capacity);
    const auto near_pair = c.near_pair, staged_count = c.staged_count;
    const auto staged = c.staged;
    const Index capacity = c.capacity;
    device::for_each(
        "rockfold::contact::points", near,
        KOKKOS_LAMBDA(const Index k) {
          const Index i = near_pair(k);
          const Room room{staged, static_cast<std::size_t>(k) * capacity, capacity};
          Plane p = plane(i);
          staged_count(k) = stage_pair(e, i, p, room);
          plane(i) = p;
        },
        64);
    const Index most = static_cast<Index>(device::largest(
        "rockfold::contact::most_points", near,
        KOKKOS_LAMBDA(const Index k) { return static_cast<Real>(staged_count(k)); }));
    if (most <= c.capacity) return;
    while (c.capacity < most) c.capacity *= 2;
  }
}

/// Whether `current` has no point by this name yet.
KOKKOS_INLINE_FUNCTION bool is_new(const PointSet& current, Index a, Index b, std::int64_t key) {
  const Index pair = find_pair(current.pairs, a, b);
  if (pair == none) return true;
  for (Index i = current.point_begin(pair); i < current.point_begin(pair + 1); ++i)
    if (current.point(i).key == key) return false;
  return true;
}

/// The largest of_point(a, b, point, gap) of all staged points that are closed.
template <class OfPoint>
Real largest_of_closed(const DeviceContacts& c, const Scene& e, Index near,
                       const OfPoint& of_point) {
  const auto near_pair = c.near_pair, staged_count = c.staged_count;
  const auto staged = c.staged;
  const Index capacity = c.capacity;
  return device::largest(
      "rockfold::contact::largest_of_closed", near, KOKKOS_LAMBDA(const Index k) {
        const Index i = near_pair(k);
        Real most = 0;
        for (Index n = 0; n < staged_count(k); ++n) {
          const ContactPoint& p = staged(static_cast<std::size_t>(k) * capacity + n);
          const Real gap = dot(to_vector(p.normal), between(p, e.now.x)) + p.offset;
          if (gap < 0) most = math::fmax(most, of_point(e.pairs.a(i), e.pairs.b(i), p, gap));
        }
        return most;
      });
}

Index count_missed(const DeviceContacts& c, const Scene& e, Index near, const PointSet& last) {
  const auto near_pair = c.near_pair, staged_count = c.staged_count;
  const auto staged = c.staged;
  const Index capacity = c.capacity;
  Index missed = 0;
  Kokkos::parallel_reduce(
      "rockfold::contact::missed", device::Range(0, near),
      KOKKOS_LAMBDA(const Index k, Index& sum) {
        const Index i = near_pair(k);
        for (Index n = 0; n < staged_count(k); ++n) {
          const ContactPoint& p = staged(static_cast<std::size_t>(k) * capacity + n);
          const Real gap = dot(to_vector(p.normal), between(p, e.now.x)) + p.offset;
          if (gap < 0 && is_new(last, e.pairs.a(i), e.pairs.b(i), p.key)) ++sum;
        }
      },
      missed);
  return missed;
}

/// With the points of the detection before.
void compare(const DeviceContacts& c, const Scene& e, Index near, DetectReport& report) {
  const PointSet last = c.detected ? c.current : c.accepted;
  report.deepest = largest_of_closed(
      c, e, near, KOKKOS_LAMBDA(Index, Index, const ContactPoint&, Real gap) { return -gap; });
  report.missed = count_missed(c, e, near, last);
}

/// From where they were staged to `current`, without holes.
void store_points(DeviceContacts& c, const Scene& scene, const Array<Plane>& plane, Index near) {
  const Index pairs = scene.pairs.count;
  PointSet& to = c.current;
  to.pairs = scene.pairs;
  to.plane = plane;
  grow(to.point_begin, "contact::point_begin", pairs + 1);
  const auto begin = to.point_begin, near_pair = c.near_pair, staged_count = c.staged_count;
  device::for_each(
      "rockfold::contact::no_points", pairs, KOKKOS_LAMBDA(const Index i) { begin(i) = 0; });
  device::for_each(
      "rockfold::contact::point_counts", near,
      KOKKOS_LAMBDA(const Index k) { begin(near_pair(k)) = staged_count(k); });
  to.count = to_offsets(begin, pairs);
  grow(to.point, "contact::point", to.count);
  const auto point = to.point, staged = c.staged;
  const Index capacity = c.capacity;
  device::for_each(
      "rockfold::contact::store_points", near,
      KOKKOS_LAMBDA(const Index k) {
        const Index first = begin(near_pair(k));
        for (Index n = 0; n < staged_count(k); ++n)
          point(first + n) = staged(static_cast<std::size_t>(k) * capacity + n);
      },
      16);
}

/// The points of the last accepted step are those of this one: its motion counts from there.
void serve(DeviceContacts& c) {
  copy(c.accepted, c.current);
  const auto point = c.current.point;
  const Field x = c.before.x, v = c.speed_before;
  device::for_each(
      "rockfold::contact::serve", c.current.count, KOKKOS_LAMBDA(const Index i) {
        ContactPoint& p = point(i);
        const Vector n = to_vector(p.normal), a = to_vector(p.along), d = between(p, x);
        p.gap_before = dot(n, d) + p.offset;
        p.shear_before[0] = dot(a, d);
        p.shear_before[1] = dot(cross(n, a), d);
        p.speed_before = dot(n, between(p, v));
      });
}

}  // namespace

Real largest_turn(const DeviceContacts& c) {
  const Field from = c.before.normal, to = c.now.normal;
  return device::largest(
      "rockfold::contact::turn", c.surfaces.shown_faces, KOKKOS_LAMBDA(const Index f) {
        const Vector n = at(from, f), m = at(to, f);
        return math::atan2(length(cross(n, m)), dot(n, m));
      });
}

Real largest_crossing(const DeviceContacts& c) {
  const Scene e{c.surfaces, c.before, c.now,  c.speed_before, c.candidates,
                c.accepted, {},       c.laws, c.started};
  if (!c.started || 4 * largest_shift(c.before.x, c.now.x) < c.surfaces.thinnest) return 0;
  return device::largest(
      "rockfold::contact::crossing", e.pairs.count, KOKKOS_LAMBDA(const Index i) {
        const Index a = e.pairs.a(i), b = e.pairs.b(i);
        const Index old = find_pair(e.accepted.pairs, a, b);
        Plane plane = old == none ? Plane{} : e.accepted.plane(old);
        if (plane.kind == Plane::unknown)
          plane = PlaneSearch(e.s, e.before, e.before, {a, b, Search::widest, {}, 0}).run().plane;
        if (plane.kind == Plane::unknown || is_far(e.s, a, b, plane)) return 0.0;
        const Vector n = direction(e.s, e.before, plane);
        const Real start = gap_along(e.s, e.before, a, b, n),
                   depth = math::fmin(0.0, start) - gap_along(e.s, e.now, a, b, n);
        const Real half = half_width(e, a, b);
        if (!(depth > half)) return 0.0;
        // A plane that parts them at both ends has done so all the way.
        const Choice other = PlaneSearch(e.s, e.before, e.now, {a, b, Search::swept, {}, 0}).run();
        return other.plane.kind != Plane::unknown && other.gap > 0 ? 0.0 : depth / half;
      });
}

namespace {

/// m: faces that dilation holds apart are no farther from each other than others that touch.
Real largest_dilation(const PointSet& points) {
  const auto point = points.point;
  return device::largest(
      "rockfold::contact::largest_dilation", points.count,
      KOKKOS_LAMBDA(const Index i) { return point(i).memory.dilation; });
}

}  // namespace

DetectReport detect(DeviceContacts& c, const Field& x) {
  DetectReport report;
  const bool starting = !c.started;
  set_pose(c.surfaces, x, c.now);
  if (!starting &&
      largest_shift(x, c.detected ? c.current.found_at : c.accepted.found_at) <= c.options.still) {
    if (!c.detected) serve(c);
    c.detected = true;
    report.served = true;
    report.pairs = c.current.pairs.count;
    report.points = c.current.count;
    return report;
  }
  if (starting) {
    set_pose(c.surfaces, x, c.before);
    Kokkos::deep_copy(c.speed_before, 0.0);
  }
  const Real distance = c.options.search_distance + (starting ? 0 : largest_dilation(c.accepted));
  report.rebuilt = starting || !(largest_shift(x, c.sorted_at) <= 0.5 * c.options.skin);
  if (report.rebuilt) {
    const Real margin = 0.5 * (distance + c.options.skin);
    c.candidates = find_pairs(c.surfaces, c.before.x, c.now.x, margin, c.broad);
    Kokkos::deep_copy(c.sorted_at, x);
  }
  const PointOptions points{distance, c.law_of_pair,
                            static_cast<Index>(std::lround(std::sqrt(c.law_of_pair.extent(0)))),
                            starting};
  const Scene scene{c.surfaces, c.before, c.now,  c.speed_before, c.candidates,
                    c.accepted, points,   c.laws, c.started};
  grow(c.spare_plane, "contact::plane", c.candidates.count);
  const Index near = find_planes(c, scene, c.spare_plane);
  stage_points(c, scene, c.spare_plane, near);
  if (!starting) compare(c, scene, near, report);
  const Array<Plane> plane = c.spare_plane;
  c.spare_plane = c.current.plane;
  store_points(c, scene, plane, near);
  Kokkos::deep_copy(c.current.found_at, x);
  c.current.detection = ++c.detections;
  c.detected = true;
  report.pairs = scene.pairs.count;
  report.points = c.current.count;
  if (!starting) return report;
  // Step 0 is accepted as it is found; what the caller gets are the same points again.
  std::swap(c.accepted, c.current);
  stress_joints(c, x);
  c.started = true;
  c.detected = false;
  report = detect(c, x);
  report.rebuilt = true;
  return report;
}

}  // namespace rockfold::contact
