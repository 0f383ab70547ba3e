#include "host/cut/cut.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "host/cut/adjacency.hpp"
#include "host/cut/complex.hpp"
#include "host/cut/subdivide.hpp"
#include "host/cut/surfaces.hpp"
#include "host/cut/union_find.hpp"
#include "host/parallel.hpp"
#include "host/refuse.hpp"
#include "src/base/error.hpp"
#include "src/base/sum.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

bool lies_inside(const CellView& cell, const ConvexBody& body, const PlaneTable& planes) {
  IntentCount ignored;  // counted when the solids' faces cut
  for (const HalfSpaceId h : body.inside)
    for (const Vertex& v : cell.vertices)
      if (planes.side(v, plane_of(h), ignored) == (is_above(h) ? -1 : 1)) return false;
  return true;
}

// The block operations in their order: the solid whose rock a cell is, or none. A cell lies wholly inside or outside
// each solid, since all of their faces have cut.
Index rock_of(const CellView& cell, const Complex& complex, const Model& model) {
  Index rock = none;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    if (!model.solids[s].add && rock == none) continue;
    if (lies_inside(cell, complex.bodies[s], complex.planes))
      rock = model.solids[s].add ? static_cast<Index>(s) : none;
  }
  return rock;
}

// A box that holds all rock with a margin, so that none of its planes is one of the model's.
CellStore enclosing_cell(CuttingInput& input) {
  const Real margin = 0.125 * norm(input.box_max - input.box_min);
  const Vec3 m{margin, margin, margin};
  CellStore store;
  store.append(make_box(input.complex.planes, input.box_min - m, input.box_max + m));
  return store;
}

struct Rock {
  CellStore cells;
  std::vector<Index> body;
  Sum volume;
};

Rock keep_rock(const CellStore& cells, const Complex& complex, const Model& model) {
  Rock rock;
  for (Index c = 0; c < cells.size(); ++c) {
    const Index body = rock_of(cells[c], complex, model);
    if (body == none) continue;
    rock.cells.append(cells[c]);
    rock.body.push_back(body);
    rock.volume += cell_moments(cells[c], complex.planes).volume;
  }
  if (rock.cells.size() == 0)
    refuse(model.solids.back().place, "solid", "the block operations leave no rock");
  return rock;
}

// Takes over the cells with their moments. A cell without positive volume is a trace of planes that
// nearly meet in one point, within the tolerance; it is left out and counted as a near decision.
Index take_cells(const Subdivision& jointed, const std::vector<Index>& body, Complex& complex) {
  const Index n = jointed.cells.size();
  std::vector<CellMoments> moments(n);
  parallel_for(n, 256, [&](std::int64_t c) {
    moments[c] = cell_moments(jointed.cells[static_cast<Index>(c)], complex.planes);
  });
  for (Index c = 0; c < n; ++c) {
    if (!(moments[c].volume > 0)) continue;
    complex.cells.append(jointed.cells[c]);
    complex.cell_body.push_back(body[jointed.parent[c]]);
    complex.moments.push_back(moments[c]);
  }
  return n - complex.cells.size();
}

// Blocks are the components of cells over virtual fragments, ordered by centroid (z, then y, then x). Coordinates are
// compared in units of 1e-9 of the model's size, so that rounding does not shuffle a regular pattern.
void find_blocks(Complex& complex) {
  const Index n = complex.cells.size();
  UnionFind parts(n);
  for (const Fragment& f : complex.fragments)
    if (f.joint == none) parts.join(f.cell[0], f.cell[1]);
  complex.cell_block = parts.components();
  complex.block_count =
      n == 0 ? 0 : 1 + *std::max_element(complex.cell_block.begin(), complex.cell_block.end());

  std::vector<CellMoments> sum(complex.block_count);
  for (Index c = 0; c < n; ++c) {
    sum[complex.cell_block[c]].volume += complex.moments[c].volume;
    sum[complex.cell_block[c]].first += complex.moments[c].first;
  }
  const Real unit = 1e-9 * complex.planes.model_size();
  std::vector<std::array<Real, 3>> key(sum.size());
  for (std::size_t b = 0; b < sum.size(); ++b)
    for (int d = 0; d < 3; ++d) key[b][d] = std::round(sum[b].first[2 - d] / sum[b].volume / unit);
  std::vector<Index> order(sum.size()), rank(sum.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key[a] < key[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = static_cast<Index>(i);
  for (Index& b : complex.cell_block) b = rank[b];
}

IntentReport intent_report(const Complex& complex, const IntentCount& count,
                           Index planes_identified) {
  IntentReport report;
  report.planes_identified = planes_identified;
  report.vertices_identified = count.vertices_identified;
  report.near_decisions = count.near_decisions;
  std::set<std::string> names;
  for (const Index plane : std::set<Index>(count.near_planes.begin(), count.near_planes.end())) {
    if (plane < static_cast<Index>(complex.joint_of_plane.size()) &&
        complex.joint_of_plane[plane] != none)
      names.insert(complex.origins[complex.joint_of_plane[plane]].name);
    for (const ConvexBody& body : complex.bodies)
      for (std::size_t f = 0; f < body.inside.size(); ++f)
        if (plane_of(body.inside[f]) == plane)
          names.insert(complex.origins[body.first_origin + f].name);
  }
  report.near_planes.assign(names.begin(), names.end());
  if (report.near_planes.size() > 20) report.near_planes.resize(20);
  return report;
}

}  // namespace

Cutting cut_blocks(const Model& model, Progress& progress) {
  CuttingInput input = make_surfaces(model);
  const CellStore start = enclosing_cell(input);
  Progress silent;
  Subdivision solids = subdivide(input.complex.planes, start, input.solid_faces, silent);
  const Rock rock = keep_rock(solids.cells, input.complex, model);

  Subdivision jointed = subdivide(input.complex.planes, rock.cells, input.joints, progress);
  auto complex = std::make_shared<Complex>(std::move(input.complex));
  IntentCount intent = solids.intent;
  intent.add(jointed.intent);
  intent.near_decisions += take_cells(jointed, rock.body, *complex);
  jointed = {};
  intent.add(find_adjacency(*complex));
  find_blocks(*complex);

  Cutting cutting;
  cutting.totals.cells = complex->cells.size();
  cutting.totals.solid_volume = rock.volume.value();
  Sum joint_area, dangling_joint_area;
  for (const Fragment& f : complex->fragments) {
    if (f.joint == none) continue;
    joint_area += f.area;
    if (complex->cell_block[f.cell[0]] == complex->cell_block[f.cell[1]])
      dangling_joint_area += f.area;
  }
  cutting.totals.joint_area = joint_area.value();
  cutting.totals.dangling_joint_area = dangling_joint_area.value();
  cutting.totals.intent = intent_report(*complex, intent, input.planes_identified);
  cutting.complex = std::move(complex);
  return cutting;
}

}  // namespace rockfold
