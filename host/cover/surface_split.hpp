// Splits polygons on the rock's surface over the elements: for conditions and loads on faces.
#pragma once

#include "host/cover/cover.hpp"
#include "host/cover/lattice_walk.hpp"
#include "host/cover/locate.hpp"
#include "host/cut/complex.hpp"

namespace rockfold {

/// The element that a cell of the complex has in a part of a lattice cell; not found() if it has none.
Holder holder_of(const Complex& complex, const Covering& covering, Index lattice_cell, int part,
                 Index rock);

class SurfaceSplitter {
 public:
  SurfaceSplitter(const Complex& complex, const Covering& covering)
      : complex_(complex),
        covering_(covering),
        walker_(covering.pieces->lattice, covering.pieces->planes) {}

  using Visit = std::function<void(const Holder&, const Polygon&)>;

  /// Calls visit(holder, polygon) for the parts of a free part of a cell's face. Where two splits are overlaid
  /// (tet5_mixed) each covers the whole face: then each part stands for CellSplit::share = 1/2 of its area.
  void split(const FreePart& part, const Visit& visit);

 private:
  const Complex& complex_;
  const Covering& covering_;
  LatticeWalker walker_;
};

}  // namespace rockfold
