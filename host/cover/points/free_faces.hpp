// The free faces of the rock, split over the manifold elements: where tractions, quiet boundaries and fixed faces act.
#pragma once

#include <functional>
#include <vector>

#include "host/cover/cover.hpp"

namespace rockfold {

/// A convex part of a free face that lies in one element.
struct FacePolygon {
  Index element = none;      ///< numbered as in CoverArrays
  Index rock = none;         ///< cell of the complex behind it
  Index plane = none;        ///< id in the table of planes; equal ids = one plane
  Vec3 normal{};             ///< unit, outward
  Real share = 1;            ///< 1/2 where two splits are overlaid: each brings its own polygons
  std::vector<Vec3> corner;  ///< m, in a row along the boundary
};

/// Calls `visit` for the free faces of a region, in a deterministic order: those of a face of a solid or an excavation, those that
/// lie in a plane, or the parts of any that lie in a box; none for other regions. Free is a face with no rock behind it, or rock
/// that is excavated before the analysis.
void visit_free_faces(const Cutting& cutting, const Covering& covering, const Region& region,
                      const std::function<void(const FacePolygon&)>& visit);

/// Those of the origins that `wanted` takes.
using FacesOf = std::function<bool(const FaceOrigin&)>;
void visit_free_faces(const Cutting& cutting, const Covering& covering, const FacesOf& wanted,
                      const std::function<void(const FacePolygon&)>& visit);

/// m², and the centroid, m.
Real polygon_area(const std::vector<Vec3>& corner);

}  // namespace rockfold
