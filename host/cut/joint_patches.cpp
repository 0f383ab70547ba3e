#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "host/cut/joint_patches_exact.hpp"
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
  PlaneTable rounding(centre, 1);
  const Index id = rounding.add(k.plane);
  const Vec3& unit = rounding.normal(id);
  k.key = {unit[0], unit[1], unit[2], rounding.offset(id)};
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

// Corners nearer to each other than the tolerance are one corner: the first of them in the order of coordinates.
void join_corners(std::vector<OrderedJoint>& joints, Real tolerance) {
  std::vector<Vec3> corners;
  for (const OrderedJoint& j : joints)
    corners.insert(corners.end(), j.corner.begin(), j.corner.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::map<Vec3, Vec3> moved;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    while (corners[begin][0] < corners[i][0] - tolerance) ++begin;
    for (std::size_t j = begin; j < i; ++j)
      if (moved.count(corners[j]) == 0 && norm(corners[j] - corners[i]) <= tolerance) {
        moved.emplace(corners[i], corners[j]);
        break;
      }
  }
  for (OrderedJoint& joint : joints)
    for (Vec3& x : joint.corner)
      if (const auto found = moved.find(x); found != moved.end()) x = found->second;
}

bool holds(const PlaneTable& planes, Index plane, const OrderedJoint& joint) {
  return std::all_of(joint.corner.begin(), joint.corner.end(), [&](const Vec3& x) {
    const Real d = dot(planes.normal(plane), x - planes.centre()) - planes.offset(plane);
    return std::abs(d) <= planes.tolerance();
  });
}

// Finds the plane of each joint: first through-going ones, then polygons, the larger the earlier. A polygon all of whose
// corners lie on a plane that is there takes it.
class JointPlanes {
 public:
  JointPlanes(const std::vector<OrderedJoint>& joints, CuttingInput& input)
      : joints_(joints), planes_(input.complex.planes), identified_(input.planes_identified) {}

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
    for (const Index i : order) plane[i] = find_or_add(joints_[i]);
    return plane;
  }

 private:
  Index find_or_add(const OrderedJoint& joint) {
    std::vector<Vec3> corners = joint.corner;
    for (Vec3& x : corners) x = x - planes_.centre();
    const Index before = planes_.size();
    const HalfSpaceId found = planes_.find_or_add(own_plane(joint), corners);
    if (planes_.size() == before) ++identified_;
    return plane_of(found);
  }

  // A triangle's plane passes exactly through its corners (DESIGN.md, rule 1), unless it was given by another one.
  ExactPlane own_plane(const OrderedJoint& joint) const {
    if (joint.corner.size() != 3) return joint.plane;
    PlaneTable given(planes_.centre(), planes_.model_size());
    if (!holds(given, given.add(joint.plane), joint)) return joint.plane;
    ExactPlane plane = plane_through_points(joint.corner[0], joint.corner[1], joint.corner[2]);
    const bool has_area = std::any_of(plane.n.begin(), plane.n.end(),
                                      [](const Exact& component) { return component != 0; });
    return has_area ? plane : joint.plane;
  }

  const std::vector<OrderedJoint>& joints_;
  PlaneTable& planes_;
  Index& identified_;
};

void add_polygon(const OrderedJoint& joint, JointPatch patch, Complex& complex,
                 JointPolygons& result) {
  const Vec3& normal = complex.planes.normal(patch.patch.plane);
  int drop = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[drop])) drop = d;
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  ExactPolygon flat;
  Real area = 0;
  const auto& c = joint.corner;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Vec3 &a = c[k], &b = c[(k + 1) % c.size()];
    flat.push_back({Exact(a[u]), Exact(a[v])});
    area += (a[u] - c[0][u]) * (b[v] - c[0][v]) - (b[u] - c[0][u]) * (a[v] - c[0][v]);
  }
  const auto pieces = convex_pieces(flat);
  for (const ConvexPiece& piece : pieces) {
    FlatPolygon polygon;
    polygon.plane = patch.patch.plane;
    patch.patch.box = patch.patch.corners = {};
    for (const PieceEdge& edge : piece) {
      polygon.corner.push_back(c[edge.from]);
      patch.patch.box.add(c[edge.from] - complex.planes.centre());
      patch.patch.corners.add(c[edge.from]);
    }
    // A convex polygon stays in its given sense, pieces run counter-clockwise in (u, v).
    const bool counter_clockwise = pieces.size() > 1 || area > 0;
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
  join_corners(joints, complex.planes.tolerance());
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
