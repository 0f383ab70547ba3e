#include "host/keyblock/motions/pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// A bound for the rounding of n·(a × b) with unit vectors, for pairs so close that a × b is itself
/// tiny.
constexpr Real triple_product_rounding = 1e-15;

/// Whether c (of any length) is in the cone. The normal that refuses it moves to the front: it is
/// the likeliest to refuse the next one too. The answer does not depend on the order.
bool contains(std::vector<Vec3>& normals, const Vec3& c) {
  const Real limit = direction_tolerance * norm(c) + triple_product_rounding;
  for (auto& n : normals) {
    if (dot(n, c) <= limit) continue;
    std::swap(n, normals.front());
    return false;
  }
  return true;
}

Vec3 any_perpendicular(const Vec3& n) {
  Vec3 axis{};
  const auto smallest = std::min_element(n.begin(), n.end(),
                                         [](Real a, Real b) { return std::abs(a) < std::abs(b); });
  axis[static_cast<std::size_t>(smallest - n.begin())] = 1;
  return normalized(cross(n, axis));
}

void add_direction(std::vector<Vec3>& directions, const Vec3& u) {
  const bool known = std::any_of(directions.begin(), directions.end(), [&](const Vec3& d) {
    return norm(d - u) <= 2 * direction_tolerance;
  });
  if (!known) directions.push_back(u);
}

/// Every edge of the cone once.
std::vector<Vec3> edges_of(std::span<const Vec3> normals) {
  std::vector<Vec3> tested(normals.begin(), normals.end());
  std::vector<Vec3> edges;
  for (std::size_t i = 0; i < normals.size(); ++i)
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Vec3 edge = cross(normals[i], normals[j]);
      if (norm(edge) <= direction_tolerance) continue;
      if (contains(tested, edge)) add_direction(edges, normalized(edge));
      if (contains(tested, -edge)) add_direction(edges, normalized(-edge));
    }
  return edges;
}

/// Angles of vectors about an axis, ascending.
std::vector<Real> angles_about(const Vec3& axis, std::span<const Vec3> vectors) {
  const Vec3 e = any_perpendicular(axis), f = cross(axis, e);
  std::vector<Real> angles;
  for (const Vec3& v : vectors) angles.push_back(std::atan2(dot(v, f), dot(v, e)));
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// Of a wedge whose faces have these normals, all perpendicular to its line: twice the angle between
/// the faces, which is π less the arc that the normals take.
Real wedge_solid_angle(const Vec3& line, std::span<const Vec3> normals) {
  const auto angles = angles_about(line, normals);
  Real gap = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return std::max(0.0, 2 * (gap - std::numbers::pi));
}

/// van Oosterom & Strackee (1983).
Real triangle_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(std::abs(dot(a, cross(b, c))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// Edges of a pointed cone in the order in which its faces join them.
void sort_around(std::vector<Vec3>& edges) {
  Vec3 middle{};
  for (const Vec3& u : edges) middle += u;
  middle = normalized(middle);
  const Vec3 e = any_perpendicular(middle), f = cross(middle, e);
  const auto angle = [&](const Vec3& v) { return std::atan2(dot(v, f), dot(v, e)); };
  std::sort(edges.begin(), edges.end(),
            [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
}

}  // namespace

RemovableSpace removable_space(std::span<const Vec3> normals) {
  constexpr Real pi = std::numbers::pi;
  if (normals.empty()) return {{}, 4 * pi};
  const auto sense = [&](const Vec3& n) { return dot(n, normals.front()); };
  const bool parallel = std::all_of(normals.begin(), normals.end(), [&](const Vec3& n) {
    return norm(cross(n, normals.front())) <= direction_tolerance;
  });
  if (parallel) {
    const bool one_side =
        std::all_of(normals.begin(), normals.end(), [&](const Vec3& n) { return sense(n) > 0; });
    return {{}, one_side ? 2 * pi : 0};
  }
  RemovableSpace space{edges_of(normals), 0};
  auto& edges = space.edges;
  if (edges.size() < 2) return space;
  if (edges.size() == 2) {
    if (norm(edges[0] + edges[1]) <= 2 * direction_tolerance)
      space.solid_angle = wedge_solid_angle(edges[0], normals);
    return space;
  }
  sort_around(edges);
  for (std::size_t i = 2; i < edges.size(); ++i)
    space.solid_angle += triangle_solid_angle(edges[0], edges[i - 1], edges[i]);
  return space;
}

std::optional<Vec3> removable_direction(std::span<const Vec3> normals) {
  if (normals.empty()) return Vec3{0, 0, 1};
  std::vector<Vec3> tested(normals.begin(), normals.end());
  bool all_parallel = true;
  // A cone that is not the origin alone holds an edge, where two of its planes meet; if it has no
  // edge, its planes are all parallel and it holds what is parallel to them.
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      const Vec3 edge = cross(normals[i], normals[j]);
      if (norm(edge) <= direction_tolerance) continue;
      all_parallel = false;
      if (contains(tested, edge)) return normalized(edge);
      if (contains(tested, -edge)) return normalized(-edge);
    }
  }
  if (all_parallel) return any_perpendicular(normals.front());
  return std::nullopt;
}

std::vector<Vec3> joint_pyramid(std::span<const Vec3> upward, std::string_view code) {
  if (code.size() != upward.size())
    throw std::invalid_argument("joint pyramid code '" + std::string(code) + "' has " +
                                std::to_string(code.size()) + " digits, expected one for each of " +
                                std::to_string(upward.size()) + " joints");
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (code[i] < '0' || code[i] > '3')
      throw std::invalid_argument("joint pyramid code '" + std::string(code) +
                                  "': digits are 0, 1, 2 or 3");
    if (code[i] == '0' || code[i] == '3') normals.push_back(-upward[i]);
    if (code[i] == '1' || code[i] == '3') normals.push_back(upward[i]);
  }
  return normals;
}

bool is_removable(std::span<const Vec3> joints, std::span<const Vec3> excavation) {
  if (!removable_direction(joints)) return false;
  std::vector<Vec3> block_pyramid(joints.begin(), joints.end());
  block_pyramid.insert(block_pyramid.end(), excavation.begin(), excavation.end());
  return !removable_direction(block_pyramid);
}

}  // namespace rockfold
