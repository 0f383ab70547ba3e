#include "host/cover/points/surface_split.hpp"

#include "src/base/vector.hpp"

namespace rockfold {

Holder piece_holder(const Covering& covering, Index piece) {
  const CoverArrays& covers = covering.arrays;
  const Index e = covering.pieces->piece_element[piece];
  Holder h;
  h.element = covers.parts_per_cell() * covers.regular_count() + e;
  h.block = covers.piece_block[piece];
  h.rock = covering.pieces->piece_rock[piece];
  h.lattice_cell = covers.element_cell[e];
  h.part = covers.element_part[e];
  return h;
}

Holder regular_holder(const Covering& covering, Index regular, int part) {
  const CoverArrays& covers = covering.arrays;
  Holder h;
  h.element = covers.parts_per_cell() * regular + part;
  h.block = covers.regular_block[regular];
  h.rock = covering.pieces->regular_rock[regular];
  h.lattice_cell = covers.regular_cell[regular];
  h.part = part;
  return h;
}

void SurfaceSplitter::split(const Polygon& polygon, Index cell, Index face, const Visit& visit) {
  const Lattice& lattice = covering_.arrays.lattice;
  if (lattice.kind == LatticeKind::block)
    return visit_part(complex_.cell_block[cell], 0, cell, polygon, visit);
  walker_.walk(polygon, complex_.cells[cell].faces[face].inside,
               [&](const std::array<Index, 3>& ijk, int part, const Polygon& piece) {
                 visit_part(lattice.cell_index(ijk[0], ijk[1], ijk[2]), part, cell, piece, visit);
               });
}

void SurfaceSplitter::visit_part(Index lattice_cell, int part, Index rock, const Polygon& polygon,
                                 const Visit& visit) {
  const CoverArrays& covers = covering_.arrays;
  const PieceIndex& index = *covering_.pieces;
  const std::vector<Index> pieces = index.find_pieces(covers, lattice_cell, part, rock);
  for (const Index q : pieces) {
    if (index.piece_cuts.empty() || index.piece_cuts[q].empty()) {
      visit(piece_holder(covering_, q), polygon);
    } else {
      std::vector<HalfSpaceId> cuts = index.piece_cuts[q];
      std::erase_if(cuts, [&](HalfSpaceId h) { return plane_of(h) == polygon.plane; });
      const Polygon own = clipper_.intersection(polygon, cuts);
      if (!own.empty()) visit(piece_holder(covering_, q), own);
    }
  }
  const Index r = PieceIndex::find_regular(covers, lattice_cell);
  if (r != none && index.regular_rock[r] == rock)
    visit(regular_holder(covering_, r, part), polygon);
  else if (pieces.empty())
    if (const PieceKey* owner = index.owner_of_left_out({lattice_cell, part, rock}))
      visit_part(owner->lattice_cell, owner->part, owner->rock, polygon, visit);
}

}  // namespace rockfold
