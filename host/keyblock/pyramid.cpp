#include "host/keyblock/pyramid.hpp"

#include <algorithm>
#include <cmath>
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

}  // namespace

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
