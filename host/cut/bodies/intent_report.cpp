#include "host/cut/bodies/intent_report.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "host/cut/bodies/connectivity.hpp"
#include "host/cut/bodies/union_find.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr std::size_t most_names = 20;

// Names of joints and faces on the planes, or with edges on them too: at most 20, sorted.
std::vector<std::string> names_on(const Complex& complex, const std::vector<Index>& planes,
                                  bool by_edges) {
  const std::set<Index> wanted(planes.begin(), planes.end());
  std::set<std::string> names;
  const auto name_all = [&](const auto& things) {
    for (const auto& thing : things) {
      if (thing.origin == none) continue;
      bool found = wanted.count(thing.patch.plane) != 0;
      for (const HalfSpaceId edge : thing.patch.edges)
        found = found || (by_edges && wanted.count(plane_of(edge)) != 0);
      if (found) names.insert(complex.origins[thing.origin].name);
    }
  };
  if (!wanted.empty()) name_all(complex.joints), name_all(complex.facets);
  std::vector<std::string> result(names.begin(), names.end());
  if (result.size() > most_names) result.resize(most_names);
  return result;
}

// The planes between which a cell is as narrow as it is: those that lie along its width, or all of a speck's.
std::vector<Index> planes_about(const CellView& cell, const PlaneTable& planes) {
  const Vec3& axis = planes.normal(plane_of(cell.faces[cell_width(cell, planes).face].inside));
  std::vector<Index> along, all;
  for (const auto& face : cell.faces) {
    const Index plane = plane_of(face.inside);
    all.push_back(plane);
    if (std::abs(dot(planes.normal(plane), axis)) > 0.5) along.push_back(plane);
  }
  return along.size() > 1 ? along : all;
}

// Whether blocks would be others if doubtful widths were clearly below the tolerance, or clearly above.
bool doubts_decide(const Complex& complex, const std::vector<CellMeasure>& measures,
                   const std::vector<Index>& doubtful_glue) {
  const Real tolerance = complex.planes.width_tolerance();
  const auto& block = complex.cell_block;
  std::vector<std::uint8_t> doubtful(complex.fragments.size(), 0);
  for (const Index f : doubtful_glue) {
    doubtful[f] = 1;
    if (block[complex.fragments[f].cell[0]] != block[complex.fragments[f].cell[1]]) return true;
  }
  // Below: what is left of a block is in one piece, and there is something left. Above: slivers are glued to their block.
  UnionFind parts(complex.cells.size());
  std::vector<std::uint8_t> glued(complex.cells.size(), 0);
  for (std::size_t i = 0; i < complex.fragments.size(); ++i) {
    const Fragment& f = complex.fragments[i];
    if (f.joint != none) continue;
    // As wide as a cell of rock it would hold on to that, whichever block owns it now.
    const bool one_sliver = complex.is_sliver[f.cell[0]] != complex.is_sliver[f.cell[1]];
    if (one_sliver || block[f.cell[0]] == block[f.cell[1]]) glued[f.cell[0]] = glued[f.cell[1]] = 1;
    if (!f.narrow && doubtful[i] == 0 && !complex.touches_sliver(f))
      parts.join(f.cell[0], f.cell[1]);
  }
  for (const Beam& b : complex.beams)
    if (b.joint == none && b.cell[1] != none && !b.narrow) parts.join(b.cell[0], b.cell[1]);
  std::vector<Index> part_of_block(complex.block_count, none);
  for (Index c = 0; c < complex.cells.size(); ++c) {
    const bool doubt = is_doubtful(measures[c].width, tolerance);
    if (complex.is_sliver[c] != 0) {
      if (doubt && glued[c] == 0) return true;
    } else if (!doubt) {
      Index& part = part_of_block[block[c]];
      if (part != none && parts.find(part) != parts.find(c)) return true;
      part = c;
    }
  }
  return std::find(part_of_block.begin(), part_of_block.end(), none) != part_of_block.end();
}

}  // namespace

IntentReport intent_report(const Complex& complex, const GivenIntent& given,
                           const std::vector<CellMeasure>& measures,
                           const std::vector<Index>& doubtful_glue) {
  IntentReport report;
  report.planes_identified = static_cast<Index>(given.planes.size());
  report.edges_identified = given.edges;
  report.corners_identified = given.corners;
  report.identified = names_on(complex, given.planes, false);
  const Real tolerance = complex.planes.width_tolerance();
  std::vector<Index> near;
  const auto add_doubt = [&](Real width, const Vec3& at) {
    ++report.doubts;
    if (report.doubts > 1 && report.least_doubt <= width) return;
    report.least_doubt = width;
    report.doubt_at = at + complex.planes.centre();
  };
  for (const Index f : doubtful_glue) {
    const Polygon polygon = complex.polygon_of(complex.fragments[f]);
    Box box;
    for (const Vertex& v : polygon.corner) box.add(v.x);
    add_doubt(width_of(complex, complex.fragments[f]), 0.5 * (box.low + box.high));
    for (const HalfSpaceId edge : polygon.edge) near.push_back(plane_of(edge));
  }
  for (std::size_t c = 0; c < measures.size(); ++c) {
    const Real width = measures[c].width;
    if (width < tolerance) ++report.slivers;
    if (!is_doubtful(width, tolerance)) continue;
    const CellView cell = complex.cells[static_cast<Index>(c)];
    add_doubt(width, bounding_ball(cell).centre);
    const auto about = planes_about(cell, complex.planes);
    near.insert(near.end(), about.begin(), about.end());
  }
  for (const Fragment& f : complex.fragments)
    if (f.narrow && !complex.touches_sliver(f)) ++report.openings_closed;
  report.near_planes = names_on(complex, near, true);
  report.doubts_decide = report.doubts > 0 && doubts_decide(complex, measures, doubtful_glue);
  return report;
}

}  // namespace rockfold
