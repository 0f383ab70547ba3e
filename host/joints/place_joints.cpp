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

Real box_volume(const Extent& box) {
  const Vec3 d = box.max - box.min;
  return d[0] * d[1] * d[2];
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
  const Real spacing = (high - low) / std::max(1.0, count);
  const bool fills = !set.count && set.within == none && set.random->fisher_kappa > 10;
  return {normal, count, spacing, box_volume(region.box), fills, 2 * spacing};
}

// Only so many in the rock's box that no shape of the rock makes them bearable, and placing them would take long; the
// cutter looks closer.
void refuse_absurd_cells(const Model& model, const RockBounds& rock,
                         const std::vector<PlaneSet>& sets) {
  constexpr Real absurd = 1e4;
  const Extent box = bounding_box(rock.corners);
  const Real cells = estimate_cells(sets, box_volume(box), diagonal(box)).about;
  if (cells > absurd * static_cast<Real>(std::max(model.cut.max_cells, CutSpec{}.max_cells)))
    refuse_cell_count(model, about_cells(cells));
}

void place_sets(const Model& model, const RockBounds& rock, PlacedJoints& placed) {
  const std::size_t count = model.joint_sets.size();
  std::vector<PlacingRegion> regions;
  std::vector<std::vector<DrawnJoint>> drawn(count);
  for (std::size_t s = 0; s < count; ++s) {
    const JointSet& set = model.joint_sets[s];
    regions.push_back(placing_region(rock, set.within));
    if (set.random) {
      drawn[s] = draw_joints(set, regions[s].corners, set_key(s));
      if (!set.radius && !set.random->radius)
        placed.plane_sets.push_back(drawn_planes(set, drawn[s], regions[s]));
      continue;
    }
    const Real planes = checked_count(set, regions[s], set_key(s));
    if (!set.radius)
      placed.plane_sets.push_back({normalized(normal_of(set.orientation)), planes, set.spacing,
                                   box_volume(regions[s].box), !set.count && set.within == none,
                                   set.spacing});
  }
  refuse_absurd_cells(model, rock, placed.plane_sets);
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
  for (const JointMesh& mesh : model.joint_meshes) place_mesh(mesh, rock, placed);
  for (std::size_t t = 0; t < model.joint_tables.size(); ++t)
    place_table(model.joint_tables[t], model.joint_materials, rock,
                fmt::format("joint_table[{}]", t + 1), placed);
  return placed;
}

}  // namespace rockfold
