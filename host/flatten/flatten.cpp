#include "host/flatten/flatten.hpp"

#include <algorithm>
#include <map>

#include "host/cut/complex.hpp"
#include "host/flatten/block_surface.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// The boundary areas of each block: free parts, and joint fragments with another block behind them.
std::vector<std::vector<BoundaryArea>> areas_by_block(const Complex& complex) {
  std::vector<std::vector<BoundaryArea>> areas(complex.block_count);
  for (std::size_t i = 0; i < complex.fragments.size(); ++i) {
    const Fragment& f = complex.fragments[i];
    if (f.joint == none || complex.cell_block[f.cell[0]] == complex.cell_block[f.cell[1]]) continue;
    for (int s = 0; s < 2; ++s)
      areas[complex.cell_block[f.cell[s]]].push_back(
          {f.cell[s], f.face[s], f.joint, static_cast<Index>(i), none});
  }
  for (std::size_t i = 0; i < complex.free_parts.size(); ++i) {
    const FreePart& f = complex.free_parts[i];
    areas[complex.cell_block[f.cell]].push_back(
        {f.cell, f.face, f.origin, none, static_cast<Index>(i)});
  }
  return areas;
}

void append_surface(const BlockSurface& s, const Complex& complex, BlockArrays& out) {
  const auto loops = static_cast<Index>(out.corner_begin.size()) - 1;
  const auto corners = static_cast<Index>(out.corner_vertex.size());
  const auto vertices = static_cast<Index>(out.vertex.size());
  bool finite = true;
  for (const auto& f : s.faces) {
    const Vec3& n = complex.planes.normal(plane_of(f.inside));
    out.face_normal.push_back(is_above(f.inside) ? -n : n);
    out.face_area.push_back(f.area);
    out.face_origin.push_back(f.origin);
    out.face_up.push_back(is_above(f.inside) ? 0 : 1);
    out.face_plane.push_back(plane_of(f.inside));
    finite = finite && !complex.origins[f.origin].continues;
  }
  for (std::size_t i = 1; i < s.loop_begin.size(); ++i)
    out.loop_begin.push_back(loops + s.loop_begin[i]);
  for (std::size_t i = 1; i < s.corner_begin.size(); ++i)
    out.corner_begin.push_back(corners + s.corner_begin[i]);
  for (const Index v : s.corner_vertex) out.corner_vertex.push_back(vertices + v);
  for (const Vec3& x : s.vertices) out.vertex.push_back(x + complex.planes.centre());
  out.face_begin.push_back(static_cast<Index>(out.face_normal.size()));
  out.vertex_begin.push_back(static_cast<Index>(out.vertex.size()));
  out.edge_count.push_back(s.edge_count);
  out.shell_count.push_back(s.shell_count);
  out.genus.push_back(s.genus);
  out.convex.push_back(s.convex);
  out.finite.push_back(finite);
}

// Joints that end inside a block: convex polygons, as seen from above their planes.
void add_dead_ends(const Complex& complex, BlockArrays& out) {
  out.dead_end_area.assign(complex.block_count, 0);
  out.dead_end_corner_begin = {0};
  for (const Fragment& f : complex.fragments) {
    const Index block = complex.cell_block[f.cell[0]];
    if (f.joint == none || block != complex.cell_block[f.cell[1]]) continue;
    out.dead_end_area[block] += f.area;
    out.dead_end_block.push_back(block);
    out.dead_end_origin.push_back(f.joint);
    for (const Vertex& v : complex.polygon_of(f).corner)
      out.dead_end_vertex.push_back(v.x + complex.planes.centre());
    out.dead_end_corner_begin.push_back(static_cast<Index>(out.dead_end_vertex.size()));
  }
}

void add_bulk(const Complex& complex, const Model& model, BlockArrays& out) {
  std::vector<Vec3> first(complex.block_count);
  std::vector<std::map<Index, Real>> by_material(complex.block_count);
  out.volume.assign(complex.block_count, 0);
  out.mass.assign(complex.block_count, 0);
  out.stage.assign(complex.block_count, 0);
  for (Index c = 0; c < complex.cells.size(); ++c) {
    const Index b = complex.cell_block[c];
    out.volume[b] += complex.moments[c].volume;
    out.stage[b] = complex.zone(c).stage;  // one for all cells of a block
    first[b] += complex.moments[c].first;
    const Index material = model.solids[complex.zone(c).solid].material;
    by_material[b][material] += complex.moments[c].volume;
    if (material != none && material < static_cast<Index>(model.materials.size()))
      out.mass[b] += model.materials[material].density * complex.moments[c].volume;
  }
  for (Index b = 0; b < complex.block_count; ++b) {
    out.centroid.push_back((1 / out.volume[b]) * first[b] + complex.planes.centre());
    const auto largest =
        std::max_element(by_material[b].begin(), by_material[b].end(),
                         [](const auto& x, const auto& y) { return x.second < y.second; });
    out.material.push_back(largest->first);
  }
}

void add_interfaces(const Complex& complex, const std::vector<std::vector<BoundaryArea>>& areas,
                    const std::vector<BlockSurface>& surfaces, BlockArrays& out) {
  std::vector<std::array<Index, 2>> face_of_fragment(complex.fragments.size(), {none, none});
  for (std::size_t b = 0; b < areas.size(); ++b)
    for (std::size_t i = 0; i < areas[b].size(); ++i) {
      const BoundaryArea& a = areas[b][i];
      if (a.fragment == none) continue;
      const int side = complex.fragments[a.fragment].cell[0] == a.cell ? 0 : 1;
      face_of_fragment[a.fragment][side] = out.face_begin[b] + surfaces[b].face_of_area[i];
    }
  for (std::size_t i = 0; i < complex.fragments.size(); ++i) {
    if (face_of_fragment[i][0] == none) continue;
    BlockArrays::Interface shared;
    for (int s = 0; s < 2; ++s) {
      shared.block[s] = complex.cell_block[complex.fragments[i].cell[s]];
      shared.face[s] = face_of_fragment[i][s];
    }
    if (shared.block[0] > shared.block[1]) {
      std::swap(shared.block[0], shared.block[1]);
      std::swap(shared.face[0], shared.face[1]);
    }
    shared.area = complex.fragments[i].area;
    out.interfaces.push_back(shared);
  }
  const auto key = [](const BlockArrays::Interface& i) {
    return std::tie(i.block[0], i.face[0], i.block[1], i.face[1]);
  };
  std::stable_sort(out.interfaces.begin(), out.interfaces.end(),
                   [&](const auto& a, const auto& b) { return key(a) < key(b); });
  std::vector<BlockArrays::Interface> merged;
  for (const auto& i : out.interfaces) {
    if (!merged.empty() && key(merged.back()) == key(i))
      merged.back().area += i.area;
    else
      merged.push_back(i);
  }
  out.interfaces = std::move(merged);
}

}  // namespace

BlockArrays flatten_blocks(const Cutting& cutting, const Model& model) {
  const Complex& complex = *cutting.complex;
  const auto areas = areas_by_block(complex);
  std::vector<BlockSurface> surfaces(areas.size());
  parallel_for(static_cast<std::int64_t>(areas.size()), 64,
               [&](std::int64_t b) { surfaces[b] = make_block_surface(complex, areas[b]); });

  BlockArrays out;
  out.origins = complex.origins;
  out.face_begin = out.vertex_begin = out.loop_begin = out.corner_begin = {0};
  add_bulk(complex, model, out);
  add_dead_ends(complex, out);
  for (const BlockSurface& s : surfaces) append_surface(s, complex, out);
  add_interfaces(complex, areas, surfaces, out);
  return out;
}

}  // namespace rockfold
