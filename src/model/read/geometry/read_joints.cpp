// [[joint_set]] and [[joint]].
#include <algorithm>

#include "src/base/vector.hpp"
#include "src/model/planar_polygon.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_random.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

/// "sides" without a disc would be without effect.
void read_disc(TableReader& in, std::optional<Real>& radius, Index& sides, bool other_radius) {
  in.read("radius", radius, length());
  read_sides(in, sides);
  if (in.has("sides") && !in.has("radius") && !other_radius)
    in.wrong("sides", "belongs to discs, but there is no radius");
}

void read_planes(TableReader& in, JointSet& set) {
  in.read("spacing", set.spacing, length());
  Index count = 0;
  if (in.read("count", count, IntegerRange{.low = 1}, Need::optional)) set.count = count;
}

/// What says where a random set's joints lie stands in "random"; how many stand at random spacings may be limited here.
void read_random_planes(TableReader& in, JointSet& set) {
  if (in.has("spacing"))
    in.wrong("spacing", "a random set takes it from [joint_set.random]; leave this one out");
  const auto* random = std::get_if<Table>(&in.find("random")->data);
  Index count = 0;
  if (random && random->find("spacing")) {
    if (in.read("count", count, IntegerRange{.low = 1}, Need::optional)) set.count = count;
  } else if (in.has("count")) {
    in.wrong("count",
             "limits joints that lie one spacing after another, but [joint_set.random] has no "
             "spacing; discs that lie uniformly take it from [joint_set.random]");
  }
}

/// "polygon", with the plane that it lies on or is projected on.
void read_polygon(TableReader& in, Joint& joint) {
  const auto* value = in.find("polygon");
  const bool oriented = in.has("dip") || in.has("dip_direction") || in.has("normal");
  const bool plane = oriented && read_orientation(in, joint.plane.orientation);
  const auto points = points_from(*value, in.path_of("polygon"), 3, in.out());
  const bool placed = in.read("point", joint.plane.point, coordinate(), Need::optional);
  if (in.has("radius")) in.wrong("radius", "a joint has either a radius or a polygon, not both");
  if (!points || (oriented && !plane)) return;
  if (!placed) joint.plane.point = points->front();
  const auto problem =
      oriented ? projected_polygon_problem(*points, unit_normal(joint.plane.orientation))
               : polygon_problem(*points);
  if (!problem.empty()) {
    in.wrong("polygon", problem);
    return;
  }
  if (!oriented) joint.plane.orientation = doubled_area(*points);  // the polygon's own plane
  if (!oriented && leaves_plane(*points, joint.plane.point - points->front()))
    in.wrong("point", "is not in the plane of the polygon; leave it out, or give an orientation");
  joint.polygon = *points;
}

}  // namespace

std::vector<std::string> joint_names(const Draft& draft) {
  std::vector<std::string> names = draft.joints.all();
  for (const Solid& solid : draft.model.solids)
    if (solid.interface != none) names.push_back(solid.name + ".interface");
  return names;
}

bool is_joint(const Draft& draft, const std::string& name) {
  if (draft.joints.find(name) != none) return true;
  const auto& solids = draft.model.solids;
  return std::any_of(solids.begin(), solids.end(), [&](const Solid& solid) {
    return solid.interface != none && name == solid.name + ".interface";
  });
}

void read_within(TableReader& in, const Draft& draft, Index& target) {
  in.read_optional_reference("within", draft.solids, target);
}

void read_joint_sets(Draft& draft) {
  read_entries(draft, "joint_set", [&](TableReader& in, Index number) {
    JointSet set;
    set.name = in.read_name(draft.joints, "set" + std::to_string(number));
    set.place = in.place();
    read_orientation(in, set.orientation);
    const bool random = in.has("random");
    if (random) {
      read_random_planes(in, set);
    } else {
      read_planes(in, set);
    }
    in.read("origin", set.origin, coordinate(), Need::optional);
    in.read_reference("material", draft.joint_materials, set.material);
    if (random) set.random = read_random(in, static_cast<std::uint64_t>(number));
    read_disc(in, set.radius, set.sides, set.random && set.random->radius);
    read_within(in, draft, set.within);
    draft.model.joint_sets.push_back(std::move(set));
  });
}

void read_joints(Draft& draft) {
  read_entries(draft, "joint", [&](TableReader& in, Index number) {
    Joint joint;
    joint.name = in.read_name(draft.joints, "joint" + std::to_string(number));
    joint.place = in.place();
    if (in.has("polygon")) {
      read_polygon(in, joint);
    } else {
      read_plane(in, joint.plane);
    }
    in.read_reference("material", draft.joint_materials, joint.material);
    if (!in.has("polygon")) {
      read_disc(in, joint.radius, joint.sides, false);
    } else if (in.has("sides")) {
      in.wrong("sides", "belongs to discs, but this joint is a polygon");
    }
    read_within(in, draft, joint.within);
    draft.model.joints.push_back(std::move(joint));
  });
}

}  // namespace rockfold
