#include "host/cover/glue.hpp"

namespace rockfold {

void GlueFinder::visit(const Fragment& fragment,
                       const std::function<void(const GlueArea&)>& visit) {
  const Polygon polygon = complex_.polygon_of(fragment);
  std::vector<Vec3> corner;
  walker_.walk(
      polygon, half_space(polygon.plane, false),
      [&](const std::array<Index, 3>& ijk, int part, const Polygon& piece) {
        corner.clear();
        for (const Vertex& v : piece.corner) corner.push_back(v.x);
        if (width_in_plane(corner, planes_.normal(polygon.plane)) < planes_.width_tolerance())
          return;
        const GlueArea c = glue_area(fragment, ijk, part, piece);
        if (c.one.any() && c.two.any()) visit(c);
      });
}

// The part lies below the fragment's plane where that is the plane of one of its facets.
GlueArea GlueFinder::glue_area(const Fragment& fragment, const std::array<Index, 3>& ijk, int part,
                               const Polygon& polygon) const {
  const Lattice& lattice = lattice_.lattice();
  const Index lattice_cell = lattice.cell_index(ijk[0], ijk[1], ijk[2]);
  GlueArea c{{}, {}, nullptr, polygon};
  c.one = cells_.find_any(lattice_cell, part, fragment.cell[0]);
  if (!c.one.any()) return c;
  for (const PartFacet& facet : lattice_.form(ijk).facet[part]) {
    if (plane_of(lattice_.inside(ijk, facet)) != polygon.plane) continue;
    auto next = ijk;
    if (facet.axis >= 0) {
      next[facet.axis] += facet.step;
      if (next[facet.axis] < 0 || next[facet.axis] >= lattice.cells[facet.axis]) return c;
    }
    c.facet = &facet;
    c.two = cells_.find_any(lattice.cell_index(next[0], next[1], next[2]), facet.other,
                            fragment.cell[1]);
    return c;
  }
  c.two = cells_.find_any(lattice_cell, part, fragment.cell[1]);
  return c;
}

bool AreaWithin::operator()(const Polygon& polygon, const std::vector<HalfSpaceId>& one,
                            const std::vector<HalfSpaceId>& two) {
  inside_.clear();
  for (const auto* cuts : {&one, &two})
    for (const HalfSpaceId h : *cuts)
      if (plane_of(h) != polygon.plane) inside_.push_back(h);
  return inside_.empty() || !clipper_.intersection(polygon, inside_).empty();
}

}  // namespace rockfold
