// The overlap of two convex polygons seen along a normal, without storing it: its boundary is the sides of either that lie in the other
// (Cyrus & Beck, Comput. Graph. 3, 1978, 23). Where sides of both coincide those of the first count: to the first its boundary is
// inside by the tolerance, to the second it is outside by it, so that they complement each other.
//
// The quadrature of an overlap of area A has points at its corners, so that rigid blocks pivot about their true edges, and inside. With
// p, q the ends of each boundary segment from the centroid c and a the area of (c, p, q):
//
//   S = Σ a/12 (2 p pᵀ + 2 q qᵀ + p qᵀ + q pᵀ)      the second moments of the overlap
//   C = Σ a (p pᵀ + q qᵀ)                           those of weights a at p and q
//
// Corners get κ a from each of their two segments, κ the lower root of det(S − κ C) = 0; then S − κ C has rank one, and two points
// c ± d of weight (1 − 2κ) A/2 make it up: exact to degree 2. For triangles κ = 1/8 and for parallelograms 1/6, d = 0, and both
// points are one: 1/12 at each corner, the rest at the centroid. 1/12 ≤ κ ≤ 1/4: S − C/12 = Σ a/12 (p + q)(p + q)ᵀ and
// C/4 − S = Σ a/12 (p − q)(p − q)ᵀ are positive.
//
// Where faces turn (turning_kernel.hpp) points half-way from the centre to each corner get ρ a from each of its segments, taken from the corners
// (ρ/4: then S is the same) and from the inside. With D = Σ a (|p| + |q|) the torque of a uniform pressure is right if
//
//   (κ + ρ/4) D + w |d| = T = ∫ |r| dA,   T = Σ h/6 (t_q |q| − t_p |p| + h² ln((t_q + |q|)/(t_p + |p|)))
//
// for segments at distance h from c, t along each from the foot of the normal on it; w is the share of what is inside, times A. Regular
// polygons and parallelograms: ρ = 0.33 (a disc, a long strip) to 0.42 (a triangle).
#pragma once

#include "kernels/contact/detection/surfaces_kernel.hpp"

namespace rockfold::contact {

/// A plane of projection.
struct Chart {
  Vector origin, u, v, n;

  KOKKOS_INLINE_FUNCTION Flat operator()(const Vector& x) const {
    const Vector r = x - origin;
    return {dot(r, u), dot(r, v)};
  }
};
KOKKOS_INLINE_FUNCTION Chart make_chart(const Vector& origin, const Vector& n) {
  const Vector u = any_across(n);
  return {origin, u, cross(n, u), n};
}

/// A face in a chart, counter-clockwise there: one that looks against n is read backwards.
struct Outline {
  const Surfaces& s;
  const Field& x;
  const Chart& chart;
  Index face, begin, count;
  bool backwards;

  KOKKOS_INLINE_FUNCTION Outline(const Surfaces& surfaces, const Field& places, const Chart& to,
                                 Index f, bool turned)
      : s(surfaces),
        x(places),
        chart(to),
        face(f),
        begin(surfaces.corner_begin(f)),
        count(surfaces.corner_begin(f + 1) - surfaces.corner_begin(f)),
        backwards(turned) {}

  /// Into corner_vertex; i ≤ count.
  KOKKOS_INLINE_FUNCTION Index corner(Index i) const {
    const Index k = i == count ? 0 : i;
    return begin + (backwards ? count - 1 - k : k);
  }
  KOKKOS_INLINE_FUNCTION Index vertex(Index i) const { return s.corner_vertex(corner(i)); }
  KOKKOS_INLINE_FUNCTION Flat point(Index i) const { return chart(at(x, vertex(i))); }
  /// The name of the side from corner i on.
  KOKKOS_INLINE_FUNCTION Index side(Index i) const {
    return s.corner_side(corner(backwards ? (i + 1 == count ? 0 : i + 1) : i));
  }
};

/// What is left of a side: from its first end on, in shares of it; cut by which side of the other outline, or none.
struct Clipped {
  Flat p, q;  ///< ends of the side
  Real from = 0, to = 1;
  Index cut_from = none, cut_to = none;
  bool any = false;
};

/// Sine below which sides are nearly parallel: where they cross the tolerance moves them along each other by more than a thousand times itself.
inline constexpr Real nearly_along = 1e-3;

/// The part of side i of `one` that lies in `other`, whose boundary is moved out by `margin` (m). Sides of `other` that are nearly parallel to it
/// come last, and count by how far apart both are where they run beside each other: that is the same for either outline, so that both agree
/// which of the two bounds the overlap.
KOKKOS_INLINE_FUNCTION Clipped clip_side(const Outline& one, Index i, const Outline& other,
                                         Real margin) {
  Clipped c;
  c.p = one.point(i);
  c.q = one.point(i + 1);
  const Real tolerance = margin < 0 ? -margin : margin;
  const Flat way = c.q - c.p;
  const Real side = length(way);
  if (!(side > tolerance)) return c;
  bool any_along = false;
  for (const bool along : {false, true}) {
    if (along && !any_along) break;
    Flat a = other.point(0);
    for (Index j = 0; j < other.count; ++j) {
      const Flat b = other.point(j + 1), start = a, e = b - a;
      const Real l = length(e);
      a = b;
      if (!(l > tolerance)) continue;
      const bool is_along = math::fabs(cross(e, way)) <= nearly_along * l * side;
      any_along = any_along || is_along;
      if (is_along != along) continue;
      const Real low = along ? c.from : 0, high = along ? c.to : 1;
      const Real d0 = cross(e, c.p + low * way - start) / l,
                 d1 = cross(e, c.p + high * way - start) / l;
      const bool in0 = d0 >= -margin, in1 = d1 >= -margin;
      if (!in0 && !in1) return c;
      if (in0 != in1) {  // the crossing is that of the sides themselves
        const Real t = low + (high - low) * math::fmin(1.0, math::fmax(0.0, d0 / (d0 - d1)));
        if (in1 && t > c.from) {
          c.from = t;
          c.cut_from = j;
        } else if (in0 && t < c.to) {
          c.to = t;
          c.cut_to = j;
        }
      }
      if (!((c.to - c.from) * side > tolerance)) return c;
    }
  }
  c.any = true;
  return c;
}

/// A corner of an overlap: a vertex of either outline in the other, or where two sides cross.
struct OverlapCorner {
  enum Kind : std::int32_t { of_first, of_second, crossing };
  std::int32_t kind = of_first;
  Index first = 0, second = 0;             ///< corner or side of each outline, from 0
  Real along_first = 0, along_second = 0;  ///< of a crossing: shares of the sides
  Flat place;
};

/// The corner at share t of side i of `one`, which side j of `other` cuts off; `swapped`: `one` is the second outline.
/// Nearer to an end of either side than the tolerance, it is that vertex.
KOKKOS_INLINE_FUNCTION OverlapCorner corner_at(const Outline& one, Index i, const Outline& other,
                                               const Clipped& c, Real t, Index j, bool swapped,
                                               Real tolerance) {
  OverlapCorner k;
  const Flat e = c.q - c.p;
  const Real l = length(e);
  k.place = c.p + t * e;
  const auto name = [&](bool of_one, Index which) {
    k.kind = of_one != swapped ? OverlapCorner::of_first : OverlapCorner::of_second;
    (k.kind == OverlapCorner::of_first ? k.first : k.second) = which;
    return k;
  };
  if (j == none) return name(true, t == 0 ? i : i + 1 == one.count ? 0 : i + 1);
  if (t * l <= tolerance) return name(true, i);
  if ((1 - t) * l <= tolerance) return name(true, i + 1 == one.count ? 0 : i + 1);
  const Flat a = other.point(j), b = other.point(j + 1), f = b - a;
  const Real m = length(f), s = (f.u * (k.place.u - a.u) + f.v * (k.place.v - a.v)) / (m * m);
  if (s * m <= tolerance) return name(false, j);
  if ((1 - s) * m <= tolerance) return name(false, j + 1 == other.count ? 0 : j + 1);
  k.kind = OverlapCorner::crossing;
  k.first = swapped ? j : i;
  k.second = swapped ? i : j;
  k.along_first = swapped ? s : t;
  k.along_second = swapped ? t : s;
  return k;
}

/// visit(p, q, clipped, side, swapped) for all boundary segments of the overlap, counter-clockwise, in a fixed order.
template <class Visit>
KOKKOS_INLINE_FUNCTION void for_each_segment(const Outline& first, const Outline& second,
                                             Real tolerance, const Visit& visit) {
  for (Index i = 0; i < first.count; ++i) {
    const Clipped c = clip_side(first, i, second, tolerance);
    if (c.any) visit(c.p + c.from * (c.q - c.p), c.p + c.to * (c.q - c.p), c, i, false);
  }
  for (Index i = 0; i < second.count; ++i) {
    const Clipped c = clip_side(second, i, first, -tolerance);
    if (c.any) visit(c.p + c.from * (c.q - c.p), c.p + c.to * (c.q - c.p), c, i, true);
  }
}

/// The quadrature of an overlap; no overlap: area 0.
struct OverlapRule {
  Real area = 0;      ///< m²
  Real width = 0;     ///< m, of a strip; of others half of it or so
  Real gyration = 0;  ///< m, its radius
  Flat centre;        ///< c
  Real corner = 0;    ///< κ
  Real between = 0;   ///< ρ
  Flat apart;         ///< d; zero: one point at c

  /// Share of the area inside, at c or c ± d.
  KOKKOS_INLINE_FUNCTION Real inside() const { return 1 - 2 * (corner + between); }
};

/// Of its area, what rounding may leave open round an overlap.
inline constexpr Real roundness = 1e-3;

/// d is left out below a thousandth of the overlap's radius of gyration: its share of S is then below 1e-6.
inline constexpr Real least_apart = 1e-3;

KOKKOS_INLINE_FUNCTION OverlapRule overlap_rule(const Outline& first, const Outline& second,
                                                Real tolerance) {
  OverlapRule r;
  const Flat o = second.point(0);
  Real around = 0;
  Flat moment;
  for_each_segment(first, second, tolerance,
                   [&](const Flat& p, const Flat& q, const Clipped&, Index, bool) {
                     const Real a = 0.5 * cross(p - o, q - o);
                     r.area += a;
                     moment = moment + (a / 3) * ((p - o) + (q - o));
                     around += length(q - p);
                   });
  if (!(r.area > tolerance * around)) {  // narrower than a length is
    r.area = 0;
    return r;
  }
  r.centre = o + (1 / r.area) * moment;
  r.width = 2 * r.area / around;
  Real s[3] = {0, 0, 0}, c[3] = {0, 0, 0};  // uu, uv, vv
  Real all = 0;
  for_each_segment(first, second, tolerance,
                   [&](const Flat& from, const Flat& to, const Clipped&, Index, bool) {
                     const Flat p = from - r.centre, q = to - r.centre;
                     const Real a = 0.5 * cross(p, q);
                     all += math::fabs(a);
                     const Real pp[3] = {p.u * p.u, p.u * p.v, p.v * p.v};
                     const Real qq[3] = {q.u * q.u, q.u * q.v, q.v * q.v};
                     const Real pq[3] = {2 * p.u * q.u, p.u * q.v + q.u * p.v, 2 * p.v * q.v};
                     for (int k = 0; k < 3; ++k) {
                       s[k] += a / 12 * (2 * pp[k] + 2 * qq[k] + pq[k]);
                       c[k] += a * (pp[k] + qq[k]);
                     }
                   });
  // So narrow that it does not hold its own centroid: sides that cross at next to no angle do so nowhere in particular.
  if (all > (1 + roundness) * r.area) {
    r.area = 0;
    return r;
  }
  r.gyration = math::sqrt((s[0] + s[2]) / r.area);
  const Real det_s = s[0] * s[2] - s[1] * s[1], det_c = c[0] * c[2] - c[1] * c[1];
  const Real half = 0.5 * (s[0] * c[2] + s[2] * c[0] - 2 * s[1] * c[1]);
  const Real root = math::sqrt(math::fmax(0.0, half * half - det_s * det_c));
  r.corner = math::fmin(0.25, math::fmax(1.0 / 12, det_s / (half + root)));
  const Real inside = (1 - 2 * r.corner) * r.area;
  const Real uu = s[0] - r.corner * c[0], uv = s[1] - r.corner * c[1], vv = s[2] - r.corner * c[2];
  const Real most = math::fmax(uu, vv);
  if (most > least_apart * least_apart * (s[0] + s[2]) * inside / r.area) {
    const Real d = math::sqrt(most / inside);
    r.apart = uu >= vv ? Flat{d, uv / (inside * d)} : Flat{uv / (inside * d), d};
  }
  return r;
}

/// ∫ |r| dA over the triangle of the origin, p and q.
KOKKOS_INLINE_FUNCTION Real arm_of(const Flat& p, const Flat& q) {
  const Flat way = q - p;
  const Real side = length(way), h = cross(p, q) / side;
  const Real tp = (p.u * way.u + p.v * way.v) / side, tq = tp + side;
  const Real rp = length(p), rq = length(q);
  // The logarithm is that of both ends' slopes; h² times it vanishes with h.
  const Real bend = h == 0 ? 0 : h * h * (math::asinh(tq / h) - math::asinh(tp / h));
  return h / 6 * (tq * rq - tp * rp + bend);
}

/// Adds the points half-way to the corners.
KOKKOS_INLINE_FUNCTION void add_between(const Outline& first, const Outline& second, Real tolerance,
                                        OverlapRule& r) {
  Real arm = 0, corners = 0;
  for_each_segment(first, second, tolerance,
                   [&](const Flat& from, const Flat& to, const Clipped&, Index, bool) {
                     const Flat p = from - r.centre, q = to - r.centre;
                     arm += arm_of(p, q);
                     corners += 0.5 * cross(p, q) * (length(p) + length(q));
                   });
  // What is inside keeps its second moment: the less it is the farther apart, though within the radius of gyration.
  const Real before = r.inside(), apart = length(r.apart), share = apart / r.gyration;
  const Real most = math::fmin(4 * r.corner, before * math::fmax(0.0, 1 - share * share) / 1.5);
  const auto ratio = [&](Real inside_arm) {
    const Real missing = arm - r.corner * corners - inside_arm;
    return math::fmin(most, math::fmax(0.0, 4 * missing / corners));
  };
  const auto inside_after = [&](Real between) { return before - 1.5 * between; };
  const Real guess = ratio(before * r.area * apart);
  r.between = ratio(math::sqrt(before * inside_after(guess)) * r.area * apart);
  r.corner -= r.between / 4;
  if (apart > 0) r.apart = math::sqrt(before / r.inside()) * r.apart;
}

/// Which of an outline's vertices carry a point of it, and their shares.
struct Carriers {
  Index vertex[3];
  Real share[3];
};

/// Of all triangles from the outline's first corner, or from its face's centre, the one that holds the place best. Of a place beside the outline, by the tolerance, the
/// shares are those of a place in it: on a steep face heights rise fast.
KOKKOS_INLINE_FUNCTION Carriers carriers_of(const Outline& o, const Flat& place) {
  Carriers best{{o.vertex(0), o.vertex(1), o.vertex(2)}, {1, 0, 0}};
  Real most = 0;
  bool found = false;
  const Index centre = o.s.face_centre(o.face), apex = centre == none ? o.vertex(0) : centre;
  const Index first = centre == none ? 1 : 0, last = centre == none ? o.count - 2 : o.count - 1;
  const Flat a = o.chart(at(o.x, apex));
  Flat b = o.point(first);
  for (Index i = first; i <= last; ++i) {
    const Flat c = o.point(i + 1);
    const Real all = cross(b - a, c - a);
    const Real sb = cross(place - a, c - a) / all, sc = cross(b - a, place - a) / all;
    const Real least = math::fmin(1 - sb - sc, math::fmin(sb, sc));
    if (all > 0 && (!found || least > most)) {
      found = true;
      most = least;
      best = {{apex, o.vertex(i), o.vertex(i + 1)}, {1 - sb - sc, sb, sc}};
    }
    b = c;
  }
  Real sum = 0;
  for (Real& share : best.share) sum += share = math::fmax(0.0, share);
  for (Real& share : best.share) share /= sum;
  return best;
}

}  // namespace rockfold::contact
