// The lattice of the mathematical cover as exact planes: the three families of its cells' faces and those of the
// parts inside. A lattice plane that is equal to a joint's or a solid's is that plane.
#pragma once

#include <array>
#include <vector>

#include "host/cover/lattice/split_table.hpp"
#include "host/cut/cells/convex_cell.hpp"
#include "src/arrays/lattice.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// m³, of the lattice that LatticePlanes lays.
Real lattice_cell_volume(const CoverSpec& cover);

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
  /// Planes of family d pass through the origin and lie spacing[d] apart, measured along their normal.
  LatticePlanes(const CoverSpec& cover, const std::vector<Vec3>& bounds, PlaneTable& planes);

  /// A lattice of kind `block`, which has no planes.
  explicit LatticePlanes(Lattice blocks);

  const Lattice& lattice() const { return lattice_; }

  /// The lattice cells that a point set may touch: a little too many at worst.
  LatticeBox range(std::span<const Vertex> vertices) const;

  /// {x : coordinate `axis` ≥ i}.
  HalfSpaceId upper(int axis, Index i) const {
    return families_[axis].upper[i - families_[axis].first];
  }
  /// The half-space above a plane of a lattice cell's split.
  HalfSpaceId upper(const std::array<Index, 3>& cell, const SplitPlane& plane) const;

  /// Planes and neighbours of the parts of a lattice cell.
  const SplitTable::Form& form(const std::array<Index, 3>& cell) const {
    return table_.form[((cell[0] + cell[1] + cell[2]) & 1) ^ (lattice_.odd_origin ? 1 : 0)];
  }

  /// The half-space of a facet of a part of a lattice cell that holds the part.
  HalfSpaceId inside(const std::array<Index, 3>& cell, const PartFacet& facet) const {
    const HalfSpaceId h = upper(cell, facet.plane);
    return facet.above ? h : h ^ 1;
  }

  /// The part of a split that holds the place η (units of the edges, from the cell's centre).
  int part_at(const PartTree& tree, const Vec3& eta) const;

 private:
  /// Planes c·ξ = first + i·step, ξ being lattice coordinates in units of the edges.
  struct Family {
    Index first = 0, step = 1;
    std::vector<HalfSpaceId> upper;  // {c·ξ ≥ first + i·step}
  };
  Vec3 coordinates(const Vec3& x) const;
  void add_planes(PlaneTable& planes);

  SplitTable table_;
  std::array<Vec3, 3> normal_{};  // of the families, in lattice order; near unit
  Vec3 spacing_{};                // in lattice order
  Vec3 node_{};                   // m, lattice coordinate (0,0,0) before the shift by first_
  Vec3 centre_{};                 // of the plane table
  std::array<Index, 3> first_{};  // lattice coordinate of lattice node (0,0,0)
  Lattice lattice_;
  std::vector<Family> families_;
};

}  // namespace rockfold
