#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/exact/orientation.hpp"
#include "host/joints/given_joints_exact.hpp"
#include "host/joints/place_joints_exact.hpp"
#include "host/joints/place_set_exact.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real max_planes_of_set = 1e6;

std::string set_key(std::size_t s) {
  return fmt::format("joint_set[{}]", s + 1);
}

// Of a set of through-going planes, for the estimate of cells.
struct PlaneSet {
  Vec3 normal;  // unit
  Real count, spacing, volume;
};

Real box_volume(const Extent& box) {
  const Vec3 d = box.max - box.min;
  return d[0] * d[1] * d[2];
}

// Planes alone make at most one cell more each, three families at most one a meeting point in the rock; joints with an
// end in the rock and scattered ones are left to the limit while cutting.
void check_cell_count(const Model& model, const std::vector<PlaneSet>& sets) {
  Real cells = 1;
  for (const PlaneSet& set : sets) cells += set.count;
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (std::size_t j = i + 1; j < sets.size(); ++j)
      for (std::size_t k = j + 1; k < sets.size(); ++k) {
        const PlaneSet &a = sets[i], &b = sets[j], &c = sets[k];
        const Real det = std::abs(dot(a.normal, cross(b.normal, c.normal)));
        const Real volume = std::min({a.volume, b.volume, c.volume});
        cells += std::min(volume * det / (a.spacing * b.spacing * c.spacing),
                          a.count * b.count * c.count);
      }
  if (const auto max_cells = static_cast<Real>(model.cut.max_cells); cells > max_cells)
    refuse(model.joint_sets.front().place, "joint_set",
           fmt::format("the joint sets would make about {:.2g} cells, more than {:.2g}; use larger "
                       "spacings or `count`",
                       cells, max_cells));
}

Real checked_count(const JointSet& set, const PlacingRegion& region, const std::string& key) {
  const auto [first, last] = set_range(set, region);
  const Real count = std::max(0.0, last - first + 1);
  if (count > max_planes_of_set)
    refuse(
        set.place, key + (set.count ? ".count" : ".spacing"),
        fmt::format("makes {:.3g} planes of set \"{}\"; at most 1e6 are allowed", count, set.name));
  if (set.radius && *set.radius < least_radius_share * diagonal(region.box))
    refuse(
        set.place, key + ".radius",
        fmt::format("discs of radius {:.3g} m are too small beside rock of {:.3g} m; at least "
                    "{:.3g} m can be told from a point",
                    *set.radius, diagonal(region.box), least_radius_share * diagonal(region.box)));
  return count;
}

// Planes of a random set count with the spacing that they came out with, as if they were parallel.
PlaneSet drawn_planes(const JointSet& set, const std::vector<DrawnJoint>& drawn,
                      const PlacingRegion& region) {
  const Vec3 normal = normalized(normal_of(set.orientation));
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const Vec3& p : region.corners) {
    low = std::min(low, dot(normal, p));
    high = std::max(high, dot(normal, p));
  }
  const auto count = static_cast<Real>(drawn.size());
  return {normal, count, (high - low) / std::max(1.0, count), box_volume(region.box)};
}

void place_sets(const Model& model, const RockBounds& rock, PlacedJoints& placed) {
  const std::size_t count = model.joint_sets.size();
  std::vector<PlacingRegion> regions;
  std::vector<PlaneSet> plane_sets;
  std::vector<std::vector<DrawnJoint>> drawn(count);
  for (std::size_t s = 0; s < count; ++s) {
    const JointSet& set = model.joint_sets[s];
    regions.push_back(placing_region(rock, set.within));
    if (set.random) {
      drawn[s] = draw_joints(set, regions[s].corners, set_key(s));
      if (!set.radius && !set.random->radius)
        plane_sets.push_back(drawn_planes(set, drawn[s], regions[s]));
      continue;
    }
    const Real planes = checked_count(set, regions[s], set_key(s));
    if (!set.radius)
      plane_sets.push_back({normalized(normal_of(set.orientation)), planes, set.spacing,
                            box_volume(regions[s].box)});
  }
  check_cell_count(model, plane_sets);
  for (std::size_t s = 0; s < count; ++s) {
    const JointSet& set = model.joint_sets[s];
    const auto origin = static_cast<Index>(s);
    placed.origins.push_back({set.name, set.material});
    if (set.random)
      place_random_set(set, drawn[s], regions[s], origin, placed.joints);
    else
      place_regular_set(set, regions[s], origin, placed.joints);
  }
}

}  // namespace

PlacedJoints place_joints(const Model& model, const RockBounds& rock) {
  PlacedJoints placed;
  place_sets(model, rock, placed);
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    place_joint(model.joints[j], rock, fmt::format("joint[{}]", j + 1), placed);
  for (std::size_t m = 0; m < model.joint_meshes.size(); ++m)
    place_mesh(model.joint_meshes[m], rock, fmt::format("joint_mesh[{}]", m + 1), placed);
  for (std::size_t t = 0; t < model.joint_tables.size(); ++t)
    place_table(model.joint_tables[t], model.joint_materials, rock,
                fmt::format("joint_table[{}]", t + 1), placed);
  return placed;
}

}  // namespace rockfold
