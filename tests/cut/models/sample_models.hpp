// Small models built in code, and what the cutting makes of them.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "host/cut/cells/complex.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "src/model/model.hpp"

namespace rockfold::test {

inline Solid box_solid(std::string name, const Vec3& min, const Vec3& max, bool add = true) {
  Solid solid;
  solid.name = std::move(name);
  solid.add = add;
  solid.shape = BoxShape{min, max};
  solid.continues.assign(6, false);
  return solid;
}

inline Model box_model(const Vec3& min, const Vec3& max) {
  Model model;
  model.solids.push_back(box_solid("rock", min, max));
  return model;
}

/// A solid bounded by planes whose given normals point out of it.
inline Solid convex_solid(std::string name,
                          const std::vector<std::pair<Vec3, Vec3>>& normals_and_points) {
  Solid solid;
  solid.name = std::move(name);
  HalfspacesShape shape;
  for (const auto& [normal, point] : normals_and_points)
    shape.planes.push_back({GivenPlane{normal, point}, false});
  solid.continues.assign(shape.planes.size(), false);
  solid.shape = std::move(shape);
  return solid;
}

/// A through-going joint, named F1, F2, … in the order of the calls.
inline void add_joint(Model& model, const Orientation& orientation, const Vec3& point) {
  Joint joint;
  joint.name = std::string("F").append(std::to_string(model.joints.size() + 1));
  joint.plane = {orientation, point};
  model.joints.push_back(std::move(joint));
}

/// A joint set, named J1, J2, ….
inline void add_set(Model& model, const Orientation& orientation, Real spacing, const Vec3& origin,
                    std::optional<Index> count = {}) {
  JointSet set;
  set.name = std::string("J").append(std::to_string(model.joint_sets.size() + 1));
  set.orientation = orientation;
  set.spacing = spacing;
  set.origin = origin;
  set.count = count;
  model.joint_sets.push_back(std::move(set));
}

struct Blocks {
  Cutting cutting;
  BlockArrays arrays;

  const Complex& complex() const { return *cutting.complex; }
};

inline Blocks cut(const Model& model) {
  Progress silent;
  Blocks blocks;
  blocks.cutting = cut_blocks(model, silent);
  blocks.arrays = flatten_blocks(blocks.cutting, model);
  return blocks;
}

inline Index face_count(const BlockArrays& a, Index block) {
  return a.face_begin[block + 1] - a.face_begin[block];
}
inline Index vertex_count(const BlockArrays& a, Index block) {
  return a.vertex_begin[block + 1] - a.vertex_begin[block];
}

/// Vertices, edges and faces summed over all blocks: "sumVEF" of the plane cases.
struct Counts {
  Index vertices = 0, edges = 0, faces = 0;
  bool operator==(const Counts&) const = default;
};
inline Counts counts_of(const BlockArrays& a, Index block) {
  return {vertex_count(a, block), a.edge_count[block], face_count(a, block)};
}
inline Counts sum_of_counts(const BlockArrays& a) {
  Counts sum;
  for (Index b = 0; b < a.block_count(); ++b) {
    const Counts c = counts_of(a, b);
    sum = {sum.vertices + c.vertices, sum.edges + c.edges, sum.faces + c.faces};
  }
  return sum;
}
inline std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << "V " << c.vertices << " E " << c.edges << " F " << c.faces;
}

inline Real sum(const std::vector<Real>& values) {
  long double total = 0;
  for (const Real v : values) total += v;
  return static_cast<Real>(total);
}

inline Real surface_area(const BlockArrays& a, Index block) {
  Real area = 0;
  for (Index f = a.face_begin[block]; f < a.face_begin[block + 1]; ++f) area += a.face_area[f];
  return area;
}

}  // namespace rockfold::test
