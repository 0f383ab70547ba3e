// A contact's area as the check of certificates derives it, in rational numbers. Roots are rounded to the safe side. Include in .cpp only.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "host/shapes/exact_vector_exact.hpp"
#include "host/stability/certificate.hpp"

namespace rockfold {

/// Thrown where a certificate is wrong; verify() hands it on as its verdict.
struct WrongCertificate {
  std::string what;
};

/// The double itself, where exact() is the shortest decimal that reads back as it.
inline Exact rational(Real x) {
  return Exact(x);
}
inline ExactVec3 rational(const Vec3& a) {
  return {rational(a[0]), rational(a[1]), rational(a[2])};
}
/// |a|²
inline Exact square(const ExactVec3& a) {
  return dot(a, a);
}
/// For messages.
std::string short_text(const Exact& x);

/// Two bounds on the root of a square ≥ 0, each within 2^-105 of it.
struct SafeRoot {
  Exact below, above;
};
SafeRoot root_of(const Exact& square);

/// x divided by a length: not less than that.
inline Exact over(const Exact& x, const SafeRoot& length) {
  return x / (x > 0 ? length.below : length.above);
}

struct CertifiedTriangle {
  std::array<ExactVec3, 3> vertex;  ///< the middle and an edge
  SafeRoot area;                    ///< m²
};

struct CertifiedArea {
  std::string name;                         ///< "contact 3 (J1)"
  std::array<Index, 2> body{};              ///< as ContactArea has them
  ExactVec3 normal;                         ///< as given, nearly unit
  Exact normal_square;                      ///< |normal|²
  SafeRoot normal_length;                   ///< |normal|
  std::vector<ExactVec3> corner;            ///< m
  ExactVec3 middle;                         ///< m, their mean
  std::vector<CertifiedTriangle> triangle;  ///< only where there is cohesion or tensile strength
  Exact friction, cohesion, tension;        ///< tan φ, Pa, Pa
};
CertifiedArea area_of(const RigidMass& mass, Index contact);

/// Throws WrongCertificate unless the area is plane, convex and across a normal of length 1.
void require_shape(const CertifiedArea& area);

/// Of an area, divided by a factor; no more tension than where the cone of friction has its tip.
struct ReducedStrength {
  Exact friction, cohesion, tension;
};
ReducedStrength strength_of(const CertifiedArea& area, const Exact& factor);

/// Throws WrongCertificate, with the place's name, unless a force (N) is one that a point bears whose triangle has `point_area` (m², 0 at corners).
void require_borne(const ExactVec3& force, const CertifiedArea& area,
                   const ReducedStrength& strength, const Exact& point_area,
                   const std::string& place);

}  // namespace rockfold
