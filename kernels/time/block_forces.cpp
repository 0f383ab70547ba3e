#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "kernels/device/sums_kernel.hpp"
#include "kernels/time/block_forces_kernel.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::motion {
namespace {

/// [unknowns] the block of each; functions follow each other, covers within them.
std::vector<Index> blocks_of_unknowns(const CoverArrays& covers) {
  std::vector<Index> block(covers.unknown_count(), 0);
  const Index count = covers.cover_count();
  for (Index e = 0; e < covers.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(covers, e);
    for (int a = 0; a < covers.nodes_per_part(); ++a) block[nodes.cover[a]] = block_of(covers, e);
  }
  for (std::size_t p = count; p < block.size(); ++p) block[p] = block[p % count];
  return block;
}

}  // namespace

BlockForces make_block_forces(const CoverArrays& covers) {
  const std::vector<Index> block = blocks_of_unknowns(covers);
  std::vector<Index> unknown(block.size());
  std::iota(unknown.begin(), unknown.end(), 0);
  std::stable_sort(unknown.begin(), unknown.end(),
                   [&](Index p, Index q) { return block[p] < block[q]; });
  std::vector<Index> chunk, block_begin;
  Index last = none;
  for (std::size_t i = 0; i < unknown.size(); ++i) {
    const Index b = block[unknown[i]], at = static_cast<Index>(i);
    if (b != last) block_begin.push_back(static_cast<Index>(chunk.size()));
    if (b != last || at - chunk.back() == device::chunk_length) chunk.push_back(at);
    last = b;
  }
  block_begin.push_back(static_cast<Index>(chunk.size()));
  chunk.push_back(static_cast<Index>(unknown.size()));
  BlockForces of_blocks;
  of_blocks.blocks = static_cast<Index>(block_begin.size()) - 1;
  of_blocks.acting = device::Array<Real>("rockfold::motion::acting", unknown.size());
  of_blocks.unknown = device::to_device("motion::unknown_of_block", unknown);
  of_blocks.chunk = device::to_device("motion::chunk", chunk);
  of_blocks.block_begin = device::to_device("motion::block_begin", block_begin);
  of_blocks.sum = device::Array<Real>("rockfold::motion::block_sum", 2 * chunk.size());
  return of_blocks;
}

BlockBalance find_balance(const BlockForces& of_blocks, const device::Field& right,
                          const device::Field& supports, Real share, Real least) {
  const BlockForces b = of_blocks;
  device::for_each(
      "rockfold::motion::chunk_balance", static_cast<Index>(b.chunk.extent(0)) - 1,
      KOKKOS_LAMBDA(const Index c) {
        Real acting = 0, square = 0;
        for (Index i = b.chunk(c); i < b.chunk(c + 1); ++i) {
          const Index p = b.unknown(i);
          Real of_supports = 0;
          for (int d = 0; d < 3; ++d) {
            const Real left = right(p, d) + supports(p, d);
            square += left * left;
            of_supports += supports(p, d) * supports(p, d);
          }
          acting += b.acting(p) + device::math::sqrt(of_supports);
        }
        b.sum(2 * c) = acting;
        b.sum(2 * c + 1) = square;
      },
      1);
  BlockBalance balance;
  Kokkos::parallel_reduce(
      "rockfold::motion::block_balance", device::Range(0, b.blocks),
      KOKKOS_LAMBDA(const Index k, Real& worst, Real& wanted) {
        Real acting = 0, square = 0;
        for (Index c = b.block_begin(k); c < b.block_begin(k + 1); ++c) {
          acting += b.sum(2 * c);
          square += b.sum(2 * c + 1);
        }
        const Real left = device::math::sqrt(square);
        const Real enough = device::math::fmax(share * acting, least);
        if (left == 0) return;
        worst = device::math::fmax(
            worst, enough > 0 ? left / enough : std::numeric_limits<Real>::infinity());
        if (!(left <= enough)) wanted = device::math::fmin(wanted, enough);
      },
      Kokkos::Max<Real>(balance.worst), Kokkos::Min<Real>(balance.wanted));
  return balance;
}

}  // namespace rockfold::motion
