// Where bodies touch each other: corners that are one point, points on faces, faces that are one plane.
#pragma once

#include <utility>
#include <vector>

#include "host/files/bodies/body_planes.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Bodies with their planes and vertices numbered through, those of the first body first.
struct BodySet {
  std::vector<const TriangleSurface*> surface;  ///< [bodies]
  std::vector<BodyPlanes> planes;               ///< [bodies]
  std::vector<Index> plane_begin{0};            ///< [bodies + 1]
  std::vector<Index> vertex_begin{0};           ///< [bodies + 1]

  void add(const TriangleSurface& body, Real reach);
  const Vec3& outward(Index plane) const;
  Index body_of_plane(Index plane) const;

 private:
  std::vector<std::pair<Index, Index>> plane_;  ///< [planes] body, plane of it
};

struct Touching {
  std::vector<Index> corner;  ///< [vertices] those of one corner have one number, 0, 1, …
  Index corner_count = 0;
  std::vector<Index> face;  ///< [planes] those of one plane have one number, 0, 1, …
  Index face_count = 0;
  Index contacts = 0;  ///< pairs of planes of two bodies that are one
  std::vector<std::pair<Index, Index>>
      on;                     ///< (corner, face): that lies on it; ascending, each once
  std::vector<bool> touches;  ///< [bodies] another one
};

/// What is nearer than `reach` (m) touches. Corners and faces of bodies that touch no other are none. O(n log n) and what is found.
Touching find_touching(const BodySet& bodies, Real reach);

}  // namespace rockfold
