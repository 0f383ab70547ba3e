// Distributes convex cells and polygons over the lattice: recursive halving of a range of lattice cells, so that the
// work goes with the cut lattice cells and not with all of them.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "host/cover/lattice_planes.hpp"
#include "host/cut/polygon.hpp"

namespace rockfold {

/// What a walk finds; called in a deterministic order.
struct CellVisitor {
  std::function<void(const LatticeBox&)>
      whole;  ///< all lattice cells of the range lie wholly inside the cell
  std::function<void(const std::array<Index, 3>& lattice_cell, int tet, const ConvexCell& piece)>
      piece;
};

using PolygonVisitor =
    std::function<void(const std::array<Index, 3>& lattice_cell, int tet, const Polygon& part)>;

class LatticeWalker {
 public:
  LatticeWalker(const LatticePlanes& lattice, const PlaneTable& planes)
      : lattice_(lattice), splitter_(planes), clipper_(planes) {}

  /// Splits a convex cell into whole lattice cells and convex pieces of tetrahedra.
  void walk(const CellView& cell, const CellVisitor& visitor);

  /// Splits a polygon over the tetrahedra. Where it lies on facets, only tetrahedra on `side` of its plane are visited.
  void walk(const Polygon& polygon, HalfSpaceId side, const PolygonVisitor& visitor);

 private:
  bool is_whole(const CellView& cell, const LatticeBox& box) const;
  void descend(std::size_t depth, const CellView& cell, LatticeBox box, const CellVisitor& visitor);
  void descend(const Polygon& polygon, HalfSpaceId side, LatticeBox box,
               const PolygonVisitor& visitor);
  void split_tetrahedra(const CellView& cell, const std::array<Index, 3>& lattice_cell,
                        const CellVisitor& visitor);

  struct Level {
    ConvexCell below, above;
  };
  const LatticePlanes& lattice_;
  CellSplitter splitter_;
  PolygonClipper clipper_;
  std::vector<std::unique_ptr<Level>> levels_;
  ConvexCell piece_, part_;
};

}  // namespace rockfold
