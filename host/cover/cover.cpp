#include "host/cover/cover.hpp"

#include "host/cover/connect.hpp"
#include "host/cover/piece_index.hpp"
#include "host/cover/pieces.hpp"
#include "host/cut/complex.hpp"
#include "src/base/error.hpp"

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

}  // namespace

Covering build_covers(const Cutting& cutting, const Model& model, Progress& progress) {
  const Complex& complex = *cutting.complex;
  PlaneTable planes = complex.planes;
  LatticePlanes lattice(*model.cover, rock_corners(complex), planes);
  const Pieces pieces = cut_pieces(complex, lattice, planes, progress);

  Covering covering;
  covering.arrays.lattice = lattice.lattice();
  auto index = std::make_shared<PieceIndex>(std::move(planes), std::move(lattice));
  connect(complex, model, pieces, model.cover->joints == JointTreatment::welded, covering.arrays,
          *index);
  covering.pieces = std::move(index);
  return covering;
}

}  // namespace rockfold
