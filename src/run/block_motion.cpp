#include "src/run/block_motion.hpp"

#include "kernels/solve/tet_weights.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Sums over the pieces of a block: displacement and rotation times volume until they are divided by it.
class Averages {
 public:
  Averages(const Lattice& lattice, Index blocks) : tets_(tet_weights(lattice)), sums_(blocks) {}

  const TetWeights& tet(int t) const { return tets_[t]; }

  /// A part of tetrahedron t whose corners move by d[a]: ∫ N_a dV = constant_a V + gradient_a · first moment.
  void add(Index block, int t, Real volume, const Vec3& first, const Vec3* const (&d)[4]) {
    BlockMotion& sum = sums_[block];
    sum.volume += volume;
    for (int a = 0; a < 4; ++a) {
      const Real share = tets_[t].constant[a] * volume + dot(tets_[t].gradient[a], first);
      sum.displacement += share * *d[a];
      // Half the curl of N_a d_a; differences to corner 0, so that a translation turns nothing.
      sum.rotation += (0.5 * volume) * cross(tets_[t].gradient[a], *d[a] - *d[0]);
    }
  }

  std::vector<BlockMotion> take() {
    for (BlockMotion& block : sums_) {
      if (!(block.volume > 0)) continue;
      block.displacement = (1 / block.volume) * block.displacement;
      block.rotation = (1 / block.volume) * block.rotation;
    }
    return std::move(sums_);
  }

 private:
  std::array<TetWeights, 6> tets_;
  std::vector<BlockMotion> sums_;
};

}  // namespace

std::vector<BlockMotion> average_block_motion(const CoverArrays& covers,
                                              const PieceMoments& moments,
                                              const std::vector<Vec3>& displacement, Index blocks) {
  Averages sums(covers.lattice, blocks);
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int t = 0; t < 6; ++t) {
      const Vec3* d[4];
      for (int a = 0; a < 4; ++a)
        d[a] = &displacement[covers.regular_cover[8 * r + tet6_corner[t][a]]];
      sums.add(covers.regular_block[r], t, sums.tet(t).volume, sums.tet(t).first, d);
    }
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const Vec3* d[4];
    for (int a = 0; a < 4; ++a) d[a] = &displacement[covers.element_cover[4 * e + a]];
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      sums.add(covers.piece_block[q], covers.element_part[e], moments.volume[q], moments.first[q],
               d);
  }
  return sums.take();
}

LargestDisplacement find_largest_displacement(const CoverArrays& covers,
                                              const std::vector<Vec3>& displacement) {
  LargestDisplacement largest;
  const auto offer = [&](const Vec3& u, const Vec3& point, Index block) {
    if (largest.block == none || norm(u) > largest.length) largest = {norm(u), point, block};
  };
  for (Index r = 0; r < covers.regular_count(); ++r) {
    const auto cell = covers.lattice.cell_ijk(covers.regular_cell[r]);
    for (int c = 0; c < 8; ++c)
      offer(displacement[covers.regular_cover[8 * r + c]],
            covers.lattice.node_position(
                {cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2 & 1)}),
            covers.regular_block[r]);
  }
  const auto weights = tet_weights(covers.lattice);
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const TetWeights& tet = weights[covers.element_part[e]];
    const Vec3 centre = covers.lattice.cell_centre(covers.element_cell[e]);
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      for (Index v = covers.vertex_begin[q]; v < covers.vertex_begin[q + 1]; ++v) {
        const Vec3 x{covers.vertex_xyz[3 * v], covers.vertex_xyz[3 * v + 1],
                     covers.vertex_xyz[3 * v + 2]};
        Vec3 u{};
        for (int a = 0; a < 4; ++a)
          u += (tet.constant[a] + dot(tet.gradient[a], x)) *
               displacement[covers.element_cover[4 * e + a]];
        offer(u, centre + x, covers.piece_block[q]);
      }
  }
  return largest;
}

}  // namespace rockfold
