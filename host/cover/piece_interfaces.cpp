#include "host/cover/piece_interfaces.hpp"

#include <algorithm>

namespace rockfold {

namespace {

bool cut_along(const std::vector<HalfSpaceId>& cuts, Index plane) {
  return std::any_of(cuts.begin(), cuts.end(), [&](HalfSpaceId h) { return plane_of(h) == plane; });
}

// Two pieces on different sides of one plane share nothing.
bool are_apart(const std::vector<HalfSpaceId>& one, const std::vector<HalfSpaceId>& two) {
  return std::any_of(one.begin(), one.end(), [&](HalfSpaceId h) {
    return std::find(two.begin(), two.end(), h ^ 1) != two.end();
  });
}

}  // namespace

bool PieceInterfaces::touch(Index one, Index two, const Polygon& polygon) {
  const auto &a = cuts(one), &b = cuts(two);
  if (a.empty() && b.empty()) return true;
  if (cut_along(a, polygon.plane) && cut_along(b, polygon.plane)) return false;
  return !are_apart(a, b) && area_(polygon, a, b);
}

bool PieceInterfaces::apart(Index one, Index two) const {
  return are_apart(cuts(one), cuts(two));
}

bool PieceInterfaces::touch_on_facet(Index one, Index two, const PartFacet& facet) {
  return (cuts(one).empty() && cuts(two).empty()) || share_area(one, two, facet);
}

bool PieceInterfaces::share_area(Index one, Index two, const PartFacet& facet) {
  const auto &a = cuts(one), &b = cuts(two);
  if (are_apart(a, b)) return false;
  // One of them is a piece; its part's facet is also the other's.
  const PieceRecord& p = pieces_.pieces[one != none ? one : two];
  auto ijk = lattice_.lattice().cell_ijk(p.lattice_cell);
  if (one == none && facet.axis >= 0) ijk[facet.axis] -= facet.step;
  const HalfSpaceId inside = lattice_.inside(ijk, facet) ^ (one == none ? 1 : 0);
  PieceRecord whole;
  whole.lattice_cell = p.lattice_cell;
  whole.part = p.part;
  whole.rock = p.rock;
  const ConvexCell cell = clip_to_part(complex_, lattice_, planes_, whole);
  const auto face = std::find_if(cell.faces.begin(), cell.faces.end(),
                                 [&](const auto& f) { return f.inside == inside; });
  return face != cell.faces.end() && area_(face_polygon(cell, *face), a, b);
}

bool PieceInterfaces::touch_inside_cell(Index one, Index two) {
  const PieceRecord &p = pieces_.pieces[one], &q = pieces_.pieces[two];
  const auto ijk = lattice_.lattice().cell_ijk(p.lattice_cell);
  const SplitTable::Form& form = lattice_.form(ijk);
  const int first_split = form.split->first_split_parts();
  if ((p.part < first_split) == (q.part < first_split)) {
    return std::any_of(
        form.facet[p.part].begin(), form.facet[p.part].end(), [&](const PartFacet& facet) {
          return facet.axis < 0 && facet.other == q.part && touch_on_facet(one, two, facet);
        });
  }
  if (are_apart(p.cuts, q.cuts)) return false;
  std::vector<HalfSpaceId> inside = q.cuts;
  for (const PartFacet& facet : form.facet[q.part]) inside.push_back(lattice_.inside(ijk, facet));
  return !clip(planes_, clip_to_part(complex_, lattice_, planes_, p), inside).faces.empty();
}

bool PieceInterfaces::is_parted(const CellContent& cell, Index rock) const {
  if (!any_cut_) return false;
  for (Index i = cell.piece_begin; i < cell.piece_end; ++i)
    if (pieces_.pieces[i].rock == rock && !pieces_.pieces[i].cuts.empty()) return true;
  return false;
}

}  // namespace rockfold
