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

ExactVec3 exact(const Vec3& a);
Exact dot(const ExactVec3& a, const ExactVec3& b);
ExactVec3 cross(const ExactVec3& a, const ExactVec3& b);

/// n·x = n·point + offset: through the point exactly, moved along a unit normal by `offset` (m).
ExactPlane plane_through(const Vec3& normal, const Vec3& point, Real offset = 0);

/// Through `point`, along `u` and `v`; the normal is u × v, exactly.
ExactPlane plane_along(const ExactVec3& point, const ExactVec3& u, const ExactVec3& v);

/// Exactly through three points, counter-clockwise seen from above.
ExactPlane plane_through_points(const Vec3& a, const Vec3& b, const Vec3& c);

ExactPlane opposite(const ExactPlane& plane);

}  // namespace rockfold
