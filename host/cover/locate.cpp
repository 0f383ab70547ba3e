#include "host/cover/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "src/arrays/shape_functions.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {
constexpr Real relative_slack =
    1e-9;  // of the model's size: far above rounding, far below any block
}

// By the planes of the faces: the triangles of a sliver have no directions that could be trusted.
Real Locator::piece_violation(const Vec3& x, Index piece) const {
  const Vec3 r = x - index_.planes.table.centre();
  Real worst = -std::numeric_limits<Real>::infinity();
  for (auto f = index_.face_begin[piece]; f < index_.face_begin[piece + 1]; ++f) {
    const HalfSpaceId h = index_.face_inside[f];
    const Real above =
        dot(index_.planes.table.normal(plane_of(h)), r) - index_.planes.table.offset(plane_of(h));
    worst = std::max(worst, is_above(h) ? -above : above);
  }
  return worst;
}

Locator::Locator(const Covering& covering) : covers_(covering.arrays), index_(*covering.pieces) {
  if (covers_.lattice.kind != LatticeKind::block) return;
  for (Index e = 0; e < covers_.cut_count(); ++e) {
    Box& box = element_box_.emplace_back();
    const Vec3 centre = covers_.lattice.cell_centre(covers_.element_cell[e]);
    for (Index v = covers_.vertex_begin[covers_.piece_begin[e]];
         v < covers_.vertex_begin[covers_.piece_begin[e + 1]]; ++v)
      box.add(centre + Vec3{covers_.vertex_xyz[3 * v], covers_.vertex_xyz[3 * v + 1],
                            covers_.vertex_xyz[3 * v + 2]});
  }
}

void Locator::try_regular(const Vec3& x, Index regular, Found& found) const {
  const Lattice& lattice = covers_.lattice;
  Holder h;
  h.lattice_cell = covers_.regular_cell[regular];
  h.block = covers_.regular_block[regular];
  h.rock = index_.regular_rock[regular];
  const Vec3 eta = lattice.to_local(x - lattice.cell_centre(h.lattice_cell));
  const Mat3 gradient = lattice.reciprocal();
  h.violation = -std::numeric_limits<Real>::infinity();
  for (int d = 0; d < 3; ++d)
    h.violation = std::max(h.violation, (std::abs(eta[d]) - 0.5) / norm(gradient[d]));
  const auto& trees = index_.lattice.form(lattice.cell_ijk(h.lattice_cell)).tree;
  h.part = index_.lattice.part_at(trees[0], eta);
  h.element = covers_.parts_per_cell() * regular + h.part;
  if (trees.size() > 1)
    h.other = covers_.parts_per_cell() * regular + index_.lattice.part_at(trees[1], eta);
  found.push_back(h);
}

void Locator::try_element(const Vec3& x, Index e, Found& found) const {
  for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q) {
    Holder h;
    h.element = covers_.parts_per_cell() * covers_.regular_count() + e;
    h.block = covers_.piece_block[q];
    h.rock = index_.piece_rock[q];
    h.lattice_cell = covers_.element_cell[e];
    h.part = covers_.element_part[e];
    h.violation = piece_violation(x, q);
    found.push_back(h);
  }
}

// All that may hold x.
Locator::Found Locator::near(const Vec3& x) const {
  Found found;
  if (covers_.lattice.kind == LatticeKind::block) {
    Box point;
    point.add(x);
    for (Index e = 0; e < covers_.cut_count(); ++e)
      if (element_box_[e].meets(point, relative_slack * index_.planes.table.model_size()))
        try_element(x, e, found);
    return found;
  }
  Vertex v;
  v.x = x - index_.planes.table.centre();
  const LatticeBox box = index_.lattice.range(std::span(&v, 1));
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
  return found;
}

Holder Locator::find(const Vec3& x, Index block) const {
  const Real slack = relative_slack * index_.planes.table.model_size();
  const int first_split = covers_.first_split_parts();
  Holder best;
  for (const Holder& h : near(x)) {
    if (h.violation > slack || (block != none && h.block != block) || h.part >= first_split)
      continue;
    if (!best.found() || std::tie(h.block, h.element) < std::tie(best.block, best.element))
      best = h;
  }
  if (best.found() && best.other == none) best.other = find_other(x, best);
  return best;
}

Index Locator::find_other(const Vec3& x, const Holder& holder) const {
  const int first_split = covers_.first_split_parts();
  if (first_split == covers_.parts_per_cell()) return none;
  Holder best;
  for (const Holder& h : near(x)) {
    if (h.rock != holder.rock || h.lattice_cell != holder.lattice_cell) continue;
    if (h.other != none) return h.other;
    if (h.part < first_split) continue;
    if (!best.found() || h.violation < best.violation) best = h;
  }
  return best.element;
}

Holder Locator::nearest(const Vec3& x, Index rock, bool second_split) const {
  const int first_split = covers_.first_split_parts();
  Holder best;
  for (Holder h : near(x)) {
    if (h.rock != rock) continue;
    if (second_split && h.other != none) {  // of a regular lattice cell
      h.element = h.other;
      h.part = h.element % covers_.parts_per_cell();
    }
    if ((h.part >= first_split) != second_split) continue;
    if (!best.found() || h.violation < best.violation) best = h;
  }
  return best;
}

void Locator::add(const Vec3& x, const Holder& h, MaterialPoints& points) const {
  add_material_point(covers_, x, h.element, points, h.other);
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
