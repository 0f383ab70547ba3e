// Blocks of unit cubes: an oracle for finite joints that are rectangles on the integer grid, and solids that are boxes on
// it. Integers and union-find only; shares nothing with host/.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

/// A rectangle on the plane x[axis] = at; u and v are the ranges along the other two axes in ascending order.
struct GridJoint {
  int axis, at;
  std::array<int, 2> u, v;
};

struct GridBox {
  std::array<int, 3> min, max;
  bool add = true;
};

struct GridModel {
  std::array<int, 3> size;  ///< all boxes and joints lie in [0, size]
  std::vector<GridBox> solids;
  std::vector<GridJoint>
      joints;  ///< each of its own origin; the first listed wins where they overlap
};

/// A block; its counts by the definitions of docs/user_guide.md: a face is a maximal connected plane region of one origin;
/// dead-end joints are no part of its surface. Where the surface touches itself, along an edge or at a vertex, it is
/// taken as the boundary of the block's interior: it separates there, and each sheet has an edge or vertex of its own.
struct GridBlock {
  Index volume = 0;  ///< cubes
  Vec3 centroid{};
  Counts counts;
  Index holes = 0;  ///< of faces: loops beyond the first
  Index shells = 0, genus = 0;
  std::array<Index, 3> dead_ends{};  ///< unit squares normal to x, y, z

  /// Euler characteristic of the interior with the dead-end joints taken out: an open set whose slits bound it.
  Index open_euler = 0;
};

struct GridBlocks {
  std::vector<GridBlock> blocks;
  std::array<Index, 3> separating{},
      dead_ends{};       ///< unit squares of joints in the rock, by normal
  Index interfaces = 0;  ///< pairs of faces of two blocks that share area

  Index volume() const {
    Index sum = 0;
    for (const GridBlock& b : blocks) sum += b.volume;
    return sum;
  }
};

GridBlocks blocks_of(const GridModel& model);

/// x ↦ shift + x[0]·column[0] + x[1]·column[1] + x[2]·column[2]
struct AffineMap {
  std::array<Vec3, 3> column{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec3 shift{};
  Vec3 operator()(const Vec3& x) const;
  /// Vector area of the image of the unit square normal to `axis`: the normal of the image of that plane.
  Vec3 square(int axis) const;
  Real determinant() const;
  Vec3 inverse(const Vec3& x) const;
};

struct Placing {
  AffineMap map;
  bool straight = true;  ///< no map: box shapes, and joints with exact normals
  Real noise = 0;        ///< m, each coordinate of corners and points is off by up to that
  bool normals_of_corners = false;  ///< of the noisy corners, instead of the map's own
  bool prisms = false;              ///< solids as prisms instead of half-spaces
  unsigned seed = 1;                ///< of the noise
};

/// Joints are polygons of four corners, named F1, F2, …; solids boxes, half-spaces or prisms named s1, s2, ….
Model model_of(const GridModel& model, const Placing& placing = {});

/// What differs, one line each (at most 20): block by block, matched by centroid. `tolerance` is relative to the volume of
/// the rock, and to its power 2/3 for areas.
std::vector<std::string> differences(const Blocks& found, const GridBlocks& expected,
                                     const AffineMap& map = {}, Real tolerance = 1e-12);

std::string to_text(const GridModel& model);

}  // namespace rockfold::test
