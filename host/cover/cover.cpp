#include "host/cover/cover.hpp"

#include <algorithm>
#include <cmath>

#include "host/cover/centre_functions.hpp"
#include "host/cover/connect.hpp"
#include "host/cover/joint_tips.hpp"
#include "host/cover/lattice/piece_index.hpp"
#include "host/cover/lattice/pieces.hpp"
#include "host/cover/lattice/slivers.hpp"
#include "host/cover/whole_blocks.hpp"
#include "host/cut/cells/complex.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

// Corners of the box of all rock, about the table's centre.
std::vector<Vec3> rock_corners(const Complex& complex) {
  Vec3 low{}, high{};
  for (Index c = 0; c < complex.cells.size(); ++c)
    for (const Vertex& v : complex.cells[c].vertices)
      for (int d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], v.x[d]);
        high[d] = std::max(high[d], v.x[d]);
      }
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c)
    corners.push_back({(c & 1 ? high : low)[0], (c & 2 ? high : low)[1], (c & 4 ? high : low)[2]});
  return corners;
}

// Volume of the rock that stays, m³.
Real rock_volume(const Complex& complex) {
  Real volume = 0;
  for (Index c = 0; c < complex.cells.size(); ++c)
    if (complex.is_analysed(c)) volume += complex.moments[c].volume;
  return volume;
}

// A cell about each block's centroid; the edges only scale the cover functions.
Lattice block_lattice(const Complex& complex, const CoverSpec& cover) {
  std::vector<Real> volume(complex.block_count, 0);
  std::vector<Vec3> first(complex.block_count, Vec3{});
  for (Index c = 0; c < complex.cells.size(); ++c) {
    volume[complex.cell_block[c]] += complex.moments[c].volume;
    first[complex.cell_block[c]] += complex.moments[c].first;
  }
  Lattice lattice;
  lattice.kind = LatticeKind::block;
  lattice.cells = {complex.block_count, 1, 1};
  for (Index b = 0; b < complex.block_count; ++b)
    lattice.block_origin.push_back((1 / volume[b]) * first[b] + complex.planes.centre());
  const Real size = std::cbrt(rock_volume(complex) / complex.block_count);
  for (int d = 0; d < 3; ++d)
    lattice.edge[d][d] = cover.spacing[2 - d] > 0 ? cover.spacing[2 - d] : size;
  return lattice;
}

LatticePlanes lay_lattice(const Complex& complex, const CoverSpec& cover, PlaneTable& planes) {
  if (cover.lattice == LatticeKind::block) return LatticePlanes(block_lattice(complex, cover));
  return {cover, rock_corners(complex), planes};
}

}  // namespace

// Each element is at most as large as the largest part.
void check_cover_size(const CoverSpec& cover, Real volume) {
  if (cover.lattice == LatticeKind::block) return;
  const CellSplit& split = cell_split(cover.lattice);
  Real largest = 0;  // of a lattice cell
  for (const CellPart& part : split.part) largest = std::max(largest, part_share(split, part));
  refuse_elements(
      cover, std::floor((1 - 1e-9) * volume / (largest * split.share * lattice_cell_volume(cover))),
      true);
}

Covering build_covers(const Cutting& cutting, const Model& model, Progress& progress) {
  const Complex& complex = *cutting.complex;
  const CoverSpec& cover = *model.cover;
  check_cover_size(cover, rock_volume(complex));
  PlaneTable planes(complex.planes);
  LatticePlanes lattice = lay_lattice(complex, cover, planes);
  Pieces pieces = cover.lattice == LatticeKind::block
                      ? block_pieces(complex, lattice)
                      : cut_pieces(complex, lattice, planes, progress);
  if (cover.joint_tips == JointTips::extend && cover.joints == JointTreatment::separate &&
      cover.lattice != LatticeKind::block && !heals_dead_ends(complex, model))
    extend_joint_tips(complex, model, lattice, planes, pieces);
  give_slivers_owners(complex, lattice, planes, pieces);
  Covering covering;
  covering.arrays.lattice = lattice.lattice();
  covering.arrays.order = cover.order;
  auto index = std::make_shared<PieceIndex>(std::move(planes), std::move(lattice));
  index->complex = cutting.complex;
  connect(complex, model, pieces, covering.arrays, *index);
  refuse_halved_blocks(cover, covering.arrays);
  refuse_parted_blocks(cover, covering.arrays);
  centre_functions(covering.arrays);
  if (cover.lattice == LatticeKind::block) index->build_piece_tree(covering.arrays);
  covering.pieces = std::move(index);
  return covering;
}

}  // namespace rockfold
