#include "host/cut/zones.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "host/cut/cells/near_boxes.hpp"
#include "host/cut/surface_flood.hpp"
#include "host/parallel.hpp"

namespace rockfold {

namespace {

bool lies_inside(const CellView& cell, const Body& body, const PlaneTable& planes) {
  for (const HalfSpaceId h : body.inside)
    for (const Vertex& v : cell.vertices)
      if (planes.side(v, plane_of(h)) == (is_above(h) ? -1 : 1)) return false;
  return true;
}

// The bodies that hold each cell, ascending.
std::vector<std::vector<Index>> bodies_of_cells(const Complex& complex, const CellStore& cells) {
  std::vector<std::vector<Index>> bodies = surfaces_around_cells(complex, cells);
  std::vector<Index> convex;
  std::vector<Box> of_body, of_cell(cells.size());
  for (std::size_t b = 0; b < complex.bodies.size(); ++b)
    if (!complex.bodies[b].inside.empty()) {
      convex.push_back(static_cast<Index>(b));
      of_body.push_back(complex.bodies[b].box);
    }
  for (Index c = 0; c < cells.size(); ++c)
    for (const Vertex& v : cells[c].vertices) of_cell[c].add(v.x);
  const auto near = near_boxes(of_cell, of_body, complex.planes.width_tolerance());
  parallel_for(cells.size(), 64, [&](std::int64_t c) {
    for (const Index i : near[c])
      if (lies_inside(cells[static_cast<Index>(c)], complex.bodies[convex[i]], complex.planes))
        bodies[c].push_back(convex[i]);
    std::sort(bodies[c].begin(), bodies[c].end());
  });
  return bodies;
}

std::set<Index> solids_named_by_joints(const Complex& complex) {
  std::set<Index> solids;
  for (const JointPatch& joint : complex.joints)
    if (joint.within != none) solids.insert(joint.within);
  return solids;
}

// The block operations in their order, then what else is known of the place.
Zone zone_of(const std::vector<Index>& bodies, const Complex& complex, const Model& model,
             const std::set<Index>& named) {
  Zone zone;
  for (const Index b : bodies) {
    const Body& body = complex.bodies[b];
    switch (body.role) {
      case Body::Role::solid:
        zone.solid = model.solids[body.owner].add ? body.owner : none;
        if (named.count(body.owner) != 0) zone.within.push_back(body.owner);
        break;
      case Body::Role::excavation: {
        const Index stage = model.excavations[body.owner].stage;
        zone.stage = zone.stage == 0 ? stage : std::min(zone.stage, stage);
        break;
      }
      case Body::Role::merge:
        zone.merges.push_back(body.owner);
        break;
    }
  }
  const auto tidy = [](std::vector<Index>& list) {
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  tidy(zone.within), tidy(zone.merges);
  return zone;
}

}  // namespace

ZonedCells find_zones(const Complex& complex, const CellStore& cells, const Model& model) {
  const auto bodies = bodies_of_cells(complex, cells);
  const auto named = solids_named_by_joints(complex);
  std::map<Zone, Index> number;
  std::vector<std::map<Zone, Index>::iterator> of_cell(cells.size(), number.end());
  for (Index c = 0; c < cells.size(); ++c) {
    Zone zone = zone_of(bodies[c], complex, model, named);
    if (zone.solid != none) of_cell[c] = number.try_emplace(std::move(zone), 0).first;
  }
  ZonedCells result;
  for (auto& [zone, id] : number) {
    id = static_cast<Index>(result.zones.size());
    result.zones.push_back(zone);
  }
  for (const auto& it : of_cell) result.cell_zone.push_back(it == number.end() ? none : it->second);
  return result;
}

}  // namespace rockfold
