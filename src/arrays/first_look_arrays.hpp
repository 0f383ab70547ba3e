// Removable blocks as the search for key blocks first looks at them, with all rock still in place: what block theory needs
// of each to be done again with other friction, cohesion, water or earthquake. The page does so (src/web/block_theory).
#pragma once

#include <cstdint>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// L looks at blocks with F faces in contact, O loops of these faces with C corners, and P planes of contact with Q corners.
/// Which blocks are removable follows from geometry alone. A block that several stages of excavation lay free has a look of each.
/// Example: a wedge on two joints is L = 1, F = 2, O = 2, C = 6, P = 2, Q = 6.
struct FirstLookArrays {
  // looks, by stage, then block
  std::vector<Index> block;     ///< [L]
  std::vector<Index> stage;     ///< [L] of the excavation that is made before; 0 = none
  std::vector<Real> volume;     ///< [L] m³
  std::vector<Real> mass;       ///< [L] kg
  std::vector<Real> free_area;  ///< [L] m²
  std::vector<Vec3> centroid;   ///< [L] m
  std::vector<Vec3> load;       ///< [L] N, without earthquake and water
  std::vector<Vec3>
      moment;  ///< [L] N m of the loads about the centroid, without earthquake and water
  std::vector<Vec3> free_centre;  ///< [L] m, where support acts: the middle of the free faces
  std::vector<Mat3>
      inertia;  ///< [L] kg m², about the centroid; zero where rotation is not looked at
  std::vector<Index> neighbour_begin;  ///< [L+1]
  std::vector<Index> neighbour;        ///< blocks that it leans on, ascending

  /// Blocks of later stages that are not removable as long as all that they lean on is there, by stage, then block.
  std::vector<Index> held_block;            ///< [H]
  std::vector<Index> held_stage;            ///< [H]
  std::vector<Index> held_neighbour_begin;  ///< [H+1]
  std::vector<Index> held_neighbour;        ///< blocks that it leans on, ascending

  // faces in contact, in the order in which their planes are found
  std::vector<Index> face_begin;  ///< [L+1]
  std::vector<Index> origin;      ///< [F] into BlockArrays::origins
  std::vector<Vec3> normal;       ///< [F] unit, outward
  std::vector<Vec3>
      plane_normal;  ///< [F] of the plane of contact: of a facet of a mesh its mean plane's
  std::vector<Real> contact_area;   ///< [F] m²
  std::vector<Real> share;          ///< [F] of the face's area that is in contact, ≤ 1
  std::vector<Index> loop_begin;    ///< [F+1]
  std::vector<Index> corner_begin;  ///< [O+1]
  std::vector<Vec3> corner;         ///< [C] m, counter-clockwise seen from outside, holes clockwise

  // outlines of joints as their water finds them, of one face or of several that are one joint; U of them with R corners
  std::vector<Index> outline;        ///< [F] into the outlines
  std::vector<Index> outline_begin;  ///< [U+1]
  std::vector<Vec3> outline_normal;  ///< [U] unit, outward
  std::vector<Vec3> outline_corner;  ///< [R] m, counter-clockwise seen from outside
  std::vector<Real> outline_drains;  ///< [R] 0 to 1: how far water leaves the joint at the corner
  std::vector<Real> outline_edge_drains;  ///< [R] likewise along the edge to the next corner
  std::vector<Real> outline_pond;         ///< [R] Pa, of water before the corner where it drains

  // planes of contact that the block may turn about; none where rotation is not looked at
  std::vector<Index> patch_begin;         ///< [L+1]
  std::vector<Index> patch_face;          ///< [P] among all F: the face that it is named after
  std::vector<Vec3> patch_normal;         ///< [P] unit, outward
  std::vector<Index> patch_corner_begin;  ///< [P+1]
  std::vector<Vec3> patch_corner;         ///< [Q] m, in order around it

  // stages, in their order; the first is 0
  std::vector<Index> looked_at_stage;  ///< [S]
  /// [S] 1 where several blocks may fail together if none does alone.
  std::vector<std::uint8_t> groups_may_move;
};

}  // namespace rockfold
