// The faces that a [[joint_mesh]] makes on a block, as the planes that they are in block theory.
// docs/block_theory.md, "Joints from meshes".
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

class MeshPlanes {
 public:
  MeshPlanes(const BlockArrays& blocks, const Model& model);

  /// deg: of the joint mesh that a face is a facet of; none of other faces.
  std::optional<Real> flatness(Index face) const {
    return flatness_[at(blocks_.face_origin[at(face)])];
  }
  /// Whether any facet may be part of a plane other than its own.
  bool any() const { return !normal_.empty(); }

  /// Unit, outward, of the plane that a face is part of on its own block: its own normal where it is no facet.
  const Vec3& normal(Index face) const {
    return any() ? normal_[at(face)] : blocks_.face_normal[at(face)];
  }
  /// [faces] likewise on a body of several blocks; `area` (m²): of each face, without what lies inside the body.
  std::vector<Vec3> normals(std::span<const Index> faces, std::span<const Real> area) const;

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  const BlockArrays& blocks_;
  std::vector<std::optional<Real>> flatness_;  ///< [origins]
  std::vector<Vec3> normal_;                   ///< [F]; empty: every face has its own
};

}  // namespace rockfold
