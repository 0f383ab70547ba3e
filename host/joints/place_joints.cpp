#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/exact/orientation.hpp"
#include "host/joints/place_joints_exact.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

Vec3 unit_normal_of(const JointSet& set) {
  return normalized(normal_of(set.orientation));
}

Real box_volume(const std::vector<Vec3>& corners) {
  Vec3 low = corners.front(), high = low;
  for (const Vec3& p : corners)
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  return (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
}

// First and last multiple of the spacing whose plane meets the solids, or `count` of them about the origin.
std::pair<Real, Real> set_range(const JointSet& set, const std::vector<Vec3>& corners) {
  if (set.count) return {-std::floor((*set.count - 1) / 2.0), std::floor(*set.count / 2.0)};
  const Vec3 normal = unit_normal_of(set);
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  for (const Vec3& p : corners) {
    const Real t = dot(normal, p - set.origin) / set.spacing;
    low = std::min(low, t);
    high = std::max(high, t);
  }
  return {
      std::ceil(low - 1e-9),
      std::floor(high + 1e-9)};  // one that just touches is identified with a face or adds nothing
}

void check_cell_count(const Model& model, const std::vector<Real>& counts, Real volume) {
  Real cells = 1;
  for (const Real n : counts) cells += n;
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (std::size_t j = i + 1; j < counts.size(); ++j)
      for (std::size_t k = j + 1; k < counts.size(); ++k) {
        const auto &a = model.joint_sets[i], &b = model.joint_sets[j], &c = model.joint_sets[k];
        const Real det =
            std::abs(dot(unit_normal_of(a), cross(unit_normal_of(b), unit_normal_of(c))));
        cells += std::min(volume * det / (a.spacing * b.spacing * c.spacing),
                          counts[i] * counts[j] * counts[k]);
      }
  if (const auto max_cells = static_cast<Real>(model.cut.max_cells); cells > max_cells)
    refuse(model.joint_sets.front().place, "joint_set",
           fmt::format("the joint sets would make about {:.2g} cells, more than {:.2g}; use larger "
                       "spacings or `count`",
                       cells, max_cells));
}

}  // namespace

PlacedJoints place_joints(const Model& model, const RockBounds& rock) {
  const std::vector<Vec3>& corners = rock.corners;
  PlacedJoints placed;
  for (const JointSet& set : model.joint_sets) placed.origins.push_back({set.name, set.material});
  for (const Joint& joint : model.joints) placed.origins.push_back({joint.name, joint.material});
  std::vector<Real> counts;
  for (std::size_t s = 0; s < model.joint_sets.size(); ++s) {
    const JointSet& set = model.joint_sets[s];
    const auto [first, last] = set_range(set, corners);
    const Real count = std::max(0.0, last - first + 1);
    counts.push_back(count);
    if (count > 1e6)
      refuse(set.place, fmt::format("joint_set[{}].{}", s + 1, set.count ? "count" : "spacing"),
             fmt::format("makes {:.3g} planes of set \"{}\"; at most 1e6 are allowed", count,
                         set.name));
  }
  check_cell_count(model, counts, box_volume(corners));
  for (std::size_t s = 0; s < model.joint_sets.size(); ++s) {
    const JointSet& set = model.joint_sets[s];
    const Vec3 normal = normal_of(set.orientation);
    // A normal computed from angles is a unit one but for rounding, which must not enter the offsets.
    const Real length = std::holds_alternative<Vec3>(set.orientation) ? norm(normal) : 1;
    const auto [first, last] = set_range(set, corners);
    for (Real k = first; k <= last; ++k)
      placed.joints.push_back({plane_through(normal, set.origin, k * set.spacing * length),
                               {},
                               static_cast<Index>(s),
                               set.within});
  }
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const GivenPlane& given = model.joints[j].plane;
    placed.joints.push_back({plane_through(normal_of(given.orientation), given.point),
                             {},
                             static_cast<Index>(model.joint_sets.size() + j),
                             model.joints[j].within});
  }
  return placed;
}

}  // namespace rockfold
