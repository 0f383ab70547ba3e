// Covers and manifold elements as flat arrays: the contract between host/cover (which makes them from exact
// geometry) and kernels/ (which integrate over them and solve).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/arrays/lattice.hpp"
#include "src/arrays/time_table.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// P physical covers, R regular lattice cells, E cut elements made of Q convex pieces with T triangles and V vertices.
///
/// A regular lattice cell lies wholly inside one block and no joint enters it: it stands for all its parts, whole, and is
/// stored as an index. Every other part that holds rock is stored as cut elements: an element is a connected part of
/// (part ∩ rock) of one material; a piece is a convex part of an element that belongs to one block (the union of an
/// element's pieces is the element). With n parts a cell, elements are numbered: n·r + t for part t of regular cell r, then
/// n·R + e for cut element e. Below, N is the number of nodes of a cell (8; tet24: 15; block: 1), M that of a part (4; hex8: 8; block: 1).
///
/// Unknowns: a cover of order 0, 1, 2 carries 1, 4, 10 functions of three components each (shape_functions.hpp).
/// Unknown k·P + p is function k of cover p; every vector over unknowns ([U] below and in StateArrays) is in this order.
struct CoverArrays {
  Lattice lattice;
  int order = 0;  ///< of the cover functions: 0, 1, 2

  // physical covers, ordered by lattice node
  std::vector<Index> cover_node;  ///< [P] linear lattice node index, ascending
  /// Cover functions are monomials of (ξ − middle) / reach, ξ the place from the cover's node in units of the edges. Empty, and 1: of ξ
  /// itself. Where there are whole cells it is empty.
  std::vector<Vec3> middle;  ///< [P]
  Real reach = 1;

  // regular lattice cells, ordered by lattice cell
  std::vector<Index> regular_cell;      ///< [R] linear lattice cell index
  std::vector<Index> regular_cover;     ///< [R][N] physical cover of each node of the cell
  std::vector<Index> regular_material;  ///< [R] into Model::materials
  std::vector<Index> regular_block;     ///< [R]

  // cut elements, ordered by lattice cell, part
  std::vector<Index> element_cell;         ///< [E] linear lattice cell index
  std::vector<std::uint8_t> element_part;  ///< [E] into the split of its lattice cell
  std::vector<Index> element_cover;        ///< [E][M] physical cover of each node of the part
  std::vector<Index> element_material;     ///< [E]
  std::vector<Index> piece_begin;          ///< [E+1] pieces of each element

  // pieces
  std::vector<Index> piece_block;      ///< [Q]
  std::vector<Index> triangle_begin;   ///< [Q+1]
  std::vector<Index> triangle_vertex;  ///< [T][3] counter-clockwise seen from outside, 0 ≤ id < V
  std::vector<Index> vertex_begin;     ///< [Q+1] each piece has vertices of its own
  std::vector<Real> vertex_xyz;  ///< [V][3] m, relative to the centre of the piece's lattice cell

  // counts of the thesis (case 0.1), whole parts included
  std::int64_t element_vertices = 0;  ///< vertices summed over all elements
  std::int64_t element_faces = 0;     ///< faces summed over all elements

  Index cover_count() const { return static_cast<Index>(cover_node.size()); }
  Index regular_count() const { return static_cast<Index>(regular_cell.size()); }
  Index cut_count() const { return static_cast<Index>(element_cell.size()); }
  /// Of a cover.
  int functions() const { return order == 0 ? 1 : order == 1 ? 4 : 10; }
  /// Whether elements differ in their functions, which are then evaluated at points.
  bool sampled() const { return !middle.empty(); }
  /// U: vectors of three components; degrees of freedom are three times as many.
  Index unknown_count() const { return functions() * cover_count(); }
  int nodes_per_cell() const { return cell_split(lattice.kind).node_count(); }
  int parts_per_cell() const { return cell_split(lattice.kind).part_count(); }
  /// Parts before this one are of the first of two overlaid splits; all, if there is one split.
  int first_split_parts() const { return cell_split(lattice.kind).first_split_parts(); }
  int nodes_per_part() const { return cell_split(lattice.kind).nodes_per_part(); }
  Index element_count() const { return parts_per_cell() * regular_count() + cut_count(); }
  Index piece_count() const { return static_cast<Index>(piece_block.size()); }
};

/// N points of the material: displacement there = Σ weight[i] · d[unknown[i]], begin[n] ≤ i < begin[n+1].
/// Example: one point in a tetrahedron of order 0 has begin = {0, 4} and four weights that sum to 1.
struct MaterialPoints {
  std::vector<Index> element;  ///< [N] element that holds the point, none if it is outside the rock
  std::vector<Vec3> local;     ///< [N] m, from the centre of the element's lattice cell
  std::vector<Index> begin{0};  ///< [N+1]
  std::vector<Index> unknown;   ///< < U
  std::vector<Real> weight;     ///< φ_ak at the point

  std::size_t size() const { return element.size(); }
};

/// How the displacement of a fixed point is enforced.
enum class Enforce : std::uint8_t {
  penalty,  ///< a spring
  held      ///< in its place
};

/// Displacements that are prescribed, in some components (essential boundary conditions). Each is that of a row of `points`: the
/// displacement of one point, a mean over several, or a moment of them (weights that sum to zero: how a face deforms; its value is 0).
struct FixedPoints {
  MaterialPoints points;  ///< [N] `element` and `local`: one point of the row
  std::vector<std::array<std::uint8_t, 3>> component;  ///< [N] 1 = fixed
  std::vector<Vec3> value;                             ///< [N] m; at points with a table: unused
  std::vector<Index> table;  ///< [N] into `tables`, or none (or all empty): the value is constant
  std::vector<Index> condition;  ///< [N] into Model::fixed; may be empty
  std::vector<Real> stiffness;  ///< [N] N/m penalty of the point (its share of the area times Pa/m)
  std::vector<Enforce> enforce;  ///< [N]
  /// [N] how far the rock that a row holds moves with one metre of it, at most; empty: 1. Much less than 1 where all the rock that a
  /// cover holds is a sliver far from its node.
  std::vector<Real> motion_ratio;
  std::vector<TimeTable> tables;  ///< m over s
};

}  // namespace rockfold
