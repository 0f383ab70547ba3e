// Splits polygons on the rock's surface over the elements: for conditions and loads on faces.
#pragma once

#include "host/cover/cover.hpp"
#include "host/cover/lattice/lattice_walk.hpp"
#include "host/cover/points/locate.hpp"
#include "host/cut/cells/complex.hpp"

namespace rockfold {

/// A piece of a cut element, as the holder of points in it.
Holder piece_holder(const Covering& covering, Index piece);
/// A part of a regular lattice cell likewise.
Holder regular_holder(const Covering& covering, Index regular, int part);

class SurfaceSplitter {
 public:
  SurfaceSplitter(const Complex& complex, const Covering& covering)
      : complex_(complex),
        covering_(covering),
        walker_(covering.pieces->lattice, covering.pieces->planes),
        clipper_(covering.pieces->planes) {}

  using Visit = std::function<void(const Holder&, const Polygon&)>;

  /// Calls visit(holder, polygon) for the parts of a polygon on face `face` (local) of a cell of the complex that lie in one
  /// element each. Where two splits are overlaid (tet5_mixed) each covers the whole polygon: then each part stands for
  /// CellSplit::share = 1/2 of its area.
  void split(const Polygon& polygon, Index cell, Index face, const Visit& visit);

 private:
  void visit_part(Index lattice_cell, int part, Index rock, const Polygon& polygon,
                  const Visit& visit);

  const Complex& complex_;
  const Covering& covering_;
  LatticeWalker walker_;
  PolygonClipper clipper_;
};

}  // namespace rockfold
