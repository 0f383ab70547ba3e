#include "host/flatten/bulk.hpp"

#include <algorithm>

#include "host/flatten/grouping.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Index block_chunk = 1024;
constexpr Index fragment_chunk = 65536;

// How much of a block is of a material.
struct Share {
  Index material;
  Real volume;
};

void add_share(std::vector<Share>& shares, Index material, Real volume) {
  const auto at = std::lower_bound(shares.begin(), shares.end(), material,
                                   [](const Share& share, Index m) { return share.material < m; });
  if (at != shares.end() && at->material == material)
    at->volume += volume;
  else
    shares.insert(at, {material, volume});
}

void add_block(const Complex& complex, const Model& model, Index b, std::span<const Index> cells,
               std::vector<Share>& shares, BlockArrays& out) {
  Real volume = 0, mass = 0;
  Vec3 first{};
  shares.clear();
  for (const Index c : cells) {
    const CellMoments& m = complex.moments[c];
    volume += m.volume;
    first += m.first;
    const Index material = model.solids[complex.zone(c).solid].material;
    add_share(shares, material, m.volume);
    if (material != none && material < static_cast<Index>(model.materials.size()))
      mass += model.materials[material].density * m.volume;
  }
  out.volume[b] = volume;
  out.mass[b] = mass;
  out.stage[b] = complex.block_stage[b];
  out.centroid[b] = (1 / volume) * first + complex.planes.centre();
  out.material[b] =
      std::max_element(shares.begin(), shares.end(), [](const Share& x, const Share& y) {
        return x.volume < y.volume;
      })->material;
}

// Fragments of joints with one block on both sides, ascending.
std::vector<Index> dangling_fragments(const Complex& complex) {
  const auto count = static_cast<Index>(complex.fragments.size());
  const Index chunks = (count + fragment_chunk - 1) / fragment_chunk;
  std::vector<std::vector<Index>> found(chunks);
  parallel_for(chunks, 1, [&](std::int64_t k) {
    const auto begin = static_cast<Index>(k * fragment_chunk);
    for (Index i = begin; i < std::min(begin + fragment_chunk, count); ++i) {
      if (complex.fragments[i].dead_end) found[k].push_back(i);
    }
  });
  std::vector<Index> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

void add_bulk(const Complex& complex, const BlockOrder& order, const Model& model,
              BlockArrays& out) {
  const Index blocks = complex.block_count;
  const Grouping cells =
      group_items(complex.cells.size(), blocks, [&](Index c) { return order.rank_of_cell[c]; });
  for (auto* array : {&out.volume, &out.mass}) array->resize(blocks);
  for (auto* array : {&out.stage, &out.material}) array->resize(blocks);
  out.centroid.resize(blocks);
  parallel_for((blocks + block_chunk - 1) / block_chunk, 1, [&](std::int64_t k) {
    std::vector<Share> shares;
    const auto begin = static_cast<Index>(k * block_chunk);
    for (Index r = begin; r < std::min(begin + block_chunk, blocks); ++r)
      add_block(complex, model, order.block[r], cells[r], shares, out);
  });
}

void add_dead_ends(const Complex& complex, BlockArrays& out) {
  out.dead_end_area.assign(complex.block_count, 0);
  out.dead_end_corner_begin = {0};
  for (const Index i : dangling_fragments(complex)) {
    const Fragment& f = complex.fragments[i];
    const Index block = complex.cell_block[f.cell[0]];
    out.dead_end_area[block] += f.area;
    out.dead_end_block.push_back(block);
    out.dead_end_origin.push_back(f.joint);
    for (const Vertex& v : complex.polygon_of(f).corner)
      out.dead_end_vertex.push_back(v.x + complex.planes.centre());
    out.dead_end_corner_begin.push_back(static_cast<Index>(out.dead_end_vertex.size()));
  }
}

}  // namespace rockfold
