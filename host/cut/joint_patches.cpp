#include <algorithm>
#include <array>
#include <cmath>

#include "host/cut/joint_patches_exact.hpp"
#include "host/exact/convex_pieces.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// A joint with what orders it independently of the model's own order.
struct Keyed {
  const PlacedJoint* joint;
  ExactPlane plane;           // normal with the upward sense
  std::array<Real, 4> key;    // unit normal and offset
  std::vector<Vec3> corners;  // sorted
};

Keyed keyed(const PlacedJoint& joint, const Vec3& centre) {
  Keyed k{&joint, joint.plane, {}, joint.polygon};
  const auto& n = k.plane.n;
  if (n[2] < 0 || (n[2] == 0 && (n[1] < 0 || (n[1] == 0 && n[0] < 0)))) k.plane = opposite(k.plane);
  PlaneTable rounding(centre, 1);
  const Index id = rounding.add(k.plane);
  const Vec3& unit = rounding.normal(id);
  k.key = {unit[0], unit[1], unit[2], rounding.offset(id)};
  std::sort(k.corners.begin(), k.corners.end());
  return k;
}

std::vector<Keyed> in_order(const PlacedJoints& placed, const Vec3& centre) {
  std::vector<Keyed> joints;
  joints.reserve(placed.joints.size());
  for (const PlacedJoint& joint : placed.joints) joints.push_back(keyed(joint, centre));
  std::stable_sort(joints.begin(), joints.end(), [](const Keyed& a, const Keyed& b) {
    if (a.key != b.key) return a.key < b.key;
    return a.corners != b.corners ? a.corners < b.corners : a.joint->origin < b.joint->origin;
  });
  return joints;
}

// The polygon counter-clockwise seen from above, in two coordinates and in space about the centre.
struct Outline {
  std::vector<std::array<Real, 2>> flat;
  std::vector<Vec3> corner;
};

Outline outline_of(const std::vector<Vec3>& polygon, const Vec3& normal, const Vec3& centre) {
  int drop = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[drop])) drop = d;
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  Outline outline;
  for (const Vec3& x : polygon) {
    outline.corner.push_back(x - centre);
    outline.flat.push_back({outline.corner.back()[u], outline.corner.back()[v]});
  }
  Real area = 0;
  const auto& p = outline.flat;
  for (std::size_t k = 1; k + 1 < p.size(); ++k)
    area += (p[k][0] - p[0][0]) * (p[k + 1][1] - p[0][1]) -
            (p[k + 1][0] - p[0][0]) * (p[k][1] - p[0][1]);
  if (area < 0) {
    std::reverse(outline.flat.begin(), outline.flat.end());
    std::reverse(outline.corner.begin(), outline.corner.end());
  }
  // Now counter-clockwise in (u, v), whose normal is the dropped axis.
  return outline;
}

void add_polygon(const PlacedJoint& joint, JointPatch patch, Complex& complex,
                 JointPolygons& result) {
  const Vec3& normal = complex.planes.normal(patch.patch.plane);
  const Outline outline = outline_of(joint.polygon, normal, complex.planes.centre());
  int drop = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[drop])) drop = d;
  for (const auto& piece : convex_pieces(outline.flat)) {
    FlatPolygon polygon;
    polygon.plane = patch.patch.plane;
    patch.patch.box = {};
    for (const Index k : piece) {
      polygon.corner.push_back(outline.corner[k]);
      patch.patch.box.add(outline.corner[k]);
    }
    if (normal[drop] < 0) std::reverse(polygon.corner.begin(), polygon.corner.end());
    result.polygons.push_back(std::move(polygon));
    result.patch.push_back(static_cast<Index>(complex.joints.size()));
    complex.joints.push_back(patch);
  }
}

}  // namespace

JointPolygons add_joints(const PlacedJoints& placed, CuttingInput& input) {
  Complex& complex = input.complex;
  const std::vector<Keyed> joints = in_order(placed, complex.planes.centre());
  std::vector<JointPatch> patches;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const HalfSpaceId found = complex.planes.find(joints[i].plane);
    if (found != none) ++input.planes_identified;
    JointPatch patch;
    patch.patch.plane = found != none ? plane_of(found) : complex.planes.add(joints[i].plane);
    patch.origin = joints[i].joint->origin;
    patch.within = joints[i].joint->within;
    patch.instance = static_cast<Index>(i);
    patches.push_back(std::move(patch));
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const JointPatch& a, const JointPatch& b) { return a.origin < b.origin; });
  JointPolygons result;
  for (JointPatch& patch : patches) {
    const PlacedJoint& joint = *joints[patch.instance].joint;
    if (joint.polygon.empty()) {
      result.through_going.push_back(patch.patch.plane);
      complex.joints.push_back(std::move(patch));
    } else {
      add_polygon(joint, std::move(patch), complex, result);
    }
  }
  return result;
}

}  // namespace rockfold
