// Planes by exact coefficients, and the ways to define one. CGAL's exact rational numbers: include in .cpp only.
#pragma once

#include <array>

#include <CGAL/Exact_rational.h>

#include "src/base/types.hpp"

namespace rockfold {

using Exact = CGAL::Exact_rational;
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

/// In doubles, about a point.
struct UnitPlane {
  Vec3 normal;  ///< unit
  Real offset;  ///< m, n·(x − centre) of its points x
};
UnitPlane rounded(const ExactVec3& n, const Exact& centred_d);
UnitPlane rounded(const ExactPlane& plane, const Vec3& centre);

}  // namespace rockfold
