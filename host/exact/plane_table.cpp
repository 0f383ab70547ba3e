#include "host/exact/plane_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <CGAL/Fraction_traits.h>
#include <CGAL/number_utils.h>

#include "host/exact/plane_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
constexpr Real relative_tolerance = 1e-10;  // DESIGN.md, rules 2 and 5
constexpr Real guard_sine = 1e-3;           // rule 5
constexpr Real turned_factor = 10;          // planes of faces: docs/decisions/0006-polygons.md
constexpr Real near_factor = 100;           // rule 5: what is reported as near
constexpr Real far_factor = 1000;           // no vertex is moved by more than 1e-7·L
// Below this determinant of the unit normals a vertex is computed exactly: above it the bound of `vertex` keeps
// the error under 50·48·ε·L ≈ 5e-13·L, two orders below the tolerance of rule 5.
constexpr Real ill_conditioned = 0.02;

struct UnitPlane {
  Vec3 normal;
  Real offset;
};

UnitPlane rounded(const ExactVec3& n, const Exact& centred_d) {
  // Scaled by the largest component first, so that normals of any length neither overflow nor vanish.
  const Exact largest = std::max({Exact(abs(n[0])), Exact(abs(n[1])), Exact(abs(n[2]))});
  Vec3 m;
  for (int d = 0; d < 3; ++d) m[d] = CGAL::to_double(Exact(n[d] / largest));
  const Real length = norm(m);
  return {(1.0 / length) * m, CGAL::to_double(Exact(centred_d / largest)) / length};
}

// A number that is the same for both orientations of a plane and differs by at most thrice the tolerance between planes
// that coincide: the size of a generic linear function of normal and offset (that of the offset alone would be one number
// for all faces of a sphere).
Real search_key(const UnitPlane& plane, Real size) {
  constexpr Vec3 generic{0.3782, 0.5847, 0.7177};
  return std::abs(plane.offset + size * dot(generic, plane.normal));
}

// Integers in proportion to a plane's coefficients: unlike fractions they need no greatest common divisors, which are
// nine tenths of the time.
using Fraction = CGAL::Fraction_traits<Exact>;
using Integer = Fraction::Numerator_type;
using IntegerVec3 = std::array<Integer, 3>;

struct IntegerPlane {
  IntegerVec3 n;
  Integer d;
};

IntegerPlane integers(const ExactVec3& n, const Exact& d) {
  std::array<Integer, 4> numerator, denominator;
  for (int i = 0; i < 4; ++i) Fraction::Decompose()(i < 3 ? n[i] : d, numerator[i], denominator[i]);
  Integer common = denominator[0];
  for (int i = 1; i < 4; ++i)
    common = Integer(common * CGAL::integral_division(denominator[i],
                                                      Integer(CGAL::gcd(common, denominator[i]))));
  for (int i = 0; i < 4; ++i)
    numerator[i] = Integer(numerator[i] * CGAL::integral_division(common, denominator[i]));
  const Integer shared = Integer(CGAL::gcd(Integer(CGAL::gcd(numerator[0], numerator[1])),
                                           Integer(CGAL::gcd(numerator[2], numerator[3]))));
  for (Integer& i : numerator) i = Integer(CGAL::integral_division(i, shared));
  return {{numerator[0], numerator[1], numerator[2]}, numerator[3]};
}

Integer dot(const IntegerVec3& a, const IntegerVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

IntegerVec3 cross(const IntegerVec3& a, const IntegerVec3& b) {
  return {Integer(a[1] * b[2] - a[2] * b[1]), Integer(a[2] * b[0] - a[0] * b[2]),
          Integer(a[0] * b[1] - a[1] * b[0])};
}

// The meeting point of three planes is x/w.
struct IntegerPoint {
  IntegerVec3 x;
  Integer w;
};

IntegerPoint meet(const IntegerPlane& a, const IntegerPlane& b, const IntegerPlane& c) {
  const IntegerVec3 bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
  IntegerPoint p;
  for (int i = 0; i < 3; ++i) p.x[i] = a.d * bc[i] + b.d * ca[i] + c.d * ab[i];
  p.w = dot(a.n, bc);
  return p;
}

Integer power_of_two(int exponent) {
  Integer numerator, denominator;
  Fraction::Decompose()(Exact(std::ldexp(1.0, std::clamp(exponent, 0, 1000))), numerator,
                        denominator);
  return numerator;
}

Exact quotient(const Integer& a, const Integer& b) {
  return Fraction::Compose()(a, b);
}

}  // namespace

struct PlaneTable::Store {
  explicit Store(Real size)
      : fine(power_of_two(224 - std::ilogb(size))), coarse(power_of_two(128 - std::ilogb(size))) {}

  /// Fixed point: numbers of these units a metre, for 2^-224 and 2^-128 of the model's size. Rounded once to them,
  /// quotients need no fractions either.
  Integer fine, coarse;
  std::vector<IntegerPlane> plane;    // d relative to the centre
  std::multimap<Real, Index> by_key;  // for find()
};

void IntentCount::add(const IntentCount& other) {
  vertices_identified += other.vertices_identified;
  near_decisions += other.near_decisions;
  close_calls += other.close_calls;
  near_planes.insert(near_planes.end(), other.near_planes.begin(), other.near_planes.end());
}

PlaneTable::PlaneTable(const Vec3& centre, Real size)
    : centre_(centre),
      size_(size),
      tolerance_(relative_tolerance * size),
      store_(std::make_unique<Store>(size)) {}
PlaneTable::~PlaneTable() = default;
PlaneTable::PlaneTable(PlaneTable&&) noexcept = default;
PlaneTable& PlaneTable::operator=(PlaneTable&&) noexcept = default;
PlaneTable::PlaneTable(const PlaneTable& other)
    : centre_(other.centre_),
      size_(other.size_),
      tolerance_(other.tolerance_),
      normal_(other.normal_),
      offset_(other.offset_),
      known_(other.known_),
      store_(std::make_unique<Store>(*other.store_)) {}

Index PlaneTable::add(const ExactPlane& plane, Known known) {
  const Exact d = plane.d - dot(plane.n, exact(centre_));
  const UnitPlane unit = rounded(plane.n, d);
  const Index id = size();
  normal_.push_back(unit.normal);
  offset_.push_back(unit.offset);
  known_.push_back(known);
  store_->plane.push_back(integers(plane.n, d));
  store_->by_key.emplace(search_key(unit, size_), id);
  return id;
}

// The planes that differ from the given one by less than so many times the tolerances: visit(id, same sense).
template <class Visit>
void PlaneTable::visit_near(const Vec3& normal, Real offset, Real times, Visit visit) const {
  const Real key = search_key({normal, offset}, size_);
  const auto& map = store_->by_key;
  for (auto it = map.lower_bound(key - 3 * times * tolerance_);
       it != map.end() && it->first <= key + 3 * times * tolerance_; ++it) {
    const Vec3& n = normal_[it->second];
    const Real sense = dot(n, normal) < 0 ? -1 : 1;
    const bool same_angle = norm(cross(n, normal)) <= times * relative_tolerance;
    const bool same_place = std::abs(offset - sense * offset_[it->second]) <= times * tolerance_;
    if (same_angle && same_place) visit(it->second, sense > 0);
  }
}

HalfSpaceId PlaneTable::find(const ExactPlane& plane) const {
  const UnitPlane unit = rounded(plane.n, plane.d - dot(plane.n, exact(centre_)));
  HalfSpaceId best = none;
  visit_near(unit.normal, unit.offset, 1, [&](Index id, bool same_sense) {
    if (best == none || id < plane_of(best)) best = half_space(id, same_sense);
  });
  return best;
}

bool PlaneTable::is_near_another(Index plane) const {
  bool found = false;
  visit_near(normal_[plane], offset_[plane], near_factor,
             [&](Index id, bool) { found = found || id != plane; });
  return found;
}

HalfSpaceId PlaneTable::find_or_add(const ExactPlane& plane, const std::vector<Vec3>& corners,
                                    Known known) {
  const UnitPlane unit = rounded(plane.n, plane.d - dot(plane.n, exact(centre_)));
  HalfSpaceId best = known == Known::exactly ? find_exactly(plane) : none;
  if (best != none) return best;
  best = find(plane);
  if (best == none && !corners.empty())
    visit_near(unit.normal, unit.offset, turned_factor, [&](Index id, bool same_sense) {
      const bool holds = std::all_of(corners.begin(), corners.end(), [&](const Vec3& x) {
        return std::abs(dot(normal_[id], x) - offset_[id]) <= tolerance_;
      });
      if (holds && (best == none || id < plane_of(best))) best = half_space(id, same_sense);
    });
  if (best == none) return half_space(add(plane, known), true);
  loosen(plane_of(best));
  return best;
}

HalfSpaceId PlaneTable::find_or_add(const ExactPlane& plane, Known known) {
  if (known == Known::exactly) {
    const HalfSpaceId found = find_exactly(plane);
    return found != none ? found : half_space(add(plane, known), true);
  }
  const HalfSpaceId found = find(plane);
  if (found == none) return half_space(add(plane, known), true);
  loosen(plane_of(found));
  return found;
}

// Of the planes that coincide with it the one that is exactly equal, or else one that is known nearly.
HalfSpaceId PlaneTable::find_exactly(const ExactPlane& plane) const {
  const Exact d = plane.d - dot(plane.n, exact(centre_));
  const UnitPlane unit = rounded(plane.n, d);
  const IntegerPlane q = integers(plane.n, d);
  HalfSpaceId equal = none, nearly = none;
  visit_near(unit.normal, unit.offset, 1, [&](Index id, bool same_sense) {
    const IntegerPlane& p = store_->plane[id];
    const int sense = same_sense ? 1 : -1;
    HalfSpaceId& best = p.d == sense * q.d && p.n[0] == sense * q.n[0] &&
                                p.n[1] == sense * q.n[1] && p.n[2] == sense * q.n[2]
                            ? equal
                            : nearly;
    if (&best == &nearly && exactly_known(id)) return;
    if (best == none || id < plane_of(best)) best = half_space(id, same_sense);
  });
  return equal != none ? equal : nearly;
}

int PlaneTable::exact_side(const Vec3& x, Index plane) const {
  const IntegerPlane& p = store_->plane[plane];
  Exact value = -Exact(p.d);
  for (int i = 0; i < 3; ++i) value += Exact(p.n[i]) * (Exact(x[i]) - Exact(centre_[i]));
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

Vec3 PlaneTable::exact_position(const std::array<Index, 3>& p) const {
  const IntegerPoint point = meet(store_->plane[p[0]], store_->plane[p[1]], store_->plane[p[2]]);
  if (point.w == 0) throw std::logic_error("three planes without a common point");
  Vec3 x;
  for (int d = 0; d < 3; ++d)
    x[d] = CGAL::to_double(Integer(point.x[d] * store_->coarse / point.w)) /
           CGAL::to_double(store_->coarse);
  return x;
}

Vertex PlaneTable::vertex(Index p, Index q, Index r) const {
  Vertex v;
  v.plane = {p, q, r};
  std::sort(v.plane.begin(), v.plane.end());
  const Vec3 &a = normal_[v.plane[0]], &b = normal_[v.plane[1]], &c = normal_[v.plane[2]];
  const Vec3 bc = cross(b, c);
  const Real det = dot(a, bc);
  if (std::abs(det) < ill_conditioned) {
    v.x = exact_position(v.plane);
    v.error =
        static_cast<float>(2 * epsilon * (std::abs(v.x[0]) + std::abs(v.x[1]) + std::abs(v.x[2])));
    return v;
  }
  const Real da = offset_[v.plane[0]], db = offset_[v.plane[1]], dc = offset_[v.plane[2]];
  const Vec3 ca = cross(c, a), ab = cross(a, b);
  v.x = (1 / det) * (da * bc + db * ca + dc * ab);
  // Coefficients carry 1.5 ε each (a plane's own scale cancels), cross products 6 ε, their sums 10 ε: of the numerator
  // Σ|d|, and of the determinant 1, where it counts |x|/|det| times.
  v.error = static_cast<float>(
      16 * epsilon * (std::abs(da) + std::abs(db) + std::abs(dc) + norm(v.x)) / std::abs(det));
  return v;
}

// The smallest sine of the angles between four planes, at most the guard's.
Real PlaneTable::guarded_sine(const Vertex& vertex, Index s) const {
  const Index p[4] = {vertex.plane[0], vertex.plane[1], vertex.plane[2], s};
  Real squared = guard_sine * guard_sine;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) {
      const Vec3 c = cross(normal_[p[i]], normal_[p[j]]);
      squared = std::min(squared, dot(c, c));
    }
  return std::sqrt(squared);
}

Real PlaneTable::distance(const Vertex& vertex, Index plane) const {
  return dot(normal_[plane], vertex.x) - offset_[plane];
}

Real PlaneTable::exact_distance(const Vertex& vertex, Index plane) const {
  const auto& p = vertex.plane;
  const IntegerPlane& s = store_->plane[plane];
  const IntegerPoint point = meet(store_->plane[p[0]], store_->plane[p[1]], store_->plane[p[2]]);
  const Integer value = dot(s.n, point.x) - s.d * point.w;
  if (value == 0) return 0;
  // The length of the integer normal, by its component along the axis nearest to it.
  const Vec3& n = normal_[plane];
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(n[d]) > std::abs(n[axis])) axis = d;
  return CGAL::to_double(quotient(value, Integer(point.w * s.n[axis]))) * n[axis];
}

// Four planes miss a common point by four distances, that of each from the meeting point of the others: one 4×4
// determinant over the 3×3 determinant of the normals that meet. The least of them over the one of `vertex` from `s`.
Real PlaneTable::least_share(const Vertex& vertex, Index s) const {
  const Vec3 &a = normal_[vertex.plane[0]], &b = normal_[vertex.plane[1]],
             &c = normal_[vertex.plane[2]], &n = normal_[s];
  const Vec3 ab = cross(a, b), cn = cross(c, n);
  const Real own = std::abs(dot(ab, c));
  return own / std::max({own, std::abs(dot(ab, n)), std::abs(dot(a, cn)), std::abs(dot(b, cn))});
}

int PlaneTable::side(const Vertex& vertex, Index plane, IntentCount& intent) const {
  const auto& p = vertex.plane;
  if (plane == p[0] || plane == p[1] || plane == p[2]) return 0;
  const Real d = distance(vertex, plane);
  const Real magnitude = std::abs(d);
  const int sign = d > 0 ? 1 : -1;
  // Rounding of the unit normal (2 ε a component), of the products and of the offset.
  const Real error = vertex.error + 8 * epsilon *
                                        (std::abs(vertex.x[0]) + std::abs(vertex.x[1]) +
                                         std::abs(vertex.x[2]) + std::abs(offset_[plane]));
  if (magnitude > far_factor * tolerance_ + error) return sign;

  if (exactly_known(p[0]) && exactly_known(p[1]) && exactly_known(p[2]) && exactly_known(plane)) {
    if (magnitude > error) return sign;
    const Real exact = exact_distance(vertex, plane);
    return exact > 0 ? 1 : exact < 0 ? -1 : 0;
  }

  // The least distance, so that the answer is the same whichever of the four is asked about: planes that all pass a
  // point within a quarter of the tolerance are concurrent however badly three of them define it. Where two of them are
  // nearly parallel the tolerance shrinks with their angle: what it takes for a point stays as small as elsewhere.
  const Real share = least_share(vertex, plane);
  const Real guard = guarded_sine(vertex, plane) / guard_sine;
  const Real allowed = guard * tolerance_;
  const Real least = magnitude * share, doubt = error * share;
  if (magnitude > error && least * near_factor > allowed && least <= near_factor * tolerance_) {
    ++intent.close_calls;
    if (guard == 1) {
      ++intent.near_decisions;
      intent.near_planes.push_back(plane);
    }
  }
  if (least > allowed + doubt) return sign;
  if (least > allowed - doubt) {
    const Real exact = exact_distance(vertex, plane);
    if (std::abs(exact) * share > allowed) return exact > 0 ? 1 : -1;
    if (exact != 0) ++intent.vertices_identified;
  } else if (magnitude > error) {
    ++intent.vertices_identified;
  }
  return 0;
}

PlaneTable::ExactMoments PlaneTable::exact_moments(
    std::span<const Vertex> vertices, const std::vector<std::array<Index, 3>>& triangles) const {
  std::vector<IntegerVec3> x;  // about the first vertex
  x.reserve(vertices.size());
  for (const Vertex& v : vertices) {
    const IntegerPoint p =
        meet(store_->plane[v.plane[0]], store_->plane[v.plane[1]], store_->plane[v.plane[2]]);
    IntegerVec3 y;
    for (int d = 0; d < 3; ++d) {
      y[d] = p.x[d] * store_->fine / p.w;
      if (!x.empty()) y[d] -= x.front()[d];
    }
    x.push_back(std::move(y));
  }
  const IntegerVec3 o = x.front();
  x.front() = {Integer(0), Integer(0), Integer(0)};
  Integer volume6 = 0;
  IntegerVec3 first24{Integer(0), Integer(0), Integer(0)};
  for (const auto& t : triangles) {
    const IntegerVec3 &a = x[t[0]], &b = x[t[1]], &c = x[t[2]];
    const Integer v = dot(a, cross(b, c));
    volume6 += v;
    for (int d = 0; d < 3; ++d) first24[d] += v * (a[d] + b[d] + c[d]);
  }
  // Points of one plane are off it by a unit; no cell that the tolerance lets stand is nearly as thin.
  const Integer noise = store_->fine * store_->fine * 1000000;
  if (CGAL::abs(volume6) < noise) return {0, {}};
  const Real unit = 1 / CGAL::to_double(store_->fine);
  ExactMoments m;
  m.volume = CGAL::to_double(volume6) * unit * unit * unit / 6;
  for (int d = 0; d < 3; ++d)
    m.first[d] =
        CGAL::to_double(Integer(first24[d] + 4 * o[d] * volume6)) * unit * unit * unit * unit / 24;
  return m;
}

}  // namespace rockfold
