#include "host/cut/surface_flood.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "host/cut/patch_finder.hpp"
#include "host/cut/plane_areas.hpp"

namespace rockfold {

namespace {

bool is_surface(const Body& body) {
  return body.inside.empty();
}

// An area that two cells share, and the bodies whose surface it is part of.
struct Link {
  std::array<Index, 2> cell;
  std::vector<Index> walls;  // ascending
};

// Facets of a body on one plane, by the side that holds the body. Where both sides do, it has no thickness and nothing lies
// between: no wall.
struct Cover {
  Index body;
  std::array<bool, 2> side{};
};

class WallFinder {
 public:
  WallFinder(const Complex& complex, Index plane)
      : complex_(complex),
        facets_(complex.facets_by_plane.on(plane)),
        finder_(facets_, complex.planes.normal(plane),
                [&](Index f) { return complex.facets[f].patch.box; }),
        clipper_(complex.planes) {}

  // An edge of a closed surface is an edge of two of its facets: the planes of both have cut there, and an area lies
  // inside a facet or outside of it.
  std::vector<Index> walls(const CellStore& cells, const SharedArea& shared) {
    std::vector<Index> walls;
    if (facets_.empty()) return walls;
    const CellView below = cells[shared.cell[0]];
    const Polygon polygon =
        shared.polygon.empty() ? face_polygon(below, below.faces[shared.face[0]]) : shared.polygon;
    Box box;
    for (const Vertex& v : polygon.corner) box.add(v.x);
    finder_.near(box, complex_.planes.width_tolerance(), near_);
    covers_.clear();
    for (const Index f : near_) add(complex_.facets[f], polygon);
    for (const Cover& c : covers_)
      if (c.side[0] != c.side[1]) walls.push_back(c.body);
    std::sort(walls.begin(), walls.end());
    return walls;
  }

 private:
  void add(const Facet& facet, const Polygon& polygon) {
    if (!is_surface(complex_.bodies[facet.body])) return;
    if (clipper_.intersection(polygon, facet.patch.edges).empty()) return;
    auto cover = std::find_if(covers_.begin(), covers_.end(),
                              [&](const Cover& c) { return c.body == facet.body; });
    if (cover == covers_.end()) cover = covers_.insert(covers_.end(), {facet.body, {}});
    cover->side[is_above(facet.inside) ? 1 : 0] = true;
  }

  const Complex& complex_;
  const std::span<const Index> facets_;
  const PatchFinder finder_;
  PolygonClipper clipper_;
  std::vector<Index> near_;
  std::vector<Cover> covers_;
};

// A cell at the border of the box around the rock and all surfaces, which is outside of them: its planes are the table's first six.
Index outer_cell(const CellStore& cells) {
  constexpr Index box_planes = 6;
  for (Index c = 0; c < cells.size(); ++c)
    for (const auto& face : cells[c].faces)
      if (plane_of(face.inside) < box_planes) return c;
  return 0;
}

}  // namespace

std::vector<std::vector<Index>> surfaces_around_cells(const Complex& complex,
                                                      const CellStore& cells) {
  std::vector<std::vector<Index>> around(cells.size());
  if (std::none_of(complex.bodies.begin(), complex.bodies.end(), is_surface)) return around;
  std::vector<std::vector<Link>> by_plane(complex.planes.size());
  const auto nowhere = [](Index) { return false; };  // open areas are the border of the start
  for_each_plane(complex.planes, cells, nowhere, [&](Index plane, PlaneAreas& areas) {
    WallFinder finder(complex, plane);
    for (const SharedArea& shared : areas.shared)
      by_plane[plane].push_back({{shared.cell[0], shared.cell[1]}, finder.walls(cells, shared)});
  });

  std::vector<std::int64_t> begin(static_cast<std::size_t>(cells.size()) + 1, 0);
  for (const auto& links : by_plane)
    for (const Link& l : links) ++begin[l.cell[0] + 1], ++begin[l.cell[1] + 1];
  for (Index c = 0; c < cells.size(); ++c) begin[c + 1] += begin[c];
  std::vector<const Link*> of_cell(begin.back());
  std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
  for (const auto& links : by_plane)
    for (const Link& l : links)
      for (const Index c : l.cell) of_cell[next[c]++] = &l;

  std::vector<bool> seen(static_cast<std::size_t>(cells.size()), false);
  std::vector<Index> open{outer_cell(cells)};
  seen[open.front()] = true;
  while (!open.empty()) {
    const Index c = open.back();
    open.pop_back();
    for (auto i = begin[c]; i < begin[c + 1]; ++i) {
      const Link& l = *of_cell[i];
      const Index to = l.cell[0] == c ? l.cell[1] : l.cell[0];
      if (seen[to]) continue;
      seen[to] = true;
      std::set_symmetric_difference(around[c].begin(), around[c].end(), l.walls.begin(),
                                    l.walls.end(), std::back_inserter(around[to]));
      open.push_back(to);
    }
  }
  return around;
}

}  // namespace rockfold
