#include "host/exact/plane_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "host/exact/plane_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
constexpr Real identity_angle = 1e-10;  // decision 5, rule 2
// Below this determinant of the unit normals a vertex is computed exactly, so that its error bound stays small and the filter
// seldom fails.
constexpr Real ill_conditioned = 0.02;

// As a float that is never less: of vertices next to the table's centre floats would round it to nothing.
float bound(Real error) {
  return static_cast<float>(error) + std::numeric_limits<float>::min();
}

// A number that is the same for both orientations of a plane and differs by at most thrice the tolerance between planes
// that coincide: the size of a generic linear function of normal and offset (that of the offset alone would be one number
// for all faces of a sphere).
Real search_key(const UnitPlane& plane, Real size) {
  constexpr Vec3 generic{0.3782, 0.5847, 0.7177};
  return std::abs(plane.offset + size * dot(generic, plane.normal));
}

bool equal(const IntegerPlane& p, const IntegerPlane& q, bool same_sense) {
  const auto same = [&](const Integer& a, const Integer& b) {
    return same_sense ? a == b : mpz_cmpabs(a.get_mpz_t(), b.get_mpz_t()) == 0 && sgn(a) == -sgn(b);
  };
  return same(p.n[0], q.n[0]) && same(p.n[1], q.n[1]) && same(p.n[2], q.n[2]) && same(p.d, q.d);
}

// a ← b × c, with a number to work with.
void cross(IntegerVec3& a, const IntegerVec3& b, const IntegerVec3& c) {
  for (int d = 0; d < 3; ++d) {
    const int i = (d + 1) % 3, j = (d + 2) % 3;
    mpz_mul(a[d].get_mpz_t(), b[i].get_mpz_t(), c[j].get_mpz_t());
    mpz_submul(a[d].get_mpz_t(), b[j].get_mpz_t(), c[i].get_mpz_t());
  }
}

void dot(Integer& a, const IntegerVec3& b, const IntegerVec3& c) {
  mpz_mul(a.get_mpz_t(), b[0].get_mpz_t(), c[0].get_mpz_t());
  mpz_addmul(a.get_mpz_t(), b[1].get_mpz_t(), c[1].get_mpz_t());
  mpz_addmul(a.get_mpz_t(), b[2].get_mpz_t(), c[2].get_mpz_t());
}

// The meeting point of three planes is x/w. Numbers keep their memory between calls.
struct IntegerPoint {
  IntegerVec3 x;
  Integer w;
  IntegerVec3 bc, ca, ab;

  void meet(const IntegerPlane& a, const IntegerPlane& b, const IntegerPlane& c) {
    cross(bc, b.n, c.n), cross(ca, c.n, a.n), cross(ab, a.n, b.n);
    for (int i = 0; i < 3; ++i) {
      mpz_mul(x[i].get_mpz_t(), a.d.get_mpz_t(), bc[i].get_mpz_t());
      mpz_addmul(x[i].get_mpz_t(), b.d.get_mpz_t(), ca[i].get_mpz_t());
      mpz_addmul(x[i].get_mpz_t(), c.d.get_mpz_t(), ab[i].get_mpz_t());
    }
    dot(w, a.n, bc);
  }
};

IntegerPoint& workspace() {
  static thread_local IntegerPoint point;
  return point;
}

Integer power_of_two(int exponent) {
  Integer power = 1;
  mpz_mul_2exp(power.get_mpz_t(), power.get_mpz_t(),
               static_cast<mp_bitcnt_t>(std::max(exponent, 0)));
  return power;
}

}  // namespace

struct PlaneTable::Store {
  Store(const Vec3& about, Real size)
      : centre(exact(about)), fine(power_of_two(224 - std::ilogb(size))) {}

  ExactVec3 centre;

  /// Fixed point: so many units a metre make 2^-224 of the model's size. Rounded once to them, quotients need no fractions.
  Integer fine;
  std::vector<IntegerPlane> plane;    // d relative to the centre
  std::multimap<Real, Index> by_key;  // for find()

  void add(const PlaneTable& table, const UnitPlane& unit, IntegerPlane plane_to_add) {
    by_key.emplace(search_key(unit, table.size_), static_cast<Index>(plane.size()));
    plane.push_back(std::move(plane_to_add));
  }

  IntegerPlane centred(const ExactPlane& given) const {
    return integers(given.n, given.d - rockfold::dot(given.n, centre));
  }

  // The planes that coincide with the given one to the tolerance: visit(id, same sense).
  template <class Visit>
  void visit_near(const PlaneTable& table, const UnitPlane& unit, Visit visit) const {
    const Real key = search_key(unit, table.size_), tolerance = table.identity_tolerance();
    for (auto it = by_key.lower_bound(key - 3 * tolerance);
         it != by_key.end() && it->first <= key + 3 * tolerance; ++it) {
      const Vec3& n = table.normal_[it->second];
      const Real sense = rockfold::dot(n, unit.normal) < 0 ? -1 : 1;
      const bool same_angle = norm(rockfold::cross(n, unit.normal)) <= identity_angle;
      const bool same_place =
          std::abs(unit.offset - sense * table.offset_[it->second]) <= tolerance;
      if (same_angle && same_place) visit(it->second, sense > 0);
    }
  }
};

PlaneTable::PlaneTable(const Vec3& centre, Real size)
    : centre_(centre), size_(size), store_(std::make_unique<Store>(centre, size)) {}
PlaneTable::~PlaneTable() = default;
PlaneTable::PlaneTable(PlaneTable&&) noexcept = default;
PlaneTable& PlaneTable::operator=(PlaneTable&&) noexcept = default;
PlaneTable::PlaneTable(const PlaneTable& other)
    : centre_(other.centre_),
      size_(other.size_),
      normal_(other.normal_),
      offset_(other.offset_),
      store_(std::make_unique<Store>(*other.store_)) {}

Index PlaneTable::append(const UnitPlane& unit, IntegerPlane plane) {
  const Index id = size();
  store_->add(*this, unit, std::move(plane));
  normal_.push_back(unit.normal);
  offset_.push_back(unit.offset);
  return id;
}

Index PlaneTable::add(const ExactPlane& plane) {
  IntegerPlane own = store_->centred(plane);
  const UnitPlane unit = rounded(own);
  return append(unit, std::move(own));
}

HalfSpaceId PlaneTable::find_or_add(const ExactPlane& plane) {
  IntegerPlane own = store_->centred(plane);
  const UnitPlane unit = rounded(own);
  return find_or_add({std::move(own), unit});
}

HalfSpaceId PlaneTable::find_or_add(NewPlane plane) {
  HalfSpaceId found = none;
  store_->visit_near(*this, plane.unit, [&](Index id, bool same_sense) {
    if (found == none && equal(store_->plane[id], plane.exact, same_sense))
      found = half_space(id, same_sense);
  });
  return found != none ? found : half_space(append(plane.unit, std::move(plane.exact)), true);
}

HalfSpaceId PlaneTable::identify_or_add(const ExactPlane& plane) {
  IntegerPlane own = store_->centred(plane);
  const UnitPlane unit = rounded(own);
  HalfSpaceId best = none;
  store_->visit_near(*this, unit, [&](Index id, bool same_sense) {
    if (best == none || id < plane_of(best)) best = half_space(id, same_sense);
  });
  return best != none ? best : half_space(append(unit, std::move(own)), true);
}

int PlaneTable::exact_side(const Vec3& x, Index plane) const {
  const IntegerPlane& p = store_->plane[plane];
  Exact value = -p.d;
  for (int i = 0; i < 3; ++i) value += p.n[i] * (exact(x[i]) - store_->centre[i]);
  return sgn(value);
}

int PlaneTable::exact_side(const Vertex& vertex, Index plane) const {
  IntegerPoint& point = workspace();
  const auto& p = vertex.plane;
  const IntegerPlane& s = store_->plane[plane];
  point.meet(store_->plane[p[0]], store_->plane[p[1]], store_->plane[p[2]]);
  Integer& value = point.ab[0];
  dot(value, s.n, point.x);
  mpz_submul(value.get_mpz_t(), s.d.get_mpz_t(), point.w.get_mpz_t());
  return sgn(value) * sgn(point.w);
}

Vec3 PlaneTable::exact_position(const std::array<Index, 3>& p) const {
  IntegerPoint& point = workspace();
  point.meet(store_->plane[p[0]], store_->plane[p[1]], store_->plane[p[2]]);
  if (point.w == 0) throw std::logic_error("three planes without a common point");
  return {ratio(point.x[0], point.w), ratio(point.x[1], point.w), ratio(point.x[2], point.w)};
}

// Twice the bound of `vertex`, 16 ε·2 L/det, for the least determinant: |x| and with it the offset of a plane through x are L/2.
Real PlaneTable::position_tolerance() const {
  return 2 * 32 * epsilon * size_ / ill_conditioned;
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
    v.error = bound(4 * epsilon * (std::abs(v.x[0]) + std::abs(v.x[1]) + std::abs(v.x[2])));
    return v;
  }
  const Real da = offset_[v.plane[0]], db = offset_[v.plane[1]], dc = offset_[v.plane[2]];
  const Vec3 ca = cross(c, a), ab = cross(a, b);
  v.x = (1 / det) * (da * bc + db * ca + dc * ab);
  // Coefficients carry 1.5 ε each (a plane's own scale cancels), cross products 6 ε, their sums 10 ε: of the numerator
  // Σ|d|, and of the determinant 1, where it counts |x|/|det| times.
  v.error = bound(16 * epsilon * (std::abs(da) + std::abs(db) + std::abs(dc) + norm(v.x)) /
                  std::abs(det));
  return v;
}

PlaneTable::ExactMoments PlaneTable::exact_moments(
    std::span<const Vertex> vertices, const std::vector<std::array<Index, 3>>& triangles) const {
  IntegerPoint& point = workspace();
  std::vector<IntegerVec3> x;  // about the first vertex
  x.reserve(vertices.size());
  for (const Vertex& v : vertices) {
    point.meet(store_->plane[v.plane[0]], store_->plane[v.plane[1]], store_->plane[v.plane[2]]);
    IntegerVec3 y;
    for (int d = 0; d < 3; ++d) {
      y[d] = point.x[d] * store_->fine / point.w;
      if (!x.empty()) y[d] -= x.front()[d];
    }
    x.push_back(std::move(y));
  }
  const IntegerVec3 o = x.front();
  x.front() = {Integer(0), Integer(0), Integer(0)};
  Integer volume6 = 0, v;
  IntegerVec3 first24{Integer(0), Integer(0), Integer(0)}, area;
  for (const auto& t : triangles) {
    const IntegerVec3 &a = x[t[0]], &b = x[t[1]], &c = x[t[2]];
    cross(area, b, c);
    dot(v, a, area);
    volume6 += v;
    for (int d = 0; d < 3; ++d) first24[d] += v * (a[d] + b[d] + c[d]);
  }
  const Integer unit3 = store_->fine * store_->fine * store_->fine;
  ExactMoments m;
  m.volume = ratio(volume6, unit3 * 6);
  for (int d = 0; d < 3; ++d)
    m.first[d] = ratio(first24[d] + 4 * o[d] * volume6, unit3 * store_->fine * 24);
  return m;
}

}  // namespace rockfold
