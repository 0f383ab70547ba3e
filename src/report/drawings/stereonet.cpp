#include "src/report/drawings/stereonet.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "host/bolting/wall.hpp"
#include "host/keyblock/mesh_planes.hpp"
#include "src/base/vector.hpp"
#include "src/model/joint_name.hpp"

namespace rockfold {

namespace {

constexpr Real degree = std::numbers::pi / 180;

/// The mean planes of a table's named sets, or its named joints; none where so many names are numbers of joints.
void add_named_rows(const JointTable& table, std::vector<NetPlane>& planes) {
  std::vector<std::string> names;
  std::map<std::string, Vec3> sum;
  for (const JointTable::Row& row : table.rows) {
    if (row.name.empty()) continue;
    const auto [at, is_new] = sum.try_emplace(row.name, Vec3{});
    if (is_new) names.push_back(row.name);
    const Vec3 normal = net_plane("", row.orientation).normal;
    at->second += dot(at->second, normal) < 0 ? -normal : normal;
  }
  if (names.size() > most_net_planes) return;
  for (const std::string& name : names)
    if (norm(sum[name]) > 0) planes.push_back(net_plane(table.name + "." + name, sum[name]));
}

/// Joint sets, then single joints, then what tables name.
std::vector<NetPlane> planes_of(const Model& model) {
  std::vector<NetPlane> planes;
  for (const JointSet& set : model.joint_sets)
    planes.push_back(net_plane(set.name, set.orientation));
  for (const Joint& joint : model.joints)
    planes.push_back(net_plane(joint.name, joint.plane.orientation));
  for (const JointTable& table : model.joint_tables) add_named_rows(table, planes);
  return planes;
}

/// One for each joint plane that bounds blocks; of a mesh, for each plane that it is on a block.
std::vector<NetContent::Pole> poles_of(const BlockArrays& blocks, const Model& model,
                                       const std::vector<NetPlane>& planes) {
  const MeshPlanes mesh_planes(blocks, model);
  std::vector<NetContent::Pole> poles;
  std::set<std::pair<Index, Index>> seen;
  std::set<std::pair<Index, Vec3>> seen_on_mesh;
  for (std::size_t f = 0; f < blocks.face_origin.size(); ++f) {
    const FaceOrigin& origin = blocks.origins[blocks.face_origin[f]];
    if (origin.kind != FaceOrigin::Kind::joint) continue;
    const Vec3& own = mesh_planes.normal(static_cast<Index>(f));
    const Vec3 normal = own[2] < 0 ? -own : own;
    const bool is_new = mesh_planes.flatness(static_cast<Index>(f))
                            ? seen_on_mesh.insert({blocks.face_origin[f], normal}).second
                            : seen.insert({blocks.face_origin[f], blocks.face_plane[f]}).second;
    if (!is_new) continue;
    const auto plane = std::find_if(planes.begin(), planes.end(), [&](const NetPlane& p) {
      return is_joint_of(origin.name, p.name);
    });
    poles.push_back({normal, static_cast<std::size_t>(plane - planes.begin())});
  }
  return poles;
}

/// Free planes of the drawing's wall; of what runs round an axis, that axis.
void add_wall(NetContent& content, const BlockArrays& blocks, const Model& model,
              const Drawing& drawing) {
  if (drawing.on.owner == none) return;
  content.wall = drawing.on.name;
  const Wall wall(blocks, model, drawing.on, drawing.place);
  for (const WallPanel& panel : wall.panels())
    if (panel.around)
      content.axis = wall.strip(panel.strips.front()).along_v;
    else
      content.free.push_back(wall.strip(panel.strips.front()).across);
}

}  // namespace

NetPlane net_plane(const std::string& name, const Orientation& orientation) {
  Vec3 n;
  if (const auto* given = std::get_if<Vec3>(&orientation)) {
    n = normalized(*given);
  } else {
    const auto& d = std::get<DipOrientation>(orientation);
    n = {std::sin(d.dip * degree) * std::sin(d.dip_direction * degree),
         std::sin(d.dip * degree) * std::cos(d.dip_direction * degree), std::cos(d.dip * degree)};
  }
  if (n[2] < 0) n = -n;
  Real direction = std::atan2(n[0], n[1]) / degree;
  if (direction < 0) direction += 360;
  return {name, n, std::acos(std::clamp(n[2], -1.0, 1.0)) / degree, direction};
}

std::string stereonet(const BlockArrays& blocks, const Model& model, const Drawing& drawing) {
  NetContent content;
  content.title = (model.title.empty() ? "" : model.title + ": ") +
                  (drawing.joint_pyramids ? "joint pyramids" : "joints");
  content.title_of_document = "Stereonet of " + (model.title.empty() ? model.path : model.title);
  content.planes = planes_of(model);
  content.with_poles = drawing.poles;
  if (drawing.poles) content.poles = poles_of(blocks, model, content.planes);
  for (const JointMaterial& material : model.joint_materials)
    content.friction_angles.push_back(material.friction_angle);
  content.upper = drawing.upper;
  content.equal_area = drawing.equal_area;
  content.joint_pyramids = drawing.joint_pyramids;
  add_wall(content, blocks, model, drawing);
  return draw_net(content);
}

}  // namespace rockfold
