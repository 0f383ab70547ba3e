#include "host/cover/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "host/cut/complex.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {
constexpr Real relative_slack =
    1e-9;  // of the model's size: far above rounding, far below any block
}

Real Locator::piece_violation(const Vec3& x, Index piece) const {
  const auto vertex = [&](Index v) {
    return Vec3{covers_.vertex_xyz[3 * v], covers_.vertex_xyz[3 * v + 1],
                covers_.vertex_xyz[3 * v + 2]};
  };
  Real worst = -std::numeric_limits<Real>::infinity();
  for (Index t = covers_.triangle_begin[piece]; t < covers_.triangle_begin[piece + 1]; ++t) {
    const Vec3 a = vertex(covers_.triangle_vertex[3 * t]);
    const Vec3 n = cross(vertex(covers_.triangle_vertex[3 * t + 1]) - a,
                         vertex(covers_.triangle_vertex[3 * t + 2]) - a);
    const Real length = norm(n);
    if (length > 0) worst = std::max(worst, dot(n, x - a) / length);
  }
  return worst;
}

void Locator::try_regular(const Vec3& x, Index regular, std::vector<Holder>& found) const {
  Holder best;
  best.violation = std::numeric_limits<Real>::infinity();
  const Index lattice_cell = covers_.regular_cell[regular];
  const Real spacing = norm(covers_.lattice.edge[0]);
  for (int t = 0; t < 6; ++t) {
    const auto w = tetrahedron_weights(covers_.lattice, lattice_cell, t, x);
    const Real outside = -*std::min_element(w.begin(), w.end()) * spacing;
    if (outside < best.violation)
      best = {6 * regular + t,
              covers_.regular_block[regular],
              index_.regular_rock[regular],
              lattice_cell,
              t,
              outside};
  }
  found.push_back(best);
}

void Locator::try_element(const Vec3& x, Index e, std::vector<Holder>& found) const {
  const Vec3 r = x - covers_.lattice.cell_centre(covers_.element_cell[e]);
  for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q)
    found.push_back({6 * covers_.regular_count() + e, covers_.piece_block[q], index_.piece_rock[q],
                     covers_.element_cell[e], covers_.element_part[e], piece_violation(r, q)});
}

Holder Locator::find(const Vec3& x, Index block) const {
  const Real slack = relative_slack * index_.planes.model_size();
  Vertex v;
  v.x = x - index_.planes.centre();
  const LatticeBox box = index_.lattice.range(std::span(&v, 1));
  std::vector<Holder> found;
  for (Index k = box.low[2]; k < box.high[2]; ++k)
    for (Index j = box.low[1]; j < box.high[1]; ++j)
      for (Index i = box.low[0]; i < box.high[0]; ++i) {
        const Index lattice_cell = covers_.lattice.cell_index(i, j, k);
        const Index r = PieceIndex::find_regular(covers_, lattice_cell);
        if (r != none) try_regular(x, r, found);
        const auto [first, last] = std::equal_range(covers_.element_cell.begin(),
                                                    covers_.element_cell.end(), lattice_cell);
        for (auto e = first; e != last; ++e)
          try_element(x, static_cast<Index>(e - covers_.element_cell.begin()), found);
      }
  Holder best;
  for (const Holder& h : found) {
    if (h.violation > slack || (block != none && h.block != block)) continue;
    if (!best.found() || std::tie(h.block, h.element) < std::tie(best.block, best.element))
      best = h;
  }
  return best;
}

void Locator::add(const Vec3& x, const Holder& h, MaterialPoints& points) const {
  add_material_point(covers_, x, h.element, points);
}

MaterialPoints locate_points(const Covering& covering, const std::vector<Vec3>& points) {
  const Locator locator(covering);
  MaterialPoints result;
  for (const Vec3& x : points) locator.add(x, locator.find(x), result);
  return result;
}

MaterialPoints locate_block_vertices(const Covering& covering, const BlockArrays& blocks) {
  const Locator locator(covering);
  MaterialPoints result;
  for (Index b = 0; b < blocks.block_count(); ++b)
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v) {
      const Vec3& x = blocks.vertex[v];
      locator.add(x, locator.find(x, b), result);
    }
  return result;
}

}  // namespace rockfold
