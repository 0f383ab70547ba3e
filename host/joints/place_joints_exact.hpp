// All joints of a model as planes with polygons: sets laid out, random sets drawn, tables and meshes read. CGAL's numbers:
// include in .cpp only.
#pragma once

#include <string>
#include <vector>

#include "host/exact/plane_exact.hpp"
#include "host/joints/cell_limit.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct PlacedJoint {
  ExactPlane plane;
  /// m, model coordinates: a simple polygon (may be concave, either sense) whose corners lie on the plane to rounding;
  /// empty = through-going.
  std::vector<Vec3> polygon;
  Index origin = none;  ///< into PlacedJoints::origins
  Index within = none;  ///< into Model::solids
  /// A triangle of a mesh: it shares edges with others, and keeps its own plane so that they stay shared.
  bool of_mesh = false;
};

struct JointOrigin {
  std::string name;
  Index material = none;  ///< into Model::joint_materials
};

struct PlacedJoints {
  /// In the order of precedence where coplanar joints overlap: joint sets, joints, joint meshes, then joint tables (one
  /// origin for each material that a table's rows use).
  std::vector<JointOrigin> origins;
  std::vector<PlacedJoint> joints;
  std::vector<PlaneSet> plane_sets;  ///< the joint sets of through-going planes
};

/// The rock before joints cut it, as far as placing joints needs it.
struct RockBounds {
  std::vector<Vec3> corners;  ///< m; the '+' solids lie in the convex hull of these
  /// [solids] likewise of each solid, for `within`
  std::vector<std::vector<Vec3>> solid_corners;
};

/// Throws Error(model) for sets that would make absurdly many joints or cells, and for joints without area.
PlacedJoints place_joints(const Model& model, const RockBounds& rock);

}  // namespace rockfold
