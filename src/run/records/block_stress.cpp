#include "src/run/records/block_stress.hpp"

#include <algorithm>

#include "kernels/operator/elements/part_functions.hpp"
#include "src/base/vector.hpp"
#include "src/io/viewers/stress_measures.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

/// A part of a regular cell, or a piece of a cut element.
struct Piece {
  Index element, block, material;
  Real volume;    ///< m³ of rock that it stands for
  Vec3 centroid;  ///< m
};

template <typename Visit>
void for_each_piece(const CoverArrays& covers, const PieceMoments& moments, const Visit& visit) {
  const LatticeFunctions all = lattice_functions(covers);
  for (Index r = 0; r < covers.regular_count(); ++r) {
    const Index cell = covers.regular_cell[r];
    const int first = all.parts * form_of_cell(covers.lattice, cell);
    for (int t = 0; t < all.parts; ++t) {
      Vec3 centroid{};
      for (int a = 0; a < all.nodes; ++a)
        centroid += (1.0 / all.nodes) * covers.lattice.node_position(covers.lattice.cell_node(
                                            cell, all.part[first + t].node[a]));
      visit(Piece{all.parts * r + t, covers.regular_block[r], covers.regular_material[r],
                  all.part[first + t].moment[0], centroid});
    }
  }
  const Index whole = all.parts * covers.regular_count();
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
      const Real volume = moments.volume[q];
      const Vec3 offset = (volume > 0 ? 1 / volume : 0) * moments.first[q];
      visit(Piece{whole + e, covers.piece_block[q], covers.element_material[e], all.share * volume,
                  covers.lattice.cell_centre(covers.element_cell[e]) + offset});
    }
}

}  // namespace

std::vector<Stress> average_block_stress(const CoverArrays& covers, const PieceMoments& moments,
                                         const std::vector<Stress>& element_stress, Index blocks) {
  std::vector<Stress> sums(blocks);
  std::vector<Real> volumes(blocks, 0.0);
  for_each_piece(covers, moments, [&](const Piece& piece) {
    volumes[piece.block] += piece.volume;
    for (int k = 0; k < 6; ++k)
      sums[piece.block][k] += piece.volume * element_stress[piece.element][k];
  });
  for (Index b = 0; b < blocks; ++b)
    for (int k = 0; k < 6 && volumes[b] > 0; ++k) sums[b][k] /= volumes[b];
  return sums;
}

RockStrength find_strength(const CoverArrays& covers, const PieceMoments& moments,
                           const std::vector<Stress>& element_stress,
                           const std::vector<Material>& materials) {
  RockStrength found;
  if (std::none_of(materials.begin(), materials.end(), has_strength)) return found;
  for_each_piece(covers, moments, [&](const Piece& piece) {
    const Material& material = materials[piece.material];
    if (!has_strength(material)) return;
    const Real ratio = strength_ratio(element_stress[piece.element], material);
    if (ratio < 1) found.failed_volume += piece.volume;
    if (found.block == none || ratio < found.least_ratio) {
      found.least_ratio = ratio;
      found.point = piece.centroid;
      found.block = piece.block;
    }
  });
  return found;
}

}  // namespace rockfold
