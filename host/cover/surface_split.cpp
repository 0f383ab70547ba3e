#include "host/cover/surface_split.hpp"

namespace rockfold {

Holder holder_of(const Complex& complex, const Covering& covering, Index lattice_cell, int part,
                 Index rock) {
  const CoverArrays& covers = covering.arrays;
  const PieceIndex& index = *covering.pieces;
  Holder h;
  h.rock = rock;
  h.block = complex.cell_block[rock];
  h.lattice_cell = lattice_cell;
  h.part = part;
  const Index regular = covers.parts_per_cell() * covers.regular_count();
  const Index piece = index.find_piece(covers, lattice_cell, part, rock);
  if (piece != none) {
    h.element = regular + index.piece_element[piece];
    return h;
  }
  const Index r = PieceIndex::find_regular(covers, lattice_cell);
  if (r != none && index.regular_rock[r] == rock) h.element = covers.parts_per_cell() * r + part;
  return h;
}

void SurfaceSplitter::split(const FreePart& part, const Visit& visit) {
  const Polygon polygon = complex_.polygon_of(part);
  const Lattice& lattice = covering_.arrays.lattice;
  const auto visit_part = [&](Index lattice_cell, int p, const Polygon& piece) {
    const Holder h = holder_of(complex_, covering_, lattice_cell, p, part.cell);
    if (h.found()) visit(h, piece);
  };
  if (lattice.kind == LatticeKind::block)
    return visit_part(complex_.cell_block[part.cell], 0, polygon);
  walker_.walk(polygon, complex_.cells[part.cell].faces[part.face].inside,
               [&](const std::array<Index, 3>& ijk, int p, const Polygon& piece) {
                 visit_part(lattice.cell_index(ijk[0], ijk[1], ijk[2]), p, piece);
               });
}

}  // namespace rockfold
