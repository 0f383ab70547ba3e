// Which pieces touch where joints are prolonged through elements (cover.joint_tips): then those of one cell of the complex in
// a lattice cell are not all one. Pieces without cuts are answered at once.
#pragma once

#include "host/cover/glue.hpp"

namespace rockfold {

class PieceInterfaces {
 public:
  PieceInterfaces(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                  const Pieces& pieces)
      : complex_(complex), lattice_(lattice), planes_(planes), pieces_(pieces), area_(planes) {
    for (const PieceRecord& p : pieces.pieces) any_cut_ = any_cut_ || !p.cuts.empty();
  }

  // Pieces may be none: a regular lattice cell, which nothing cuts.

  /// Whether two pieces share an area of a polygon that lies in both but for their cuts, and between which no cut runs.
  bool touch(Index one, Index two, const Polygon& polygon);

  /// Whether a cut runs between two pieces.
  bool apart(Index one, Index two) const;

  /// Whether two pieces of one cell of the complex, which has an area of the facet between their parts, share some of it.
  bool touch_on_facet(Index one, Index two, const PartFacet& facet);

  /// Likewise in one lattice cell, on any facet; in two splits that are overlaid, whether they share a volume.
  bool touch_inside_cell(Index one, Index two);

  /// Whether a cut parts what a cell of the complex has of a lattice cell.
  bool is_parted(const CellContent& cell, Index rock) const;

  /// Whether any joint is prolonged.
  bool any_cut() const { return any_cut_; }

 private:
  bool share_area(Index one, Index two, const PartFacet& facet);
  const std::vector<HalfSpaceId>& cuts(Index piece) const {
    return piece == none ? no_cuts_ : pieces_.pieces[piece].cuts;
  }

  const Complex& complex_;
  const LatticePlanes& lattice_;
  const PlaneTable& planes_;
  const Pieces& pieces_;
  AreaWithin area_;
  const std::vector<HalfSpaceId> no_cuts_;
  bool any_cut_ = false;
};

}  // namespace rockfold
