// The operator's rows, sorted by kind. A row is one function of a physical cover with its three unknowns; the rows of a cover's
// functions stand together.
//
//   stencil rows  a cover all of whose lattice cells are regular and of one material: its couplings are constants of the
//                 lattice. Consecutive ones whose neighbours are consecutive too form a run: few bytes for hundreds of covers.
//   block rows    any other cover: its couplings are stored, for each pair of functions one 3×3 block of stiffness and one
//                 number of mass for each neighbour, in slices of covers with nearly as many neighbours ("SELL") so that a
//                 slice's rows run side by side.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold::solve {

/// In half edges of the lattice: tet24 has nodes at the centres of faces and cells.
using Offset = std::array<int, 3>;

/// Lattice nodes around which the cells are split alike: all corners in most lattices; even and odd corners in tet5; corners,
/// the three sorts of face centres and cell centres in tet24.
struct NodeClass {
  struct Corner {
    int form, node;  ///< of a cell at the node: its split's form, which of its nodes this is
  };
  std::vector<Corner> cell;  ///< all cells at the node
  std::vector<Offset>
      positive;  ///< lexicographically positive offsets of neighbours; their opposites are neighbours too
  /// [2·positive] a cell that holds both the node and the neighbour at + and − each offset: which of its nodes they are
  std::vector<std::array<int, 2>> pair;

  int pairs() const { return static_cast<int>(positive.size()); }
};
/// Empty for `block`, which has no regular cells.
std::vector<NodeClass> node_classes(LatticeKind kind);
/// The class of a lattice node.
int class_of_node(const Lattice& lattice, Index node);

/// Whether two nodes of a cell of this form share a part.
bool nodes_couple(LatticeKind kind, int form, int a, int b);

struct StencilRuns {
  /// No longer: a run's rows stay in the first-level cache while the neighbours are added one after the other.
  static constexpr Index max_length = 256;

  int stride = 1;             ///< from cover to cover of a run: 2 in tet5, whose classes alternate
  std::vector<Index> first;   ///< [N] first cover of each run
  std::vector<Index> length;  ///< [N]
  std::vector<Index> material;         ///< [N]
  std::vector<Index> node_class;       ///< [N]
  std::vector<Index> neighbour_begin;  ///< [N]
  std::vector<Index> neighbour;  ///< first cover's neighbours at + and − each offset of its class

  Index count() const { return static_cast<Index>(first.size()); }
};

/// What is integrated into the rows of a cover: node `c` of regular cell r is (nodes of a cell)·r + c; node a of cut element
/// e is −1 − ((nodes of a part)·e + a).
using Source = std::int64_t;

struct BlockRows {
  int lanes = 1;           ///< covers of a slice
  std::vector<Index> row;  ///< [S·lanes] cover of each lane, none where a slice is not full
  std::vector<Index>
      slice_begin;  ///< [S+1] first column of each slice, in units of `lanes` entries
  std::vector<Index>
      column;  ///< [slice_begin[S]][lanes] neighbouring cover; the row's own where a row is shorter
  /// [S] where the values of a slice begin, as slice_begin; the number of their owner. Slices of rows that are alike share them.
  std::vector<Index> value_begin, owner;
  std::vector<Index> owning;        ///< slices that have values of their own, ascending
  Index value_columns = 0;          ///< of those
  std::vector<Index> source_begin;  ///< [S·lanes+1]
  std::vector<Source> source;       ///< regular cells first, ascending; then elements, ascending

  Index slice_count() const { return static_cast<Index>(slice_begin.size()) - 1; }
};

struct Rows {
  StencilRuns stencil;
  BlockRows block;
  Index stencil_covers = 0, block_covers = 0;
  std::int64_t neighbours = 0;  ///< of block covers, without padding, themselves not counted
};

/// Linear in the number of covers, cells and elements. Without `stencils` all rows are block rows, none alike.
Rows sort_rows(const CoverArrays& covers, int lanes, bool stencils = true);

}  // namespace rockfold::solve
