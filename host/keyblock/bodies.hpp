// Blocks, alone or several as one rigid body, as block theory sees them: faces, loads, interfaces.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/keyblock/face_interfaces.hpp"
#include "host/keyblock/face_shape.hpp"
#include "host/keyblock/mesh_planes.hpp"
#include "host/keyblock/motions/single_block.hpp"
#include "host/keyblock/surface_loads.hpp"
#include "host/keyblock/water/outline.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/face_tractions.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Some blocks as one body, with the faces between them left out.
struct RockBody {
  std::vector<Index> members;    ///< blocks, ascending
  std::vector<BlockFace> faces;  ///< not those without any area left
  std::vector<Index> face_id;    ///< [faces] into the arrays
  Real volume = 0;               ///< m³
  Real mass = 0;                 ///< kg
  Vec3 centroid{};               ///< m, of the mass
  Vec3 load{};                   ///< N: weight, earthquake, point loads, tractions
  Vec3 moment{};                 ///< N m about the centroid: point loads, tractions, water
  bool finite = true;
};

/// The joints that a body leans on, as its water finds them.
struct JointOutlines {
  std::vector<Index> of_face;  ///< [faces of the body] into outline; none of those that are free
  std::vector<JointOutline> outline;
};

class Bodies {
 public:
  /// Throws Error(model) for a point load that is not in the rock, and a traction that is on no free face.
  /// `tractions`: in-situ stress as it is round openings; null: that far from them.
  Bodies(const BlockArrays& blocks, const Model& model, const FaceTractions* tractions = nullptr);
  /// With another support section and other water than the model's; `waters` must live as long.
  Bodies(const BlockArrays& blocks, const Model& model, const SupportSpec& spec,
         const std::vector<Water>& waters, const FaceTractions* tractions = nullptr);

  /// A stage is excavated: from now on in-situ stress is that round its openings.
  bool stress_follows_openings() const { return in_situ_ != nullptr; }
  void excavate(Index stage) {
    if (in_situ_) traction_ = &in_situ_->after(stage);
  }

  /// `batch`: of every block; those that are 0 are still there.
  RockBody body(std::vector<Index> members, const std::vector<Index>& batch) const;
  /// Its class and motion.
  BlockVerdict judge(const RockBody& body, const std::vector<Index>& batch) const;

  /// Whether any joint has less than its whole strength once it has slipped.
  bool loses_strength() const { return loses_strength_; }
  /// The body on joints that have slipped: with their residual friction and cohesion.
  RockBody with_residual_strength(RockBody body) const;

  /// Its planes of contact with rock that is still there; none where no polygon is known.
  std::vector<ContactPatch> patches(const RockBody& body, const std::vector<Index>& batch) const;

  /// Outlines of joints: of one face, or of all facets of a mesh and faces of several blocks that lie in one plane and meet. They drain
  /// at the body's free faces, without those that water stands before, and without the two ends of a slice: upright faces of one
  /// solid that look away from each other.
  JointOutlines joint_outlines(const RockBody& body) const;

  /// [faces of the body] Linear functions whose least, no less than zero, is the pressure of the water in their joints, Pa; none: dry.
  std::vector<std::vector<LinearPressure>> water_in_joints(const RockBody& body) const;

  const BlockArrays& blocks() const { return blocks_; }
  /// Whether every face of a block leans on a block that is still there.
  bool is_encased(Index block, const std::vector<Index>& batch) const;
  bool looks_at_rotation() const { return spec_.rotation && has_polygons_; }
  const FaceInterfaces& interfaces() const { return interfaces_; }
  const MeshPlanes& mesh_planes() const { return mesh_planes_; }
  const FaceOrigin& origin(Index face) const {
    return blocks_
        .origins[static_cast<std::size_t>(blocks_.face_origin[static_cast<std::size_t>(face)])];
  }
  /// Area-weighted centre of the free faces; the body's centroid where no polygon is known.
  Vec3 free_centre(const RockBody& body) const;
  /// kg m² about its centroid.
  Mat3 inertia(const RockBody& body) const;

 private:
  /// What all faces of one origin have in common.
  struct FaceNature {
    Real friction = 0;  ///< tan φ
    Real cohesion = 0;  ///< Pa
    Real residual_friction = 0, residual_cohesion = 0;
    Real normal_stiffness = 0;  ///< Pa/m
    Real shear_stiffness = 0;   ///< Pa/m
    bool continues = false;     ///< or held by a [[fixed]]
    const Water* water = nullptr;
  };
  struct PointForce {
    Index block;
    Vec3 point, force;
  };

  FaceNature nature(const FaceOrigin& origin, const Model& model,
                    const std::vector<Water>& waters) const;
  void add_block(RockBody& body, Index block, const std::vector<Index>& batch) const;
  void flatten_meshes(RockBody& body) const;
  void add_point_loads(RockBody& body) const;
  void add_traction(RockBody& body, Index face, Real share) const;
  bool is_one_plane(const RockBody& body, std::size_t f, std::size_t g) const;
  bool may_drain(const RockBody& body) const;
  bool is_free_side(const RockBody& body, std::size_t face) const;
  bool is_end_of_slice(const RockBody& body, std::size_t face) const;
  Outlets outlets(const RockBody& body) const;
  void add_outlines(const RockBody& body, const std::vector<std::size_t>& faces,
                    const Outlets& outlets, JointOutlines& outlines) const;
  /// Linear functions whose least is the pressure; empty where water does not drain.
  using Pressures = std::vector<LinearPressure>;
  void press_faces(RockBody& body) const;
  void press(BlockFace& face, Index id, const Pressures& drained, RockBody& body) const;
  LinearPressure undrained(const FaceNature& nature) const;
  PressureForce water_on(Index face, const FaceNature& nature, const Pressures& drained) const;
  void press_in_situ(BlockFace& face, Index id, const FaceNature& nature) const;
  void press_by_water(BlockFace& face, Index id, const FaceNature& nature, const Pressures& drained,
                      RockBody& body) const;

  const BlockArrays& blocks_;
  Vec3 gravity_;
  SupportSpec spec_;
  InitialStress stress_;
  const FaceTractions* in_situ_;
  const std::vector<Vec3>* traction_ = nullptr;  ///< [F] Pa of in_situ_, at this stage
  FaceInterfaces interfaces_;
  MeshPlanes mesh_planes_;
  std::vector<FaceNature> nature_;  ///< [origins]
  std::vector<PointForce> forces_;  ///< ordered by block
  SurfaceLoads tractions_;
  bool has_polygons_;
  bool loses_strength_ = false;
};

/// The block that holds a point, or none: the first of those with the largest winding number.
Index block_at(const BlockArrays& blocks, const Vec3& point);

}  // namespace rockfold
