// The lattice of the mathematical cover as exact planes: the three families of its cells' faces and those of the
// tetrahedra inside. A lattice plane that coincides with a joint or a solid's face is that plane.
#pragma once

#include <array>
#include <vector>

#include "host/cut/convex_cell.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A range of lattice cells, [low, high) in each direction.
struct LatticeBox {
  std::array<Index, 3> low{}, high{};

  bool single() const {
    return high[0] - low[0] == 1 && high[1] - low[1] == 1 && high[2] - low[2] == 1;
  }
};

class LatticePlanes {
 public:
  /// Lays the lattice over everything between the corners of `bounds` (relative to the table's centre), whose convex hull
  /// holds the rock, and adds its planes to `planes`. Throws Error(model) if it has more than 2^31 − 1 nodes.
  LatticePlanes(const CoverSpec& cover, const std::vector<Vec3>& bounds, PlaneTable& planes);

  const Lattice& lattice() const { return lattice_; }

  /// The lattice cells that a point set may touch: a little too many at worst.
  LatticeBox range(std::span<const Vertex> vertices) const;

  /// {x : coordinate `axis` ≥ i}.
  HalfSpaceId upper(int axis, Index i) const {
    return families_[axis].upper[i - families_[axis].first];
  }

  /// The half-space of facet `a` (opposite corner a of tet6_corner[t]) that holds tetrahedron t of a lattice cell.
  HalfSpaceId facet(const std::array<Index, 3>& cell, int t, int a) const;

 private:
  /// Planes c·ξ = v for integers v, ξ being lattice coordinates in units of the spacing.
  struct Family {
    std::array<int, 3> c{};
    Index first = 0;
    std::vector<HalfSpaceId> upper;  // {c·ξ ≥ first + i}
  };
  struct FacetPlane {
    int family;
    int offset;  // value of the plane in cell (0,0,0)
    bool above;  // the tetrahedron lies where c·ξ ≥ value
  };
  Vec3 coordinates(const Vec3& x) const;
  int family_of(const std::array<int, 3>& c);
  void find_facets();
  void add_planes(PlaneTable& planes);

  std::array<Vec3, 3> normal_;  // of the families, in lattice order; near unit
  Real spacing_;
  Vec3 node_;                     // m, lattice coordinate (0,0,0) before the shift by first_
  Vec3 centre_;                   // of the plane table
  std::array<Index, 3> first_{};  // lattice coordinate of lattice node (0,0,0)
  Lattice lattice_;
  std::vector<Family> families_;
  FacetPlane facet_[6][4];
};

}  // namespace rockfold
