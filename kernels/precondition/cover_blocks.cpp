#include "kernels/precondition/cover_blocks_kernel.hpp"

namespace rockfold::solve {
namespace {

constexpr int most_entries = most_block_width * most_block_width;

/// αK + βM of a cover with itself.
KOKKOS_INLINE_FUNCTION void own_matrix(const DeviceBlocks& block, const DeviceStencil& stencil,
                                       Index place, const Combination& c, int n, Real* a) {
  const int width = 3 * n;
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) {
      const Real* v;
      int step;
      if (place >= 0) {
        v = block.diagonals(place / slice_lanes, k, l) + place % slice_lanes;
        step = slice_lanes;
      } else {
        const Index run = -1 - place;
        v = stencil.of_run(run) + stencil.entry(stencil.run_offsets(run), k, 0, l);
        step = 1;
      }
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          a[(3 * k + i) * width + 3 * l + j] = c.entry(v, 3 * i + j, step);
    }
}

}  // namespace

CoverBlocks make_cover_blocks(Index covers, int functions) {
  CoverBlocks blocks;
  blocks.covers = covers;
  blocks.functions = functions;
  blocks.inverse = device::allocate<Real>(
      "solve::cover_blocks", static_cast<std::size_t>(covers) * blocks.width() * blocks.width());
  blocks.scale = device::make_field("solve::cover_scale", covers * functions);
  return blocks;
}

Array<Index> cover_places(const Operator& op) {
  auto place = device::allocate<Index>("solve::cover_place", op.covers);
  const DeviceStencil stencil = op.stencil;
  const auto row = op.block.row;
  device::for_each(
      "rockfold::solve::place_blocks", op.block.slots(), KOKKOS_LAMBDA(const Index slot) {
        if (row(slot) != none) place(row(slot)) = slot;
      });
  device::for_each(
      "rockfold::solve::place_runs", stencil.runs(), KOKKOS_LAMBDA(const Index run) {
        for (Index i = 0; i < stencil.length(run); ++i)
          place(stencil.first(run) + stencil.stride * i) = -1 - run;
      });
  return place;
}

void invert_cover_blocks(const CoverBlocks& blocks, const PointTerms& terms,
                         const PointTerms& contacts) {
  const CoverBlocks to = blocks;
  device::for_each(
      "rockfold::solve::invert_cover_blocks", to.covers,
      KOKKOS_LAMBDA(const Index p) {
        Real a[most_entries];
        const int n = to.functions, width = to.width();
        Real* inverse = &to.inverse(static_cast<std::size_t>(p) * width * width);
        for (int e = 0; e < width * width; ++e) a[e] = inverse[e];
        if (terms.any()) add_terms(terms, p, to.covers, n, a);
        if (contacts.any()) add_terms(contacts, p, to.covers, n, a);
        for (int i = 0; i < width; ++i) {
          const Real d = a[i * width + i];
          to.scale(i / 3 * to.covers + p, i % 3) = d > 0 ? 1 / device::math::sqrt(d) : 0;
        }
        for (int i = 0; i < width; ++i)
          for (int j = 0; j < width; ++j)
            a[i * width + j] *=
                to.scale(i / 3 * to.covers + p, i % 3) * to.scale(j / 3 * to.covers + p, j % 3);
        invert_symmetric(width, a);
        for (int i = 0; i < width; ++i)
          for (int j = 0; j < width; ++j)
            inverse[i * width + j] = i <= j ? a[i * width + j] : a[j * width + i];
      },
      blocks.width() * blocks.width());
}

void set_values(const CoverBlocks& blocks, const Operator& op, const PointTerms& terms,
                const Combination& c, const PointTerms& contacts) {
  const CoverBlocks to = blocks;
  const DeviceStencil stencil = op.stencil;
  const DeviceBlocks block = op.block;
  const auto place = cover_places(op);
  device::for_each(
      "rockfold::solve::cover_blocks", op.covers, KOKKOS_LAMBDA(const Index p) {
        const int width = to.width();
        own_matrix(block, stencil, place(p), c, to.functions,
                   &to.inverse(static_cast<std::size_t>(p) * width * width));
      });
  invert_cover_blocks(blocks, terms, contacts);
}

}  // namespace rockfold::solve
