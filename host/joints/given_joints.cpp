#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <fmt/format.h>

#include "host/exact/orientation.hpp"
#include "host/joints/given_joints_exact.hpp"
#include "host/joints/place_set_exact.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// To nearest: CGAL's own conversion may be off by one in the last place.
Real rounded(const Exact& x) {
  Real best = CGAL::to_double(x);
  Exact least = abs(Exact(best) - x);
  const Real infinity = std::numeric_limits<Real>::infinity();
  for (const Real other : {std::nextafter(best, -infinity), std::nextafter(best, infinity)})
    if (const Exact miss = abs(Exact(other) - x); miss < least) best = other, least = miss;
  return best;
}

Vec3 projected(const Vec3& point, const ExactPlane& plane, const Exact& n_squared) {
  const ExactVec3 p = exact(point);
  const Exact t = (dot(plane.n, p) - plane.d) / n_squared;
  Vec3 x;
  for (int d = 0; d < 3; ++d) x[d] = rounded(p[d] - t * plane.n[d]);
  return x;
}

// Seen along the axis that the plane faces most, exactly on the rounded corners.
bool is_simple_with_area(const std::vector<Vec3>& polygon, const ExactPlane& plane) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (abs(plane.n[d]) > abs(plane.n[axis])) axis = d;
  std::vector<Kernel::Point_2> seen;
  for (const Vec3& p : polygon) seen.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
  return CGAL::is_simple_2(seen.begin(), seen.end()) &&
         CGAL::orientation_2(seen.begin(), seen.end()) != CGAL::COLLINEAR;
}

void refuse_tiny_disc(Real radius, const PlacingRegion& region, const Place& place,
                      const std::string& key) {
  const Real size = diagonal(region.box);
  if (radius < least_radius_share * size)
    refuse(place, key,
           fmt::format("a disc of radius {:.3g} m is too small beside rock of {:.3g} m; at least "
                       "{:.3g} m can be told from a point",
                       radius, size, least_radius_share * size));
}

// The origins of a table: one for each name and material that its rows have, in the order of the rows. Names of several: "table.name",
// "table.material", "table.name.material" where rows of one name differ in material.
class TableOrigins {
 public:
  TableOrigins(const JointTable& table, const std::vector<JointMaterial>& materials,
               PlacedJoints& placed)
      : table_(table), materials_(materials), placed_(placed) {}

  Index of(const JointTable::Row& row) {
    const auto [at, is_new] = number_.try_emplace(std::pair(row.name, row.material),
                                                  static_cast<Index>(placed_.origins.size()));
    if (is_new) placed_.origins.push_back({table_.name, row.material});
    return at->second;
  }

  // Once all rows are placed.
  void name() {
    if (number_.empty()) placed_.origins.push_back({table_.name, table_.material});
    std::map<std::string, int> materials_of_name;
    for (const auto& [key, origin] : number_) ++materials_of_name[key.first];
    for (const auto& [key, origin] : number_) {
      std::string& name = placed_.origins[origin].name;
      if (!key.first.empty()) name += "." + key.first;
      if (key.second != none && materials_of_name[key.first] > 1)
        name += "." + materials_[key.second].name;
    }
  }

 private:
  const JointTable& table_;
  const std::vector<JointMaterial>& materials_;
  PlacedJoints& placed_;
  std::map<std::pair<std::string, Index>, Index> number_;
};

}  // namespace

void place_joint(const Joint& joint, const RockBounds& rock, const std::string& key,
                 PlacedJoints& placed) {
  const auto origin = static_cast<Index>(placed.origins.size());
  placed.origins.push_back({joint.name, joint.material});
  const GivenPlane& given = joint.plane;
  PlacedJoint one{
      plane_through(normal_of(given.orientation), given.point), {}, origin, joint.within};
  const PlacingRegion region = placing_region(rock, joint.within);
  if (!joint.polygon.empty()) {
    const Exact n_squared = dot(one.plane.n, one.plane.n);
    for (const Vec3& p : joint.polygon) one.polygon.push_back(projected(p, one.plane, n_squared));
    if (!is_simple_with_area(one.polygon, one.plane))
      refuse(joint.place, key + ".polygon",
             fmt::format("the polygon of joint \"{}\", projected on its plane along the normal, "
                         "crosses or touches itself or has no area; corners must go once around",
                         joint.name));
    if (boxes_meet(bounding_box(one.polygon), region.box, region.margin))
      placed.joints.push_back(std::move(one));
  } else if (joint.radius) {
    refuse_tiny_disc(*joint.radius, region, joint.place, key + ".radius");
    const ExactPlane plane = one.plane;
    place_disc(plane, plane_frame(given.orientation), given.point, {}, *joint.radius,
               disc_outline(joint.sides), region, std::move(one), placed.joints);
  } else {
    placed.joints.push_back(std::move(one));
  }
}

void place_mesh(const JointMesh& mesh, const RockBounds& rock, PlacedJoints& placed) {
  const auto origin = static_cast<Index>(placed.origins.size());
  placed.origins.push_back({mesh.name, mesh.material});
  const PlacingRegion region = placing_region(rock, mesh.within);
  const TriangleSurface& surface = *mesh.surface;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    PlacedJoint one;
    one.polygon = {surface.vertices[a], surface.vertices[b], surface.vertices[c]};
    if (!boxes_meet(bounding_box(one.polygon), region.box, region.margin)) continue;
    one.plane =
        plane_through_points(exact(one.polygon[0]), exact(one.polygon[1]), exact(one.polygon[2]));
    if (one.plane.n[0] == 0 && one.plane.n[1] == 0 && one.plane.n[2] == 0) continue;  // no area
    one.origin = origin;
    one.within = mesh.within;
    one.of_mesh = true;
    placed.joints.push_back(std::move(one));
  }
}

void place_table(const JointTable& table, const std::vector<JointMaterial>& materials,
                 const RockBounds& rock, const std::string& key, PlacedJoints& placed) {
  const PlacingRegion region = placing_region(rock, table.within);
  const DiscOutline outline = disc_outline(table.sides);
  TableOrigins origins(table, materials, placed);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const JointTable::Row& row = table.rows[r];
    const Index origin = origins.of(row);
    const ExactPlane plane = plane_through(normal_of(row.orientation), row.center);
    const PlacedJoint one{plane, {}, origin, table.within};
    if (std::isinf(row.radius)) {
      placed.joints.push_back(one);
      continue;
    }
    refuse_tiny_disc(row.radius, region, table.place, fmt::format("{}.file row {}", key, r + 1));
    place_disc(plane, plane_frame(row.orientation), row.center, {}, row.radius, outline, region,
               one, placed.joints);
  }
  origins.name();
}

}  // namespace rockfold
