#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host/cut/cells/near_boxes.hpp"
#include "host/cut/planes/joint_patches_exact.hpp"
#include "host/refuse.hpp"
#include "host/shapes/convex_pieces_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// A joint with what orders it independently of the model's own order.
struct OrderedJoint {
  const PlacedJoint* joint;
  ExactPlane plane;          // normal with the upward sense
  std::array<Real, 4> key;   // unit normal and offset
  std::vector<Vec3> corner;  // m, as given
};

OrderedJoint with_key(const PlacedJoint& joint, const Vec3& centre) {
  OrderedJoint k{&joint, joint.plane, {}, joint.polygon};
  const auto& n = k.plane.n;
  if (n[2] < 0 || (n[2] == 0 && (n[1] < 0 || (n[1] == 0 && n[0] < 0)))) k.plane = opposite(k.plane);
  const auto [unit, offset] = rounded(k.plane, centre);
  k.key = {unit[0], unit[1], unit[2], offset};
  // The same corner first, whichever the user began with.
  std::rotate(k.corner.begin(), std::min_element(k.corner.begin(), k.corner.end()), k.corner.end());
  return k;
}

std::vector<OrderedJoint> in_order(const PlacedJoints& placed, const Vec3& centre) {
  std::vector<OrderedJoint> joints;
  joints.reserve(placed.joints.size());
  for (const PlacedJoint& joint : placed.joints) joints.push_back(with_key(joint, centre));
  std::stable_sort(joints.begin(), joints.end(), [](const OrderedJoint& a, const OrderedJoint& b) {
    if (a.key != b.key) return a.key < b.key;
    return a.corner != b.corner ? a.corner < b.corner : a.joint->origin < b.joint->origin;
  });
  return joints;
}

// Corners nearer to each other than the tolerance are one corner: the first of them in the order of coordinates. Returns how
// many were another one.
Index join_corners(std::vector<OrderedJoint>& joints, Real tolerance) {
  std::vector<Vec3> corners;
  for (const OrderedJoint& j : joints)
    corners.insert(corners.end(), j.corner.begin(), j.corner.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<Box> boxes(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) boxes[i].add(corners[i]);
  const auto near = earlier_near_boxes(boxes, tolerance);
  std::map<Vec3, Vec3> moved;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (const Index j : near[i])
      if (moved.count(corners[j]) == 0 && norm(corners[j] - corners[i]) <= tolerance) {
        moved.emplace(corners[i], corners[j]);
        break;
      }
  if (moved.empty()) return 0;
  for (OrderedJoint& joint : joints) {
    for (Vec3& x : joint.corner)
      if (const auto found = moved.find(x); found != moved.end()) x = found->second;
    auto& c = joint.corner;
    c.erase(std::unique(c.begin(), c.end()), c.end());
    while (c.size() > 1 && c.front() == c.back()) c.pop_back();
  }
  return static_cast<Index>(moved.size());
}

// Finds the plane of each joint: first through-going ones, then polygons, the larger the earlier.
class JointPlanes {
 public:
  JointPlanes(const std::vector<OrderedJoint>& joints, CuttingInput& input)
      : joints_(joints), planes_(input.complex.planes), identified_(input.intent.planes) {}

  std::vector<Index> run() {
    std::vector<Index> order;
    std::vector<Real> size;  // m
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      Box box;
      for (const Vec3& x : joints_[i].corner) box.add(x);
      size.push_back(joints_[i].corner.empty() ? Box::infinity : norm(box.high - box.low));
      order.push_back(static_cast<Index>(i));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return size[a] > size[b]; });
    std::vector<Index> plane(joints_.size(), none);
    for (const Index i : order) {
      const Index before = planes_.size();
      const ExactPlane own = own_plane(joints_[i]);
      plane[i] = plane_of(joints_[i].joint->of_mesh ? planes_.find_or_add(own)
                                                    : planes_.identify_or_add(own));
      if (planes_.size() == before) identified_.push_back(plane[i]);
    }
    return plane;
  }

 private:
  // A triangle's plane passes exactly through its corners (decision 5, rule 1).
  static ExactPlane own_plane(const OrderedJoint& joint) {
    if (joint.corner.size() != 3) return joint.plane;
    ExactPlane plane = plane_through_points(exact(joint.corner[0]), exact(joint.corner[1]),
                                            exact(joint.corner[2]));
    const bool has_area = std::any_of(plane.n.begin(), plane.n.end(),
                                      [](const Exact& component) { return component != 0; });
    return has_area ? plane : joint.plane;
  }

  const std::vector<OrderedJoint>& joints_;
  PlaneTable& planes_;
  std::vector<Index>& identified_;
};

// A polygon seen along an axis: its convex pieces, and its signed area.
struct FlatPieces {
  std::vector<ConvexPiece> pieces;
  Real area = 0;
};
FlatPieces flat_pieces(const std::vector<Vec3>& c, int u, int v) {
  ExactPolygon flat;
  FlatPieces result;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Vec3 &a = c[k], &b = c[(k + 1) % c.size()];
    flat.push_back({exact(a[u]), exact(a[v])});
    result.area += (a[u] - c[0][u]) * (b[v] - c[0][v]) - (b[u] - c[0][u]) * (a[v] - c[0][v]);
  }
  result.pieces = convex_pieces(flat);
  return result;
}

void add_polygon(const OrderedJoint& joint, JointPatch patch, Complex& complex,
                 JointPolygons& result) {
  const Vec3& normal = complex.planes.normal(patch.patch.plane);
  int drop = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[drop])) drop = d;
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  // Corners that were made one may pinch a polygon: then it stays as it was given.
  FlatPieces flat = flat_pieces(joint.corner, u, v);
  const bool pinched = flat.pieces.empty();
  const std::vector<Vec3>& c = pinched ? joint.joint->polygon : joint.corner;
  if (pinched) flat = flat_pieces(c, u, v);
  for (const ConvexPiece& piece : flat.pieces) {
    FlatPolygon polygon;
    polygon.plane = patch.patch.plane;
    patch.patch.box = patch.patch.corners = {};
    for (const PieceEdge& edge : piece) {
      polygon.corner.push_back(c[edge.from]);
      patch.patch.box.add(c[edge.from] - complex.planes.centre());
      patch.patch.corners.add(c[edge.from]);
    }
    // A convex polygon stays in its given sense, pieces run counter-clockwise in (u, v).
    const bool counter_clockwise = flat.pieces.size() > 1 || flat.area > 0;
    if (counter_clockwise != (normal[drop] > 0))
      std::reverse(polygon.corner.begin(), polygon.corner.end());
    result.polygons.push_back(std::move(polygon));
    result.patch.push_back(static_cast<Index>(complex.joints.size()));
    complex.joints.push_back(patch);
  }
}

}  // namespace

JointPolygons add_joints(const PlacedJoints& placed, CuttingInput& input) {
  Complex& complex = input.complex;
  std::vector<OrderedJoint> joints = in_order(placed, complex.planes.centre());
  input.intent.corners = join_corners(joints, complex.planes.identity_tolerance());
  const std::vector<Index> plane = JointPlanes(joints, input).run();

  std::vector<Index> by_precedence(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) by_precedence[i] = static_cast<Index>(i);
  std::stable_sort(by_precedence.begin(), by_precedence.end(), [&](Index a, Index b) {
    return joints[a].joint->origin < joints[b].joint->origin;
  });
  JointPolygons result;
  for (const Index i : by_precedence) {
    JointPatch patch;
    patch.patch.plane = plane[i];
    patch.origin = joints[i].joint->origin;
    patch.within = joints[i].joint->within;
    patch.instance = i;
    if (joints[i].corner.empty()) {
      result.through_going.push_back(plane[i]);
      complex.joints.push_back(std::move(patch));
    } else {
      add_polygon(joints[i], std::move(patch), complex, result);
    }
  }
  return result;
}

}  // namespace rockfold
