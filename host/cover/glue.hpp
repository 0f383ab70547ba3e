// Where cells of the complex touch within the lattice, and which of their pieces do.
#pragma once

#include <functional>

#include "host/cover/lattice/lattice_walk.hpp"
#include "host/cover/lattice/occupied_cells.hpp"
#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// A part of a fragment between the rock of its two cells: inside a part of a lattice cell, or on one of its facets.
struct GlueArea {
  Holding one, two;                  ///< below and above the fragment's plane
  const PartFacet* facet = nullptr;  ///< of one's part; null = inside the part
  const Polygon& polygon;            ///< about the table's centre

  bool touches_sliver() const { return one.sliver != none || two.sliver != none; }
};

class GlueFinder {
 public:
  GlueFinder(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
             const OccupiedCells& cells)
      : complex_(complex),
        lattice_(lattice),
        planes_(planes),
        cells_(cells),
        walker_(lattice, planes) {}

  /// Calls visit for each part of a fragment, wider than the tolerance, with rock on both sides.
  void visit(const Fragment& fragment, const std::function<void(const GlueArea&)>& visit);

 private:
  GlueArea glue_area(const Fragment& fragment, const std::array<Index, 3>& ijk, int part,
                     const Polygon& polygon) const;

  const Complex& complex_;
  const LatticePlanes& lattice_;
  const PlaneTable& planes_;
  const OccupiedCells& cells_;
  LatticeWalker walker_;
};

/// Whether a polygon has an area within all of the half-spaces, but for its own plane.
class AreaWithin {
 public:
  explicit AreaWithin(const PlaneTable& planes) : clipper_(planes) {}
  bool operator()(const Polygon& polygon, const std::vector<HalfSpaceId>& one,
                  const std::vector<HalfSpaceId>& two);

 private:
  PolygonClipper clipper_;
  std::vector<HalfSpaceId> inside_;
};

}  // namespace rockfold
