// A cube whose joints are held together by contact points.
#pragma once

#include <array>
#include <functional>

#include "tests/solve/systems/joints.hpp"

namespace rockfold {

struct JointedCube {
  SmallSystem system;
  MaterialPoints points;
  std::vector<Mat3> tangent;
};

/// The two covers of each node of a joint, or twice the one.
inline std::vector<std::array<Index, 2>> sides_of_nodes(const CoverArrays& a) {
  std::vector<std::array<Index, 2>> sides(a.cover_node.back() + 1, {none, none});
  for (Index p = 0; p < a.cover_count(); ++p) {
    auto& of_node = sides[a.cover_node[p]];
    if (of_node[0] == none) of_node[0] = p;
    of_node[1] = p;
  }
  return sides;
}

/// The stiffness, N/m, of a contact point in the cell (i, j) of a joint, along the normal and across it.
using Law = std::function<std::array<Real, 2>(Index i, Index j)>;

/// A cube of side 1 cut at one and two thirds of its height; two by two points in each cell of a joint.
inline JointedCube jointed_cube(Index n, int order, LatticeKind kind, const Law& law) {
  const auto on_joint = [n](Index k) { return k == n / 3 || k == 2 * n / 3; };
  JointedCube cube;
  cube.system = held_cube(
      n, [&](Index, Index, Index k) { return on_joint(k); }, kind);
  cube.system.covered.arrays.order = order;
  const CoverArrays& a = cube.system.covers();
  const auto sides = sides_of_nodes(a);
  for (Index k = 1; k < n; ++k)
    for (Index c = 0; on_joint(k) && c < 4 * n * n; ++c) {
      const Index i = c / 4 % n, j = c / 4 / n;
      const Real s[2] = {c % 2 == 0 ? 0.25 : 0.75, c / 2 % 2 == 0 ? 0.2 : 0.7};
      for (int corner = 0; corner < 4; ++corner) {
        const int right = corner % 2, back = corner / 2;
        const Real w = (right ? s[0] : 1 - s[0]) * (back ? s[1] : 1 - s[1]);
        for (int side = 0; side < 2; ++side) {
          cube.points.unknown.push_back(
              sides[i + right + (n + 1) * (j + back + (n + 1) * k)][side]);
          cube.points.weight.push_back(side == 0 ? -w : w);
        }
      }
      cube.points.element.push_back(none);
      cube.points.begin.push_back(static_cast<Index>(cube.points.unknown.size()));
      const auto [normal, shear] = law(i, j);
      cube.tangent.push_back({{{shear, 0, 0}, {0, shear, 0}, {0, 0, normal}}});
    }
  return cube;
}

/// Joints as stiff as rock of 1/`stiffness` of a cube's height, E being 1e6 Pa.
inline Law closed(Index n, Real stiffness) {
  const Real k = 1e6 * stiffness / (4.0 * n * n);
  return [k](Index, Index) { return std::array<Real, 2>{k, 0.5 * k}; };
}
/// A third is open, a third slides.
inline Law partly_open(Index n, Real stiffness) {
  const Real k = 1e6 * stiffness / (4.0 * n * n);
  return [n, k](Index i, Index) {
    return std::array<Real, 2>{3 * i < n ? 0 : k, 3 * i < 2 * n ? 0 : 0.5 * k};
  };
}

}  // namespace rockfold
