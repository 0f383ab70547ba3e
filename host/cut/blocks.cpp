#include "host/cut/blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "host/cut/union_find.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

std::vector<Index> components(const Complex& complex) {
  UnionFind parts(complex.cells.size());
  for (const Fragment& f : complex.fragments)
    if (f.joint == none) parts.join(f.cell[0], f.cell[1]);
  return parts.components();
}

// The cell that holds a point of a merge, deepest inside if it lies on a boundary. Throws Error(model) outside of all.
Index cell_at(const CellStore& cells, const PlaneTable& planes, const Vec3& point,
              const Place& place) {
  const Vec3 x = point - planes.centre();
  Index best = none;
  Real deepest = -planes.tolerance();
  for (Index c = 0; c < cells.size(); ++c) {
    Real depth = Box::infinity;
    for (const auto& face : cells[c].faces) {
      const Index plane = plane_of(face.inside);
      const Real d = dot(planes.normal(plane), x) - planes.offset(plane);
      depth = std::min(depth, is_above(face.inside) ? d : -d);
      if (depth <= deepest) break;
    }
    if (depth > deepest) best = c, deepest = depth;
  }
  if (best == none)
    refuse(place, place.key + ".points",
           fmt::format("({:g}, {:g}, {:g}) is not in the rock", point[0], point[1], point[2]));
  return best;
}

// Joints between and inside the blocks that hold the points become virtual. Throws Error(model) where that leaves the blocks
// apart.
void merge_blocks(Complex& complex, const Merge::Blocks& merge, const Place& place) {
  const std::vector<Index> part = components(complex);
  std::vector<bool> joined(complex.cells.size(), false);  // [parts]
  std::vector<Index> part_of_point;
  for (const Vec3& point : merge.points) {
    const Index cell = cell_at(complex.cells, complex.planes, point, place);
    joined[part[cell]] = true;
    part_of_point.push_back(part[cell]);
  }
  UnionFind blocks(complex.cells.size());
  for (Fragment& f : complex.fragments) {
    const Index one = part[f.cell[0]], two = part[f.cell[1]];
    if (f.joint == none || !joined[one] || !joined[two] ||
        complex.zone(f.cell[0]).stage != complex.zone(f.cell[1]).stage)
      continue;
    f.joint = f.instance = none;
    blocks.join(one, two);
  }
  for (std::size_t i = 1; i < part_of_point.size(); ++i)
    if (blocks.find(part_of_point[i]) != blocks.find(part_of_point[0])) {
      const Vec3 &a = merge.points[0], &b = merge.points[i];
      refuse(place, place.key + ".points",
             fmt::format(
                 "the blocks at ({:g}, {:g}, {:g}) and ({:g}, {:g}, {:g}) cannot become one: no "
                 "joint between the blocks of the points leads from one to the other",
                 a[0], a[1], a[2], b[0], b[1], b[2]));
    }
}

}  // namespace

void check_merge_points(const CellStore& cells, const PlaneTable& planes, const Model& model) {
  for (const Merge& merge : model.merges)
    if (const auto* blocks = std::get_if<Merge::Blocks>(&merge.region))
      for (const Vec3& point : blocks->points) cell_at(cells, planes, point, merge.place);
}

// Coordinates are compared in units of 1e-9 of the model's size, so that rounding does not shuffle a regular pattern.
void find_blocks(Complex& complex, const Model& model) {
  for (const Merge& merge : model.merges)
    if (const auto* blocks = std::get_if<Merge::Blocks>(&merge.region))
      merge_blocks(complex, *blocks, merge.place);
  complex.cell_block = components(complex);
  const Index n = complex.cells.size();
  complex.block_count =
      n == 0 ? 0 : 1 + *std::max_element(complex.cell_block.begin(), complex.cell_block.end());

  std::vector<CellMoments> sum(complex.block_count);
  for (Index c = 0; c < n; ++c) {
    sum[complex.cell_block[c]].volume += complex.moments[c].volume;
    sum[complex.cell_block[c]].first += complex.moments[c].first;
  }
  const Real unit = 1e-9 * complex.planes.model_size();
  struct Placed {
    std::array<Real, 3> key;
    Index block;
    bool operator<(const Placed& o) const {
      return std::tie(key, block) < std::tie(o.key, o.block);
    }
  };
  std::vector<Placed> order(sum.size());
  for (std::size_t b = 0; b < sum.size(); ++b) {
    order[b].block = static_cast<Index>(b);
    for (int d = 0; d < 3; ++d)
      order[b].key[d] = std::round(sum[b].first[2 - d] / sum[b].volume / unit);
  }
  std::sort(order.begin(), order.end());
  std::vector<Index> rank(sum.size());
  for (std::size_t i = 0; i < order.size(); ++i) rank[order[i].block] = static_cast<Index>(i);
  for (Index& b : complex.cell_block) b = rank[b];
}

}  // namespace rockfold
