// A cube cut by three inclined joint sets: the model, and its planes for other splitters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "host/exact/orientation.hpp"
#include "perf/shared/plain_splitter.hpp"
#include "src/model/model.hpp"

namespace rockfold {

constexpr Real cube_edge = 10;  // m

// Spacings that make about as many blocks as asked for.
inline Model three_sets(std::int64_t blocks) {
  const Real spacing = 0.94 * cube_edge / std::cbrt(static_cast<Real>(blocks));
  Model model;
  Solid rock;
  rock.name = "rock";
  rock.shape = BoxShape{{0, 0, 0}, {cube_edge, cube_edge, cube_edge}};
  rock.continues.assign(6, false);
  model.solids.push_back(rock);
  const auto add = [&](Real dip, Real direction, Real apart) {
    JointSet set;
    set.orientation = DipOrientation{dip, direction};
    set.spacing = apart;
    set.origin = {0.01, 0.02, 0.03};
    model.joint_sets.push_back(set);
  };
  add(60, 90, spacing), add(70, 200, 1.1 * spacing), add(20, 320, 0.9 * spacing);
  return model;
}

// The planes of the sets in bisecting order, as host/cut takes them.
inline std::vector<PlainPlane> plain_planes(const Model& model) {
  std::vector<PlainPlane> sorted, planes;
  for (const JointSet& set : model.joint_sets) {
    const Vec3 n = normal_of(set.orientation);
    Real low = 1e300, high = -1e300;
    for (int c = 0; c < 8; ++c) {
      const Real t =
          dot(n, Vec3{c & 1 ? cube_edge : 0, c & 2 ? cube_edge : 0, c & 4 ? cube_edge : 0} -
                     set.origin) /
          set.spacing;
      low = std::min(low, t), high = std::max(high, t);
    }
    for (Real k = std::ceil(low); k <= high; ++k)
      sorted.push_back({n, dot(n, set.origin) + k * set.spacing});
  }
  unsigned bits = 0;
  while ((std::size_t{1} << bits) < sorted.size()) ++bits;
  for (unsigned i = 0; i < 1u << bits; ++i) {
    unsigned reversed = 0;
    for (unsigned b = 0; b < bits; ++b) reversed |= (i >> b & 1u) << (bits - 1 - b);
    if (reversed < sorted.size()) planes.push_back(sorted[reversed]);
  }
  return planes;
}

}  // namespace rockfold
