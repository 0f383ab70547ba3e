// The parts of a lattice cell as integers: the planes between them, the order in which planes part them, and which part
// lies across each facet. Exact; lattice_planes.hpp turns the planes into those of the plane table.
#pragma once

#include <array>
#include <vector>

#include "src/arrays/lattice.hpp"

namespace rockfold {

/// The plane c·ξ = c·(i,j,k) + offset of cell (i,j,k), with ξ lattice coordinates in units of the edges and c that of a family.
struct SplitPlane {
  int family = 0;
  int offset = 0;
};

/// A facet of a part: three of a tetrahedron's corners, or four of a hexahedron's.
struct PartFacet {
  SplitPlane plane;
  bool above = false;  ///< the part lies where c·ξ is the larger
  int nodes = 0;
  std::array<std::int8_t, 4> node{};    ///< of the part
  int axis = -1;                        ///< the facet lies on the cell's face across this axis
  int step = 0;                         ///< … towards −1 or +1
  int other = 0;                        ///< the part across it, of this cell or the next one
  std::array<std::int8_t, 4> across{};  ///< the same places as `node` among that part's nodes
};

/// Parts a cell by planes none of which cuts a part. Children: a branch, or ~part.
struct PartTree {
  struct Branch {
    SplitPlane plane;
    int below = 0, above = 0;
  };
  int root = 0;
  std::vector<Branch> branch;
};

/// Of a part in the volume of its lattice cell.
Real part_share(const CellSplit& split, const CellPart& part);

struct SplitTable {
  explicit SplitTable(LatticeKind kind);  ///< `block` has no facets

  std::vector<std::array<int, 3>> family;  ///< c of each; the first three are the cell's faces
  std::vector<bool>
      every_other;  ///< [families] only planes of even c·ξ (tet5: odd with Lattice::odd_origin)

  struct Form {
    const CellSplit* split = nullptr;
    std::vector<std::vector<PartFacet>> facet;  ///< [parts]
    std::vector<PartTree> tree;                 ///< one for each of the splits that are overlaid
  };
  std::array<Form, 2> form;  ///< even, odd; alike but for tet5

 private:
  int family_of(const std::array<int, 3>& c);
  void find_facets(Form& form);
  void find_across(Form& form, const Form& next) const;
  void find_trees(Form& form);
  int grow(const Form& form, PartTree& tree, const std::vector<int>& parts) const;
};

}  // namespace rockfold
