#include "src/report/drawings/joint_pyramids.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "host/keyblock/motions/pyramid.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real rounding = 1e-9;
constexpr Real arc_step = std::numbers::pi / 90;

/// {u : u·n ≤ 0 for all}: the corners of its spherical polygon.
std::vector<Vec3> corners_of(const std::vector<Vec3>& normals) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Vec3 line = cross(normals[i], normals[j]);
      if (norm(line) < rounding) continue;
      for (const Real sign : {1.0, -1.0}) {
        const Vec3 u = (sign / norm(line)) * line;
        const bool inside = std::all_of(normals.begin(), normals.end(),
                                        [&](const Vec3& n) { return dot(n, u) <= rounding; });
        const bool known = std::any_of(corners.begin(), corners.end(),
                                       [&](const Vec3& c) { return norm(c - u) < 1e-7; });
        if (inside && !known) corners.push_back(u);
      }
    }
  return corners;
}

/// The direction that is farthest inside: by halving steps from a start inside.
Vec3 middle_of(const std::vector<Vec3>& normals, const std::vector<Vec3>& corners) {
  const auto depth = [&](const Vec3& u) {
    Real least = 1;
    for (const Vec3& n : normals) least = std::min(least, -dot(n, u));
    return least;
  };
  // The mean of the corners is inside; of two opposite corners (a lune) the planes through them say where.
  Vec3 best{};
  for (const Vec3& c : corners) best += c;
  if (norm(best) < 1e-6) {
    best = {};
    for (const Vec3& n : normals)
      if (corners.empty() || std::abs(dot(n, corners.front())) < 1e-7) best -= n;
  }
  best = normalized(best);
  for (Real step = 0.5; step > 1e-5; step *= 0.5)
    for (int turn = 0; turn < 40; ++turn) {
      Vec3 next = best;
      for (int d = 0; d < 3; ++d)
        for (const Real sign : {1.0, -1.0}) {
          Vec3 trial = best;
          trial[d] += sign * step;
          trial = normalized(trial);
          if (depth(trial) > depth(next)) next = trial;
        }
      if (next == best) break;
      best = next;
    }
  return best;
}

/// From a to b along a plane that bounds the cone: a quarter turn on from a, and the angle. Going round counter-clockwise
/// the cone is on the left.
std::optional<std::pair<Vec3, Real>> boundary_arc(const Vec3& a, const Vec3& b,
                                                  const std::vector<Vec3>& normals) {
  for (const Vec3& n : normals) {
    if (std::abs(dot(n, a)) > 1e-7 || std::abs(dot(n, b)) > 1e-7) continue;
    const Vec3 across = cross(a, n);
    Real span = std::atan2(dot(b, across), dot(b, a));
    if (span <= 0) span += 2 * std::numbers::pi;
    const Vec3 halfway = std::cos(span / 2) * a + std::sin(span / 2) * across;
    if (std::all_of(normals.begin(), normals.end(),
                    [&](const Vec3& m) { return dot(m, halfway) <= 1e-7; }))
      return std::pair{across, span};
  }
  return {};
}

/// The corners in order around the middle, joined by arcs of the planes between them.
std::vector<Vec3> boundary_of(std::vector<Vec3> corners, const std::vector<Vec3>& normals,
                              const Vec3& middle) {
  if (corners.size() < 2) return {};
  const Vec3 e =
      normalized(cross(middle, std::abs(middle[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  const Vec3 f = cross(middle, e);
  const auto angle = [&](const Vec3& u) { return std::atan2(dot(u, f), dot(u, e)); };
  std::sort(corners.begin(), corners.end(),
            [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
  std::vector<Vec3> boundary;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const auto arc = boundary_arc(a, b, normals);
    if (!arc) return {};
    const auto& [across, span] = *arc;
    const int pieces = std::max(1, static_cast<int>(std::ceil(span / arc_step)));
    for (int k = 0; k < pieces; ++k) {
      const Real t = span * k / pieces;
      boundary.push_back(std::cos(t) * a + std::sin(t) * across);
    }
  }
  return boundary;
}

bool removable(const std::vector<Vec3>& normals, const std::vector<Vec3>& free, const Vec3& axis) {
  if (norm(axis) > 0) {
    const auto holds = [&](const Vec3& u) {
      return std::all_of(normals.begin(), normals.end(),
                         [&](const Vec3& n) { return dot(n, u) <= rounding; });
    };
    return !holds(axis) && !holds(-axis);
  }
  return std::any_of(free.begin(), free.end(), [&](const Vec3& into_opening) {
    const std::vector<Vec3> excavation{into_opening};
    return is_removable(normals, excavation);
  });
}

}  // namespace

std::vector<PyramidRegion> joint_pyramid_regions(const std::vector<Vec3>& upward,
                                                 const std::vector<Vec3>& free, const Vec3& axis) {
  std::vector<PyramidRegion> regions;
  const std::size_t n = upward.size();
  for (std::size_t mask = 0; mask < std::size_t{1} << n; ++mask) {
    PyramidRegion region;
    for (std::size_t i = 0; i < n; ++i) region.code += mask >> (n - 1 - i) & 1 ? '1' : '0';
    const std::vector<Vec3> normals = joint_pyramid(upward, region.code);
    const std::vector<Vec3> corners = corners_of(normals);
    region.middle = middle_of(normals, corners);
    const bool empty = std::any_of(normals.begin(), normals.end(),
                                   [&](const Vec3& m) { return dot(m, region.middle) > -1e-6; });
    if (empty) continue;
    region.boundary = boundary_of(corners, normals, region.middle);
    region.removable = removable(normals, free, axis);
    regions.push_back(std::move(region));
  }
  return regions;
}

}  // namespace rockfold
