#include "host/cover/lattice/lattice_walk.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"

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

LatticeWalker::Level& LatticeWalker::level(std::size_t depth) {
  if (levels_.size() <= depth) levels_.push_back(std::make_unique<Level>());
  return *levels_[depth];
}

void LatticeWalker::descend(std::size_t depth, const CellView& cell, LatticeBox box,
                            const CellVisitor& visitor) {
  while (true) {
    if (is_whole(cell, box)) return visitor.whole(box);
    if (box.single()) {
      for (const PartTree& tree : lattice_.form(box.low).tree)
        split_parts(depth, cell, box.low, tree, tree.root, visitor);
      return;
    }
    const Cut cut = middle(box);
    const HalfSpaceId upper = lattice_.upper(cut.axis, cut.at);
    const auto [low, high] = halves(box, cut);
    const CellSide side = splitter_.classify(cell, plane_of(upper));
    if (side != CellSide::split) {
      box = (side == CellSide::above) == is_above(upper) ? high : low;
      continue;
    }
    Level& part = level(depth);
    splitter_.split(cell, plane_of(upper), &part.below, &part.above);
    descend(depth + 1, is_above(upper) ? part.below : part.above, low, visitor);
    descend(depth + 1, is_above(upper) ? part.above : part.below, high, visitor);
    return;
  }
}

// `cell` lies in one lattice cell. Levels from `depth` on are free.
void LatticeWalker::split_parts(std::size_t depth, const CellView& cell, const CellIjk& at,
                                const PartTree& tree, int child, const CellVisitor& visitor) {
  while (child >= 0) {
    const PartTree::Branch& branch = tree.branch[child];
    const HalfSpaceId upper = lattice_.upper(at, branch.plane);
    const CellSide side = splitter_.classify(cell, plane_of(upper));
    if (side == CellSide::split) {
      Level& part = level(depth);
      splitter_.split(cell, plane_of(upper), &part.below, &part.above);
      split_parts(depth + 1, is_above(upper) ? part.below : part.above, at, tree, branch.below,
                  visitor);
      split_parts(depth + 1, is_above(upper) ? part.above : part.below, at, tree, branch.above,
                  visitor);
      return;
    }
    child = (side == CellSide::above) == is_above(upper) ? branch.above : branch.below;
  }
  visitor.piece(at, ~child, cell);
}

void LatticeWalker::descend(const Polygon& polygon, HalfSpaceId side, const LatticeBox& box,
                            const PolygonVisitor& visitor) {
  if (box.single()) {
    for (const PartTree& tree : lattice_.form(box.low).tree)
      split_parts(polygon, side, box.low, tree, tree.root, visitor);
    return;
  }
  const Cut cut = middle(box);
  const HalfSpaceId upper = lattice_.upper(cut.axis, cut.at);
  const auto [low, high] = halves(box, cut);
  if (plane_of(upper) == polygon.plane)
    return descend(polygon, side, upper == side ? high : low, visitor);
  Polygon inside, outside;
  clipper_.split(polygon, upper, inside, &outside);
  if (!outside.empty()) descend(outside, side, low, visitor);
  if (!inside.empty()) descend(inside, side, high, visitor);
}

void LatticeWalker::split_parts(const Polygon& polygon, HalfSpaceId side, const CellIjk& at,
                                const PartTree& tree, int child, const PolygonVisitor& visitor) {
  if (child < 0) return visitor(at, ~child, polygon);
  const PartTree::Branch& branch = tree.branch[child];
  const HalfSpaceId upper = lattice_.upper(at, branch.plane);
  if (plane_of(upper) == polygon.plane)
    return split_parts(polygon, side, at, tree, upper == side ? branch.above : branch.below,
                       visitor);
  Polygon inside, outside;
  clipper_.split(polygon, upper, inside, &outside);
  if (!outside.empty()) split_parts(outside, side, at, tree, branch.below, visitor);
  if (!inside.empty()) split_parts(inside, side, at, tree, branch.above, visitor);
}

namespace {

class PartsNear {
 public:
  PartsNear(const LatticePlanes& lattice, const PlaneTable& planes, const Vec3& normal,
            const PartsNearVisitor& visit)
      : lattice_(lattice), planes_(planes), normal_(normal), visit_(visit) {}

  void descend(const std::vector<Vec3>& polygon, const LatticeBox& box) const {
    if (width_in_plane(polygon, normal_) < planes_.width_tolerance()) return;
    if (box.single()) return parts(polygon, box.low);
    const Cut cut = middle(box);
    const HalfSpaceId upper = lattice_.upper(cut.axis, cut.at);
    const auto [low, high] = halves(box, cut);
    descend(inside(polygon, upper ^ 1), low);
    descend(inside(polygon, upper), high);
  }

 private:
  void parts(const std::vector<Vec3>& polygon, const std::array<Index, 3>& ijk) const {
    const auto& facets = lattice_.form(ijk).facet;
    for (std::size_t part = 0; part < facets.size(); ++part) {
      std::vector<Vec3> own = polygon;
      for (const PartFacet& facet : facets[part]) own = inside(own, lattice_.inside(ijk, facet));
      if (width_in_plane(own, normal_) >= planes_.width_tolerance())
        visit_(ijk, static_cast<int>(part), own);
    }
  }

  std::vector<Vec3> inside(const std::vector<Vec3>& polygon, HalfSpaceId h) const {
    const Vec3 n = (is_above(h) ? 1.0 : -1.0) * planes_.normal(plane_of(h));
    const Real offset = (is_above(h) ? 1.0 : -1.0) * planes_.offset(plane_of(h));
    const auto depth = [&](const Vec3& x) { return dot(n, x) - offset; };
    const bool along = std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& x) {
      return std::abs(depth(x)) < planes_.width_tolerance();
    });
    if (along) return polygon;
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const Real dp = depth(p), dq = depth(q);
      if (dp >= 0) part.push_back(p);
      if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) part.push_back(p + (dp / (dp - dq)) * (q - p));
    }
    return part;
  }

  const LatticePlanes& lattice_;
  const PlaneTable& planes_;
  const Vec3 normal_;
  const PartsNearVisitor& visit_;
};

}  // namespace

void visit_parts_near(const LatticePlanes& lattice, const PlaneTable& planes,
                      const std::vector<Vec3>& polygon, const PartsNearVisitor& visit) {
  Vec3 area{};
  std::vector<Vertex> corners(polygon.size());
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    corners[k].x = polygon[k];
    area += cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
  }
  PartsNear(lattice, planes, normalized(area), visit).descend(polygon, lattice.range(corners));
}

}  // namespace rockfold
