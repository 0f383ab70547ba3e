// The whole rock mass as rigid blocks that press on each other: what limit analysis asks about.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// A block that may move, with all that loads it but the forces in its contacts.
struct RigidBody6 {
  Index block = none;  ///< into BlockArrays
  Vec3 centre{};       ///< m
  Vec3 force{};        ///< N: weight, earthquake, water, tractions, point loads
  Vec3 moment{};       ///< N m about the centre
};

/// A convex, plane area that two bodies share, or that a body shares with rock that is held.
struct ContactArea {
  /// Into RigidMass::bodies; none = rock that is held. The second presses on the first along `normal`.
  std::array<Index, 2> body{none, none};
  Vec3 normal{};             ///< unit, from the second into the first
  std::vector<Vec3> corner;  ///< m, in order round the area; three or more
  Real friction = 0;         ///< tan φ
  Real cohesion = 0;         ///< Pa
  Real tension = 0;          ///< Pa, tensile strength
  std::string joint;         ///< its name
};

/// What a bolt passes between two bodies: tension along it. No factor divides it.
struct BoltTie {
  /// Into RigidMass::bodies; none = rock that is held. It pulls the first along `axis`, and the second back.
  std::array<Index, 2> body{none, none};
  Vec3 at{};    ///< m, a point of its line
  Vec3 axis{};  ///< unit, from the collar into the rock
  Real least = 0,
       most = 0;  ///< N, 0 ≤ least ≤ most; the same of a bolt that is stressed to what it bears
  std::string bolt;  ///< its name
};

struct RigidMass {
  std::vector<RigidBody6> bodies;
  std::vector<ContactArea> contacts;
  std::vector<BoltTie> ties;
};

/// A place where a contact area passes on force. Strength is spread over the area: each of its triangles between the middle and an edge passes a
/// uniform stress, a force at the triangle's centroid; and the corners pass pressure and the friction that goes with it, so that any
/// distribution of pressure over the area is among them.
struct ForcePoint {
  Index contact = none;
  Vec3 at{};      ///< m
  Real area = 0;  ///< m² whose cohesion and tensile strength act here; 0 at a corner
};

/// Of each contact its corners in order, then, where it has cohesion or tensile strength, its triangles' centroids in the same order.
std::vector<ForcePoint> force_points(const RigidMass& mass);

}  // namespace rockfold
