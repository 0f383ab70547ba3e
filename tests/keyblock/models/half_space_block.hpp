// Convex blocks from half-spaces in plain double, and BlockArrays made of them: a small independent
// stand-in for the cutting. For tests of a few hundred planes at most.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/base/vector.hpp"
#include "src/model/model.hpp"

namespace rockfold::test {

inline Real radians(Real degrees) {
  return degrees * std::numbers::pi / 180;
}
inline Real degrees(Real radians) {
  return radians * 180 / std::numbers::pi;
}

/// Upward unit normal of a plane: x east, y north, z up.
inline Vec3 upward(Real dip, Real dip_direction) {
  return {std::sin(radians(dip)) * std::sin(radians(dip_direction)),
          std::sin(radians(dip)) * std::cos(radians(dip_direction)), std::cos(radians(dip))};
}

/// The side n·x ≤ n·point of a plane; `origin` is into BlockArrays::origins.
struct Side {
  Vec3 normal{};  ///< unit, outward
  Vec3 point{};
  Index origin = 0;
};

inline Side above(const Vec3& upward_normal, const Vec3& point, Index origin = 0) {
  return {-upward_normal, point, origin};
}
inline Side below(const Vec3& upward_normal, const Vec3& point, Index origin = 0) {
  return {upward_normal, point, origin};
}

/// Rotation by `angle` degrees about a unit axis (Rodrigues).
inline Vec3 rotated(const Vec3& x, const Vec3& axis, Real angle) {
  const Real c = std::cos(radians(angle)), s = std::sin(radians(angle));
  return c * x + s * cross(axis, x) + ((1 - c) * dot(axis, x)) * axis;
}

inline Vec3 meeting_point(const Side& a, const Side& b, const Side& c) {
  const Vec3 bc = cross(b.normal, c.normal);
  return (1.0 / dot(a.normal, bc)) *
         (dot(a.normal, a.point) * bc + dot(b.normal, b.point) * cross(c.normal, a.normal) +
          dot(c.normal, c.point) * cross(a.normal, b.normal));
}

struct Polygon {
  Side side;
  std::vector<Vec3> corners;  ///< counter-clockwise seen from outside
  Real area = 0;
  Vec3 centroid{};
};

struct ConvexBlock {
  std::vector<Polygon> faces;  ///< sides that do not touch the block are left out
  Real volume = 0;
  Vec3 centroid{};
};

inline void measure(Polygon& face) {
  const auto& c = face.corners;
  for (std::size_t i = 1; i + 1 < c.size(); ++i) {
    const Real part = 0.5 * dot(face.side.normal, cross(c[i] - c[0], c[i + 1] - c[0]));
    face.area += part;
    face.centroid += (part / 3) * (c[0] + c[i] + c[i + 1]);
  }
  face.centroid = (1 / face.area) * face.centroid;
}

/// The intersection of the sides, which must be bounded.
inline ConvexBlock convex_block(const std::vector<Side>& sides) {
  std::vector<Vec3> vertices;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j)
      for (std::size_t k = j + 1; k < sides.size(); ++k) {
        if (std::abs(dot(sides[i].normal, cross(sides[j].normal, sides[k].normal))) < 1e-12)
          continue;
        const Vec3 x = meeting_point(sides[i], sides[j], sides[k]);
        const Real size = 1 + norm(x);
        const bool inside = std::all_of(sides.begin(), sides.end(), [&](const Side& s) {
          return dot(s.normal, x - s.point) <= 1e-9 * size;
        });
        const bool known = std::any_of(vertices.begin(), vertices.end(),
                                       [&](const Vec3& v) { return norm(v - x) <= 1e-9 * size; });
        if (inside && !known) vertices.push_back(x);
      }
  ConvexBlock block;
  Vec3 middle{};
  for (const Vec3& v : vertices) middle += (1.0 / static_cast<Real>(vertices.size())) * v;
  for (const Side& side : sides) {
    Polygon face;
    face.side = side;
    Vec3 centre{};
    for (const Vec3& v : vertices)
      if (std::abs(dot(side.normal, v - side.point)) <= 1e-8 * (1 + norm(v)))
        face.corners.push_back(v);
    if (face.corners.size() < 3) continue;
    for (const Vec3& v : face.corners) centre += (1.0 / static_cast<Real>(face.corners.size())) * v;
    const Vec3 e = normalized(face.corners[0] - centre), f = cross(side.normal, e);
    const auto angle = [&](const Vec3& v) {
      return std::atan2(dot(v - centre, f), dot(v - centre, e));
    };
    std::sort(face.corners.begin(), face.corners.end(),
              [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
    measure(face);
    const Real pyramid = dot(side.normal, face.centroid - middle) * face.area / 3;
    block.volume += pyramid;
    block.centroid += pyramid * (0.75 * face.centroid + 0.25 * middle);
    block.faces.push_back(face);
  }
  block.centroid = (1 / block.volume) * block.centroid;
  return block;
}

/// Blocks as BlockArrays; each face has vertices of its own.
class BlockArraysBuilder {
 public:
  Index origin(const FaceOrigin& origin) {
    blocks.origins.push_back(origin);
    return static_cast<Index>(blocks.origins.size()) - 1;
  }
  Index joint(const std::string& name, Index material = 0) {
    return origin({.kind = FaceOrigin::Kind::joint, .name = name, .joint_material = material});
  }
  Index solid_face(const std::string& name, Index solid_face_id = 0, bool continues = false) {
    return origin({.kind = FaceOrigin::Kind::solid_face,
                   .name = name,
                   .solid = 0,
                   .solid_face = solid_face_id,
                   .continues = continues});
  }

  /// Adds a block; its faces in joint origins wait for a partner: the face of another block in the
  /// same place.
  Index block(const ConvexBlock& block) {
    const Index id = add(block.volume, block.centroid, true);
    for (const Polygon& face : block.faces) {
      const Index f = add_face(face.side.normal, face.area, face.side.origin, face.corners);
      if (!is_joint(face.side.origin)) continue;
      for (const Waiting& other : waiting_)
        if (norm(other.centroid - face.centroid) < 1e-9 && std::abs(other.area - face.area) < 1e-9)
          touch({other.block, other.face}, {id, f}, face.area);
      waiting_.push_back({id, f, face.area, face.centroid});
    }
    finish_block();
    return id;
  }

  /// Adds the rock around: an infinite block that leans on every joint face that has no neighbour
  /// yet.
  Index rock() {
    const Index id = add(1, {}, false);
    const Index beyond = solid_face("rock.beyond", 99, true);
    add_face({0, 0, -1}, 1, beyond, {});
    const std::vector<Waiting> all = waiting_;
    for (const Waiting& face : all) {
      const bool taken = std::any_of(
          blocks.interfaces.begin(), blocks.interfaces.end(),
          [&](const auto& i) { return i.face[0] == face.face || i.face[1] == face.face; });
      if (taken) continue;
      const auto f = static_cast<std::size_t>(face.face);
      const Index mine = add_face(-blocks.face_normal[f], face.area, blocks.face_origin[f],
                                  reversed(corners(face.face)));
      touch({face.block, face.face}, {id, mine}, face.area);
    }
    finish_block();
    return id;
  }

  BlockArrays blocks;

 private:
  struct Waiting {
    Index block, face;
    Real area;
    Vec3 centroid;
  };
  struct End {
    Index block, face;
  };

  bool is_joint(Index origin) const {
    return blocks.origins[static_cast<std::size_t>(origin)].kind == FaceOrigin::Kind::joint;
  }
  Index add(Real volume, const Vec3& centroid, bool finite) {
    if (blocks.face_begin.empty())
      blocks.face_begin = blocks.vertex_begin = blocks.loop_begin = blocks.corner_begin = {0};
    blocks.face_begin.push_back(blocks.face_begin.back());
    blocks.vertex_begin.push_back(blocks.vertex_begin.back());
    blocks.volume.push_back(volume);
    blocks.mass.push_back(2000 * volume);  // the density of model_with_joints
    blocks.centroid.push_back(centroid);
    blocks.finite.push_back(finite);
    blocks.convex.push_back(1);
    blocks.material.push_back(0);
    return blocks.block_count() - 1;
  }
  std::vector<Vec3> corners(Index face) const {
    std::vector<Vec3> found;
    const auto f = static_cast<std::size_t>(face);
    for (Index c = blocks.corner_begin[f]; c < blocks.corner_begin[f + 1]; ++c)
      found.push_back(blocks.vertex[static_cast<std::size_t>(c)]);
    return found;
  }
  static std::vector<Vec3> reversed(std::vector<Vec3> corners) {
    std::reverse(corners.begin(), corners.end());
    return corners;
  }
  void finish_block() {
    blocks.face_begin.back() = static_cast<Index>(blocks.face_area.size());
    blocks.vertex_begin.back() = static_cast<Index>(blocks.vertex.size());
  }
  Index add_face(const Vec3& normal, Real area, Index origin, const std::vector<Vec3>& corners) {
    for (const Vec3& x : corners) {
      blocks.corner_vertex.push_back(static_cast<Index>(blocks.vertex.size()));
      blocks.vertex.push_back(x);
    }
    blocks.corner_begin.push_back(static_cast<Index>(blocks.vertex.size()));
    blocks.loop_begin.push_back(blocks.loop_begin.back() + 1);
    blocks.face_normal.push_back(normal);
    blocks.face_area.push_back(area);
    blocks.face_origin.push_back(origin);
    blocks.face_plane.push_back(static_cast<Index>(blocks.face_plane.size()));
    blocks.face_up.push_back(1);
    return static_cast<Index>(blocks.face_area.size()) - 1;
  }
  void touch(End a, End b, Real area) {
    if (b.block < a.block) std::swap(a, b);
    blocks.interfaces.push_back(
        {.block = {a.block, b.block}, .face = {a.face, b.face}, .area = area});
  }

  std::vector<Waiting> waiting_;
};

/// One rock (2000 kg/m³) and one joint material, under g = 9.81 m/s² downward.
inline Model model_with_joints(Real friction_angle, Real cohesion = 0) {
  Model model;
  model.materials.push_back(
      {.name = "rock", .density = 2000, .young_modulus = 1e9, .poisson_ratio = 0.25});
  JointMaterial joint;
  joint.name = "joint";
  joint.friction_angle = friction_angle;
  joint.cohesion = cohesion;
  model.joint_materials.push_back(joint);
  model.support = SupportSpec{};
  return model;
}

}  // namespace rockfold::test
