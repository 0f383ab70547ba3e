// Planes by exact coefficients, and the ways to define one. GMP's numbers: include in .cpp only.
#pragma once

#include <array>

#include <CGAL/mpq_class.h>
#include <CGAL/mpz_class.h>

#include "src/base/types.hpp"

namespace rockfold {

using Exact = mpq_class;
using ExactVec3 = std::array<Exact, 3>;

/// n·x = d; the coefficients are the definition. "Above" is the side that n points to.
struct ExactPlane {
  ExactVec3 n;
  Exact d;
};

/// The shortest decimal that reads back as x: text of up to 15 digits is taken as it was written. x is finite.
Exact exact(Real x);
ExactVec3 exact(const Vec3& a);
Exact dot(const ExactVec3& a, const ExactVec3& b);
ExactVec3 cross(const ExactVec3& a, const ExactVec3& b);

/// n·x = n·point + offset: through the point exactly, moved along a unit normal by `offset` (m).
ExactPlane plane_through(const Vec3& normal, const Vec3& point, const Exact& offset = 0);

/// Through `point`, along `u` and `v`; the normal is u × v, exactly.
ExactPlane plane_along(const ExactVec3& point, const ExactVec3& u, const ExactVec3& v);

/// Exactly through three points, counter-clockwise seen from above.
ExactPlane plane_through_points(const ExactVec3& a, const ExactVec3& b, const ExactVec3& c);

ExactPlane opposite(const ExactPlane& plane);

using Integer = mpz_class;
using IntegerVec3 = std::array<Integer, 3>;

/// Integers without a common divisor, in proportion to a plane's coefficients: unlike fractions they need no greatest common
/// divisors later, which are nine tenths of the time.
struct IntegerPlane {
  IntegerVec3 n;
  Integer d;
};
IntegerPlane integers(const ExactVec3& n, const Exact& d);

/// Exactly through the points a and b, perpendicular to the plane with the given normal; its d is n·(a − centre).
IntegerPlane plane_through_edge(const Vec3& a, const Vec3& b, const Vec3& normal,
                                const Vec3& centre);

/// a/b in long double (to 3e-19 of it), rounded to double, however large both are. b is not zero.
Real ratio(const Integer& a, const Integer& b);

/// In doubles: components of the unit normal to ε = 2^-52.
struct UnitPlane {
  Vec3 normal;  ///< unit
  Real offset;  ///< m, n·x of its points x
};
UnitPlane rounded(const IntegerPlane& plane);

/// What a table stores of a plane: most of the work of adding one.
struct NewPlane {
  IntegerPlane exact;  ///< d relative to the table's centre
  UnitPlane unit;
};
/// Its offset is n·(x − centre).
UnitPlane rounded(const ExactPlane& plane, const Vec3& centre);

}  // namespace rockfold
