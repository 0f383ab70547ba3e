#include "host/cut/bodies/numbering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Coordinates are compared in units of 1e-9 of the model's size, so that rounding does not shuffle a regular pattern.
std::vector<Index> ranks_by_centroid(const std::vector<CellMoments>& moments, Real unit) {
  struct Placed {
    std::array<Real, 3> key;
    Index block;
    bool operator<(const Placed& o) const {
      return std::tie(key, block) < std::tie(o.key, o.block);
    }
  };
  std::vector<Placed> order(moments.size());
  for (std::size_t b = 0; b < moments.size(); ++b) {
    order[b].block = static_cast<Index>(b);
    for (int d = 0; d < 3; ++d)
      order[b].key[d] = std::round(moments[b].first[2 - d] / moments[b].volume / unit);
  }
  std::sort(order.begin(), order.end());
  std::vector<Index> rank(moments.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i].block] = static_cast<Index>(i);
  return rank;
}

}  // namespace

NumberedBlocks number_blocks(const Complex& complex, const std::vector<Index>& part) {
  const Index n = complex.cells.size();
  NumberedBlocks blocks;
  blocks.of_cell.resize(n);
  std::vector<Index> number(n, none);  // [parts]
  std::vector<CellMoments> sum;
  for (Index c = 0; c < n; ++c) {
    Index& block = number[part[c]];
    if (block == none) {
      block = static_cast<Index>(sum.size());
      sum.emplace_back();
    }
    blocks.of_cell[c] = block;
    sum[block].volume += complex.moments[c].volume;
    sum[block].first += complex.moments[c].first;
  }
  const std::vector<Index> rank = ranks_by_centroid(sum, complex.planes.width_tolerance());
  for (Index& b : blocks.of_cell) b = rank[b];
  blocks.moments.resize(sum.size());
  for (std::size_t b = 0; b < sum.size(); ++b) blocks.moments[rank[b]] = sum[b];
  return blocks;
}

}  // namespace rockfold
