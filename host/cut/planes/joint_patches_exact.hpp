// Placed joints as convex patches on planes of the table. CGAL's numbers: include in .cpp only.
#pragma once

#include <vector>

#include "host/cut/planes/edge_planes.hpp"
#include "host/cut/planes/surfaces.hpp"
#include "host/joints/place_joints_exact.hpp"

namespace rockfold {

/// The polygons of finite joints, whose edges have no planes yet.
struct JointPolygons {
  std::vector<FlatPolygon> polygons;
  std::vector<Index> patch;          ///< [polygons] into Complex::joints
  std::vector<Index> through_going;  ///< planes of the other joints
};

/// Adds the joints' planes and patches to the complex in an order that the model's own does not enter but for
/// precedence; concave polygons in convex pieces. Counts the planes identified.
JointPolygons add_joints(const PlacedJoints& placed, CuttingInput& input);

}  // namespace rockfold
