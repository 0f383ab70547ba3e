// Distributes convex cells and polygons over the lattice: recursive halving of a range of lattice cells, so that the
// work goes with the cut lattice cells and not with all of them; then halving of a lattice cell's parts by the planes between.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "host/cover/lattice/lattice_planes.hpp"
#include "host/cut/cells/polygon.hpp"

namespace rockfold {

/// What a walk finds; called in a deterministic order.
struct CellVisitor {
  std::function<void(const LatticeBox&)>
      whole;  ///< all lattice cells of the range lie wholly inside the cell
  std::function<void(const std::array<Index, 3>& lattice_cell, int part, const CellView& piece)>
      piece;
};

using PolygonVisitor =
    std::function<void(const std::array<Index, 3>& lattice_cell, int part, const Polygon& polygon)>;

class LatticeWalker {
 public:
  LatticeWalker(const LatticePlanes& lattice, const PlaneTable& planes)
      : lattice_(lattice), splitter_(planes), clipper_(planes) {}

  /// Splits a convex cell into whole lattice cells and convex pieces of parts.
  void walk(const CellView& cell, const CellVisitor& visitor);

  /// Splits a polygon over the parts. Where it lies on facets, only parts on `side` of its plane are visited.
  void walk(const Polygon& polygon, HalfSpaceId side, const PolygonVisitor& visitor);

 private:
  using CellIjk = std::array<Index, 3>;
  struct Level {
    ConvexCell below, above;
  };
  Level& level(std::size_t depth);
  bool is_whole(const CellView& cell, const LatticeBox& box) const;
  void descend(std::size_t depth, const CellView& cell, LatticeBox box, const CellVisitor& visitor);
  void split_parts(std::size_t depth, const CellView& cell, const CellIjk& at, const PartTree& tree,
                   int child, const CellVisitor& visitor);
  void descend(const Polygon& polygon, HalfSpaceId side, const LatticeBox& box,
               const PolygonVisitor& visitor);
  void split_parts(const Polygon& polygon, HalfSpaceId side, const CellIjk& at,
                   const PartTree& tree, int child, const PolygonVisitor& visitor);

  const LatticePlanes& lattice_;
  CellSplitter splitter_;
  PolygonClipper clipper_;
  std::vector<std::unique_ptr<Level>> levels_;
};

using PartsNearVisitor = std::function<void(const std::array<Index, 3>& lattice_cell, int part,
                                            const std::vector<Vec3>& polygon)>;

/// Calls visit(lattice_cell, part, what it holds) for the parts that hold more of a convex polygon (m about the table's centre,
/// corners in a row) than a strip as narrow as the tolerance; where it lies along a facet, for those on both sides. In doubles.
void visit_parts_near(const LatticePlanes& lattice, const PlaneTable& planes,
                      const std::vector<Vec3>& polygon, const PartsNearVisitor& visit);

}  // namespace rockfold
