#include "src/model/prism_base.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// Relative to the base's size; ten times the tolerance by which the cutter takes planes for one.
constexpr Real tolerance = 1e-9;

Real largest_distance(const std::vector<Vec3>& base) {
  Real size = 0;
  for (const auto& p : base) size = std::max(size, norm(p - base[0]));
  return size;
}

/// Twice the vector area (Newell's method), about the first point so that nothing cancels far from
/// the origin.
Vec3 doubled_area(const std::vector<Vec3>& base) {
  Vec3 area{};
  for (std::size_t i = 1; i + 1 < base.size(); ++i)
    area += cross(base[i] - base[0], base[i + 1] - base[0]);
  return area;
}

std::string points(std::size_t i, std::size_t j) {
  return "points " + std::to_string(i + 1) + " and " + std::to_string(j + 1);
}

std::string equal_neighbours(const std::vector<Vec3>& base, Real size) {
  for (std::size_t i = 0; i < base.size(); ++i) {
    const std::size_t j = (i + 1) % base.size();
    if (norm(base[j] - base[i]) > tolerance * size) continue;
    return points(i, j) + " are equal" + (j == 0 ? "; the last edge closes by itself" : "");
  }
  return "";
}

/// Coordinates far from the origin are themselves rounded by more than 1e-9 of a small base's size.
std::string off_plane(const std::vector<Vec3>& base, const Vec3& normal, Real size) {
  Real farthest = 0;
  for (const auto& p : base) farthest = std::max(farthest, norm(p));
  const Real off = tolerance * size + 4 * std::numeric_limits<Real>::epsilon() * farthest;
  for (std::size_t i = 0; i < base.size(); ++i)
    if (std::abs(dot(normal, base[i] - base[0])) > off)
      return "point " + std::to_string(i + 1) + " is not in one plane with the others";
  return "";
}

/// All corners turn the same way, once around.
std::string not_convex(const std::vector<Vec3>& base, const Vec3& normal) {
  Real turned = 0;
  bool concave = false;
  for (std::size_t i = 0; i < base.size(); ++i) {
    const std::size_t j = (i + 1) % base.size(), k = (i + 2) % base.size();
    const Vec3 in = normalized(base[j] - base[i]), out = normalized(base[k] - base[j]);
    const Real sine = dot(normal, cross(in, out));
    if (std::abs(sine) <= tolerance)
      return "points " + std::to_string(i + 1) + ", " + std::to_string(j + 1) + " and " +
             std::to_string(k + 1) + " are collinear; leave one out";
    concave = concave || sine < 0;
    turned += std::atan2(sine, dot(in, out));
  }
  if (concave) return "a concave base is not supported yet; use several convex prisms";
  return turned > 3 * std::numbers::pi ? "the edges cross each other" : "";
}

}  // namespace

std::string base_problem(const std::vector<Vec3>& base) {
  const Real size = largest_distance(base);
  if (size == 0) return "all points are equal";
  if (auto problem = equal_neighbours(base, size); !problem.empty()) return problem;
  const Vec3 area = doubled_area(base);
  if (norm(area) <= tolerance * size * size)
    return "encloses no area: its points are collinear or its edges cross";
  const Vec3 normal = normalized(area);
  if (auto problem = off_plane(base, normal, size); !problem.empty()) return problem;
  return not_convex(base, normal);
}

bool leaves_plane(const std::vector<Vec3>& base, const Vec3& extrude) {
  const Real length = norm(extrude);
  return std::abs(dot(normalized(doubled_area(base)), extrude)) > tolerance * length;
}

}  // namespace rockfold
