// What a page draws: the surfaces of blocks as convex polygons, each block with points of its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/base/types.hpp"
#include "src/io/hdf5/hdf5_file.hpp"

namespace rockfold {

/// N blocks are shown, of the B that the result holds, with P points, Q polygons and C corners.
/// Example: one tetrahedron has N = 1, P = 4, Q = 4, C = 12; point_begin = {0, 4}, polygon_begin = {0, 4}.
struct PageSurface {
  std::string grid;                         ///< "Blocks" or "Elements": whose points these are
  std::vector<Index> block;                 ///< [N] of the result, from 0, ascending
  std::vector<Index> point_begin;           ///< [N+1]
  std::vector<Index> point_row;             ///< [P] rows of the grid's points
  std::vector<Vec3> point;                  ///< [P] m
  std::vector<Index> polygon_begin;         ///< [N+1]
  std::vector<std::uint32_t> corner_count;  ///< [Q]
  std::vector<std::uint32_t> origin;        ///< [Q] into /rockfold/origins
  std::vector<std::uint32_t>
      corner_point;  ///< [C] from the block's first point on, counter-clockwise
  std::vector<std::uint8_t> corner_edge;  ///< [C] 1: the side to the next corner is a block's edge
};

/// The faces as the cutting left them. `seen_only`: blocks all of whose faces lie in joints are left out.
PageSurface block_surface(const hdf5::File& file, bool seen_only);

/// Whether the result's elements show more than the corners of blocks do: it has states, and covers of a lattice.
bool has_element_surface(const hdf5::File& file);

/// The outer faces of the elements, as triangles, of the blocks that `coarse` shows. Their points carry motion
/// and stress between the corners of blocks.
PageSurface element_surface(const hdf5::File& file, const PageSurface& coarse);

}  // namespace rockfold
