// The blocks that the cutting made, as flat arrays rounded to double: what block theory, reports and result
// files read. Written by host/flatten only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Where a face of a block comes from.
struct FaceOrigin {
  enum class Kind : std::uint8_t { joint, solid_face, excavation };
  Kind kind = Kind::joint;
  /// "J1" for a joint or joint set, "rock.zmin" for a face of a solid, "tunnel.3" for one of an excavation,
  /// "lining.interface" for the joint around a solid with an interface; "layer.xmin, rock.xmin" where a free face
  /// lies on the surfaces of both
  std::string name;
  Index joint_material = none;  ///< into Model::joint_materials; joints only
  Index solid = none;       ///< into Model::solids (solid_face) or Model::excavations (excavation)
  Index solid_face = none;  ///< into face_names(shape)
  bool continues = false;   ///< the rock goes on beyond: neither free nor removable
  struct ShapeFace {
    Index owner = none, face = none;  ///< as solid and solid_face
  };
  std::vector<ShapeFace> also = {};  ///< faces of other solids on whose surfaces it lies as well

  /// Whether both name the same face of the same shape first: areas of such origins are one face of a block.
  bool is_one_face_with(const FaceOrigin& other) const {
    return kind != Kind::joint && kind == other.kind && solid == other.solid &&
           solid_face == other.solid_face;
  }
  /// Which face of a shape it lies on, none where it does not lie on that shape's surface.
  Index face_of(Kind shape, Index owner) const {
    if (kind != shape) return none;
    if (solid == owner) return solid_face;
    const auto other = std::find_if(also.begin(), also.end(),
                                    [&](const ShapeFace& f) { return f.owner == owner; });
    return other == also.end() ? none : other->face;
  }
  /// Whether it lies on one of these faces of a shape.
  bool lies_on(Kind shape, Index owner, const std::vector<Index>& faces) const {
    const Index face = face_of(shape, owner);
    return face != none && std::find(faces.begin(), faces.end(), face) != faces.end();
  }
};

/// B blocks with F faces, L loops, C loop corners and V vertices; I interfaces.
///
/// Faces are maximal connected coplanar polygons of one origin (a joint, or the solid that was added or taken away there last; where others share a
/// part of it, the face has the names of the part with the most); loop 0 of a face is its outer boundary, the
/// others are holes. Corners run counter-clockwise seen from outside the block (holes clockwise).
/// Example: a unit cube cut by nothing: B = 1, F = 6, L = 6, C = 24, V = 8, I = 0,
/// face_begin = {0, 6}, loop_begin = {0, 1, …, 6}, corner_begin = {0, 4, …, 24}.
/// Blocks are ordered by centroid (z, then y, then x, ascending); id in reports = index + 1.
struct BlockArrays {
  // blocks
  std::vector<Index> face_begin;     ///< [B+1]
  std::vector<Index> vertex_begin;   ///< [B+1] each block has vertices of its own
  std::vector<Real> volume;          ///< [B] m³
  std::vector<Real> mass;            ///< [B] kg, of all its materials
  std::vector<Vec3> centroid;        ///< [B] m
  std::vector<Index> edge_count;     ///< [B]
  std::vector<Index> shell_count;    ///< [B] boundary components: 1 + cavities
  std::vector<Index> genus;          ///< [B] summed over shells
  std::vector<std::uint8_t> convex;  ///< [B]
  std::vector<std::uint8_t> finite;  ///< [B] touches no `continues` face
  std::vector<Index> material;       ///< [B] into Model::materials (of the largest part)
  std::vector<Index> stage;          ///< [B] at which it is excavated; 0 = it stays
  std::vector<Real> dead_end_area;   ///< [B] m², joints that end inside it, each counted once

  // faces
  std::vector<Index> loop_begin;   ///< [F+1]
  std::vector<Vec3> face_normal;   ///< [F] unit, outward
  std::vector<Real> face_area;     ///< [F] m²
  std::vector<Index> face_origin;  ///< [F] into origins
  std::vector<std::uint8_t>
      face_up;  ///< [F] 1 if the outward normal is the plane's own (canonical) normal
  std::vector<Index> face_plane;  ///< [F] id of the plane; equal ids = one plane of the cutting

  // loops and vertices
  std::vector<Index> corner_begin;   ///< [L+1]
  std::vector<Index> corner_vertex;  ///< [C] < V
  std::vector<Vec3> vertex;          ///< [V] m

  // dead-end joints: convex polygons with one block on both sides, no part of its faces; D of them, E corners
  std::vector<Index> dead_end_block;         ///< [D]
  std::vector<Index> dead_end_origin;        ///< [D] into origins
  std::vector<Index> dead_end_corner_begin;  ///< [D+1]
  std::vector<Vec3> dead_end_vertex;         ///< [E] m

  /// Two faces of two blocks that share an area of one joint, or of an excavation's boundary: then the block of the later
  /// stage (0 = never removed is the latest) has a free face there from the earlier one's stage on.
  struct Interface {
    Index block[2] = {none, none};  ///< block[0] < block[1]
    Index face[2] = {none, none};   ///< face of each, global face index
    Real area = 0;                  ///< m²
  };
  std::vector<Interface> interfaces;  ///< [I] ordered by block[0], face[0], block[1]

  std::vector<FaceOrigin> origins;

  Index vertices_identified =
      0;  ///< corners that were made one with another nearer than 1e-9 of the model's size

  Index block_count() const { return static_cast<Index>(volume.size()); }
};

}  // namespace rockfold
