#include "host/cover/lattice_walk.hpp"

#include <algorithm>

namespace rockfold {

namespace {

// The direction in which a range is longest, and the plane in its middle.
struct Cut {
  int axis;
  Index at;
};
Cut middle(const LatticeBox& box) {
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (box.high[d] - box.low[d] > box.high[axis] - box.low[axis]) axis = d;
  return {axis, box.low[axis] + (box.high[axis] - box.low[axis]) / 2};
}

std::pair<LatticeBox, LatticeBox> halves(const LatticeBox& box, const Cut& cut) {
  LatticeBox low = box, high = box;
  low.high[cut.axis] = high.low[cut.axis] = cut.at;
  return {low, high};
}

}  // namespace

void LatticeWalker::walk(const CellView& cell, const CellVisitor& visitor) {
  descend(0, cell, lattice_.range(cell.vertices), visitor);
}

void LatticeWalker::walk(const Polygon& polygon, HalfSpaceId side, const PolygonVisitor& visitor) {
  descend(polygon, side, lattice_.range(polygon.corner), visitor);
}

bool LatticeWalker::is_whole(const CellView& cell, const LatticeBox& box) const {
  if (cell.faces.size() != 6) return false;
  return std::all_of(cell.faces.begin(), cell.faces.end(), [&](const ConvexCell::Face& face) {
    for (int d = 0; d < 3; ++d)
      if (face.inside == lattice_.upper(d, box.low[d]) ||
          face.inside == (lattice_.upper(d, box.high[d]) ^ 1))
        return true;
    return false;
  });
}

void LatticeWalker::descend(std::size_t depth, const CellView& cell, LatticeBox box,
                            const CellVisitor& visitor) {
  while (true) {
    if (is_whole(cell, box)) return visitor.whole(box);
    if (box.single()) return split_tetrahedra(cell, box.low, visitor);
    const Cut cut = middle(box);
    const HalfSpaceId upper = lattice_.upper(cut.axis, cut.at);
    const auto [low, high] = halves(box, cut);
    const CellSide side = splitter_.classify(cell, plane_of(upper));
    if (side != CellSide::split) {
      box = (side == CellSide::above) == is_above(upper) ? high : low;
      continue;
    }
    if (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
    Level& level = *levels_[depth];
    splitter_.split(cell, plane_of(upper), &level.below, &level.above);
    descend(depth + 1, is_above(upper) ? level.below : level.above, low, visitor);
    descend(depth + 1, is_above(upper) ? level.above : level.below, high, visitor);
    return;
  }
}

void LatticeWalker::split_tetrahedra(const CellView& cell, const std::array<Index, 3>& lattice_cell,
                                     const CellVisitor& visitor) {
  for (int t = 0; t < 6; ++t) {
    piece_.vertices.assign(cell.vertices.begin(), cell.vertices.end());
    piece_.faces.assign(cell.faces.begin(), cell.faces.end());
    piece_.corners.assign(cell.corners.begin(), cell.corners.end());
    bool empty = false;
    for (int a = 0; a < 4 && !empty; ++a) {
      const HalfSpaceId h = lattice_.facet(lattice_cell, t, a);
      const CellSide side = splitter_.classify(piece_, plane_of(h));
      if (side == CellSide::split) {
        splitter_.split(piece_, plane_of(h), is_above(h) ? nullptr : &part_,
                        is_above(h) ? &part_ : nullptr);
        std::swap(piece_, part_);
      } else {
        empty = (side == CellSide::above) != is_above(h);
      }
    }
    if (!empty) visitor.piece(lattice_cell, t, piece_);
  }
}

void LatticeWalker::descend(const Polygon& polygon, HalfSpaceId side, LatticeBox box,
                            const PolygonVisitor& visitor) {
  if (!box.single()) {
    const Cut cut = middle(box);
    const HalfSpaceId upper = lattice_.upper(cut.axis, cut.at);
    const auto [low, high] = halves(box, cut);
    if (plane_of(upper) == polygon.plane)
      return descend(polygon, side, upper == side ? high : low, visitor);
    Polygon inside, outside;
    clipper_.split(polygon, upper, inside, &outside);
    if (!outside.empty()) descend(outside, side, low, visitor);
    if (!inside.empty()) descend(inside, side, high, visitor);
    return;
  }
  for (int t = 0; t < 6; ++t) {
    Polygon part = polygon, next;
    for (int a = 0; a < 4 && !part.empty(); ++a) {
      const HalfSpaceId h = lattice_.facet(box.low, t, a);
      if (plane_of(h) == polygon.plane) {
        if (h != side) part.corner.clear();
        continue;
      }
      clipper_.split(part, h, next, nullptr);
      std::swap(part, next);
    }
    if (!part.empty()) visitor(box.low, t, part);
  }
}

}  // namespace rockfold
