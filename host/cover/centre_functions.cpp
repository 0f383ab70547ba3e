#include "host/cover/centre_functions.hpp"

#include <algorithm>
#include <limits>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// In units of the edges.
struct Box {
  Vec3 low, high;
  Vec3 size() const { return high - low; }
};

/// [P] of the rock that each cover holds, about its node.
std::vector<Box> find_boxes(const CoverArrays& covers) {
  constexpr Real far = std::numeric_limits<Real>::max();
  std::vector<Box> boxes(covers.cover_count(), {{far, far, far}, {-far, -far, -far}});
  const Lattice& lattice = covers.lattice;
  const Index nodes = covers.nodes_per_part();
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const CellSplit& split = lattice.split(covers.element_cell[e]);
    const CellPart& part = split.part[covers.element_part[e]];
    for (Index v = covers.vertex_begin[covers.piece_begin[e]];
         v < covers.vertex_begin[covers.piece_begin[e + 1]]; ++v) {
      const Vec3 eta = lattice.to_local(
          {covers.vertex_xyz[3 * v], covers.vertex_xyz[3 * v + 1], covers.vertex_xyz[3 * v + 2]});
      for (int a = 0; a < part.nodes; ++a) {
        Box& box = boxes[covers.element_cover[nodes * e + a]];
        const HalfSteps& at = split.node[part.node[a]];
        for (int d = 0; d < 3; ++d) {
          const Real xi = eta[d] - (0.5 * at[d] - 0.5);
          box.low[d] = std::min(box.low[d], xi);
          box.high[d] = std::max(box.high[d], xi);
        }
      }
    }
  }
  return boxes;
}

}  // namespace

void centre_functions(CoverArrays& covers) {
  if (covers.order == 0 || covers.lattice.kind == LatticeKind::block || covers.regular_count() > 0)
    return;
  const std::vector<Box> boxes = find_boxes(covers);
  Real widest = 0;
  for (const Box& box : boxes) {
    const Vec3 size = box.size();
    widest = std::max({widest, size[0], size[1], size[2]});
  }
  if (!(widest > 0) || widest > 1) return;
  covers.reach = 0.5 * widest;
  for (const Box& box : boxes) covers.middle.push_back(0.5 * (box.low + box.high));
}

}  // namespace rockfold
