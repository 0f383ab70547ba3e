#include "host/joints/missed_rock.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "host/joints/place_set_exact.hpp"
#include "host/shapes/extents.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

std::vector<Vec3> corners_of(const Extent& box) {
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c)
    corners.push_back({(c & 1 ? box.max : box.min)[0], (c & 2 ? box.max : box.min)[1],
                       (c & 4 ? box.max : box.min)[2]});
  return corners;
}

bool plane_misses(const Vec3& normal, const Vec3& point, const PlacingRegion& region) {
  const Vec3 n = normalized(normal);
  const auto above = [&](const Vec3& x) { return dot(n, x - point); };
  const auto all = [&](const auto& is_off) {
    return std::all_of(region.corners.begin(), region.corners.end(),
                       [&](const Vec3& x) { return is_off(above(x)); });
  };
  return all([&](Real d) { return d > region.margin; }) ||
         all([&](Real d) { return d < -region.margin; });
}

/// Of a circle: no corner of its polygon lies outside.
bool disc_misses(const Vec3& normal, const Vec3& centre, Real radius, const PlacingRegion& region) {
  if (std::isinf(radius)) return plane_misses(normal, centre, region);
  const Vec3 n = normalized(normal);
  Extent box{centre, centre};
  for (int d = 0; d < 3; ++d) {
    const Real reach = radius * std::sqrt(std::max(0.0, 1 - n[d] * n[d]));
    box.min[d] -= reach;
    box.max[d] += reach;
  }
  return !boxes_meet(box, region.box, region.margin) || plane_misses(normal, centre, region);
}

bool misses(const Joint& joint, const PlacingRegion& region) {
  const Vec3 normal = normal_of(joint.plane.orientation);
  if (joint.radius) return disc_misses(normal, joint.plane.point, *joint.radius, region);
  return plane_misses(normal, joint.plane.point, region) ||
         (!joint.polygon.empty() &&
          !boxes_meet(bounding_box(joint.polygon), region.box, region.margin));
}

struct Count {
  std::int64_t missed = 0, all = 0;
};

Count missed_of(const JointSet& set, const PlacingRegion& region) {
  const Vec3 normal = normalized(normal_of(set.orientation));
  const auto [first, last] = set_range(set, region);
  Count count;
  constexpr std::int64_t most = 1'000'000;  // more are refused
  for (Real k = first; k <= last && count.all < most; ++k, ++count.all)
    if (disc_misses(normal, set.origin + (k * set.spacing) * normal,
                    set.radius.value_or(std::numeric_limits<Real>::infinity()), region))
      ++count.missed;
  return count;
}

Count missed_of(const JointTable& table, const PlacingRegion& region) {
  const auto missed =
      std::count_if(table.rows.begin(), table.rows.end(), [&](const JointTable::Row& row) {
        return disc_misses(normal_of(row.orientation), row.center, row.radius, region);
      });
  return {missed, static_cast<std::int64_t>(table.rows.size())};
}

Count missed_of(const JointMesh& mesh, const PlacingRegion& region) {
  const auto& triangles = mesh.surface->triangles;
  const auto corner = [&](Index v) { return mesh.surface->vertices[static_cast<std::size_t>(v)]; };
  const auto missed = std::count_if(triangles.begin(), triangles.end(), [&](const auto& t) {
    return !boxes_meet(bounding_box({corner(t[0]), corner(t[1]), corner(t[2])}), region.box,
                       region.margin);
  });
  return {missed, static_cast<std::int64_t>(triangles.size())};
}

class Beside {
 public:
  explicit Beside(const Model& model) : model_(model), extents_(named_extents(model)) {
    const auto& extents = extents_;
    for (std::size_t s = 0; s < model.solids.size(); ++s) {
      bounds_.solid_corners.push_back(extents[s].bounded ? corners_of(extents[s].box)
                                                         : std::vector<Vec3>{});
      if (!model.solids[s].add) continue;
      const auto& corners = bounds_.solid_corners.back();
      bounds_.corners.insert(bounds_.corners.end(), corners.begin(), corners.end());
    }
  }

  std::vector<Diagnostic> find() {
    find_excavations();
    for (const JointSet& set : model_.joint_sets)
      if (!set.random)
        tell(set.place, missed_of(set, region(set.within)), set.radius ? "disc" : "plane");
    for (const Joint& joint : model_.joints)
      if (misses(joint, region(joint.within)))
        found_.push_back({joint.place, "lies beside the rock and cuts nothing"});
    for (const JointMesh& mesh : model_.joint_meshes)
      if (const Count count = missed_of(mesh, region(mesh.within)); count.missed == count.all)
        tell(mesh.place, count, "triangle");
    for (const JointTable& table : model_.joint_tables)
      tell(table.place, missed_of(table, region(table.within)), "joint");
    return std::move(found_);
  }

 private:
  void find_excavations() {
    if (bounds_.corners.empty()) return;
    const Extent rock = bounding_box(bounds_.corners);
    for (std::size_t e = 0; e < model_.excavations.size(); ++e) {
      const NamedExtent& extent = extents_[model_.solids.size() + e];
      if (extent.bounded && !boxes_meet(extent.box, rock, 0))
        found_.push_back({model_.excavations[e].place, "lies beside the rock and removes nothing"});
    }
  }

  PlacingRegion region(Index within) const { return placing_region(bounds_, within); }

  void tell(const Place& place, const Count& count, const char* what) {
    if (count.all == 0)
      found_.push_back({place, fmt::format("has no {} that meets the rock", what)});
    else if (count.missed == count.all)
      found_.push_back(
          {place, fmt::format("all {} {}s lie beside the rock and cut nothing", count.all, what)});
    else if (count.missed > 0)
      found_.push_back({place, fmt::format("{} of {} {}s lie beside the rock and cut nothing",
                                           count.missed, count.all, what)});
  }

  const Model& model_;
  const std::vector<NamedExtent> extents_;
  RockBounds bounds_;
  std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> joints_beside_rock(const Model& model) {
  const bool none_given = model.joint_sets.empty() && model.joints.empty() &&
                          model.joint_meshes.empty() && model.joint_tables.empty();
  if (model.solids.empty() || (none_given && model.excavations.empty())) return {};
  return Beside(model).find();
}

}  // namespace rockfold
