// Convex bodies for tests of contact, and what is between two of them by trying everything: all normals of faces, all pairs of edges,
// all pairs of faces clipped corner by corner. Shares no code with kernels/contact.
#pragma once

#include <random>
#include <vector>

#include "src/arrays/surface_arrays.hpp"

namespace rockfold::reference {

struct ConvexBody {
  std::vector<Vec3> vertex;
  std::vector<std::vector<Index>> face;  ///< counter-clockwise seen from outside
};

ConvexBody box_body(const Vec3& low, const Vec3& high);
/// Over a regular polygon of n corners in x, y.
ConvexBody prism_body(int n, Real radius, Real height);
ConvexBody tetrahedron_body(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// The hull of points in general position.
ConvexBody hull_body(const std::vector<Vec3>& points);
/// A box, prism, tetrahedron or hull of about `size`, turned at random, around the origin.
ConvexBody random_body(std::mt19937& random, Real size);

/// A turn by `angle` about the unit vector `axis`.
Mat3 turn(const Vec3& axis, Real angle);
Vec3 random_direction(std::mt19937& random);
void move(ConvexBody& body, const Mat3& by, const Vec3& about, const Vec3& shift);
void shift(ConvexBody& body, const Vec3& by);

/// One block a body; all faces are free but those of `joint` [bodies][faces], if given.
SurfaceArrays surfaces_of(const std::vector<ConvexBody>& bodies,
                          const std::vector<std::vector<Index>>& joint = {});
/// All vertices in the order of surfaces_of.
std::vector<Vec3> places_of(const std::vector<ConvexBody>& bodies);

/// The largest gap of all candidates for a separating plane; the direction is from b to a.
struct Separation {
  Real gap = 0;
  Vec3 direction{};
};
Separation separation(const ConvexBody& a, const ConvexBody& b);

/// Over what a's lower and b's upper faces have in common seen along n: area, and the integrals of the gap and its square.
struct Shadow {
  Real area = 0, gap = 0, squared = 0;
};
Shadow shadow(const ConvexBody& a, const ConvexBody& b, const Vec3& n);

}  // namespace rockfold::reference
