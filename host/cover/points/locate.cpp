#include "host/cover/points/locate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {
/// Share of its part of a lattice cell below which an element is a sliver.
constexpr Real least_fill = 0.02;
/// Of the spacing: how far an element's functions are continued over slivers.
constexpr Real continued = 0.01;

/// m³
Real piece_volume(const CoverArrays& covers, Index piece) {
  const auto vertex = [&](Index v) {
    const Real* at = &covers.vertex_xyz[3 * static_cast<std::size_t>(v)];
    return Vec3{at[0], at[1], at[2]};
  };
  const Vec3 o = vertex(covers.vertex_begin[piece]);
  Real six = 0;
  for (Index t = covers.triangle_begin[piece]; t < covers.triangle_begin[piece + 1]; ++t) {
    const Index* of = &covers.triangle_vertex[3 * static_cast<std::size_t>(t)];
    six += dot(vertex(of[0]) - o, cross(vertex(of[1]) - o, vertex(of[2]) - o));
  }
  return six / 6;
}

bool share_cover(const ElementNodes& one, const ElementNodes& other, int nodes) {
  for (int a = 0; a < nodes; ++a)
    if (std::find(other.cover.begin(), other.cover.begin() + nodes, one.cover[a]) !=
        other.cover.begin() + nodes)
      return true;
  return false;
}

}  // namespace

// By the planes of the faces: the triangles of a sliver have no directions that could be trusted.
Real Locator::piece_violation(const Vec3& x, Index piece) const {
  const Vec3 r = x - index_.planes.centre();
  Real worst = -std::numeric_limits<Real>::infinity();
  for (auto f = index_.face_begin[piece]; f < index_.face_begin[piece + 1]; ++f)
    worst = std::max(worst, outside(index_.face_inside[f], r));
  return worst;
}

// m, how far outside the half-space r lies, from the table's centre.
Real Locator::outside(HalfSpaceId h, const Vec3& r) const {
  const PlaneTable& planes = index_.planes;
  const Real above = dot(planes.normal(plane_of(h)), r) - planes.offset(plane_of(h));
  return is_above(h) ? -above : above;
}

Locator::Locator(const Covering& covering) : covers_(covering.arrays), index_(*covering.pieces) {
  const auto& edge = covers_.lattice.edge;
  spacing_ = std::min({norm(edge[0]), norm(edge[1]), norm(edge[2])});
  cell_volume_ = std::abs(dot(edge[0], cross(edge[1], edge[2])));
  const Mat3 gradient = covers_.lattice.reciprocal();
  for (int d = 0; d < 3; ++d) slack_[d] = index_.point_slack() * norm(gradient[d]);
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
  for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q)
    try_piece(x, e, q, covers_.element_cell[e], covers_.element_part[e], found);
}

void Locator::try_piece(const Vec3& x, Index e, Index q, Index lattice_cell, int part,
                        Found& found) const {
  Holder h;
  h.element = covers_.parts_per_cell() * covers_.regular_count() + e;
  h.block = covers_.piece_block[q];
  h.rock = index_.piece_rock[q];
  h.lattice_cell = lattice_cell;
  h.part = part;
  h.violation = piece_violation(x, q);
  found.push_back(h);
}

// All that may hold x, or a place so many edges of the lattice away. A sliver's element may be another lattice cell's.
Locator::Found Locator::near(const Vec3& x, Real by) const {
  Found found;
  if (covers_.lattice.kind == LatticeKind::block) {
    for (const Index q : index_.piece_tree.at(x)) {
      const Index e = index_.piece_element[q];
      try_piece(x, e, q, covers_.element_cell[e], 0, found);
    }
    return found;
  }
  std::array<Vertex, 8> around;
  for (int c = 0; c < 8; ++c) {
    around[c].x = x - index_.planes.centre();
    for (int d = 0; d < 3; ++d)
      around[c].x +=
          ((c >> d & 1) != 0 ? 1 : -1) * std::max(by, slack_[d]) * covers_.lattice.edge[d];
  }
  const LatticeBox box = index_.lattice.range(around);
  for (Index k = box.low[2]; k < box.high[2]; ++k)
    for (Index j = box.low[1]; j < box.high[1]; ++j)
      for (Index i = box.low[0]; i < box.high[0]; ++i) {
        const Index lattice_cell = covers_.lattice.cell_index(i, j, k);
        const Index r = PieceIndex::find_regular(covers_, lattice_cell);
        if (r != none) try_regular(x, r, found);
        const IndexRange elements = elements_of_cell(covers_, lattice_cell);
        for (Index e = elements.begin; e < elements.end; ++e) try_element(x, e, found);
        index_.visit_slivers(lattice_cell, [&](Index q, int part) {
          const Index e = index_.piece_element[q];
          if (covers_.element_cell[e] != lattice_cell)
            try_piece(x, e, q, lattice_cell, part, found);
        });
      }
  return found;
}

Holder Locator::find(const Vec3& x, Index block) const {
  Holder best = holding(x, block);
  if (best.found() && best.other == none) best.other = find_other(x, best);
  return best;
}

Holder Locator::find_firm(const Vec3& x, Index block) const {
  return firm_for(x, find(x, block));
}

Holder Locator::of_vertex(const Vec3& x, Index block, Slivers slivers) const {
  if (covers_.lattice.kind != LatticeKind::block) {
    const Holder own = slivers == Slivers::passed_over ? find_firm(x, block) : find(x, block);
    return own.found() ? own : nearest_of(x, block);
  }
  const IndexRange own = elements_of_cell(covers_, block);
  if (own.end - own.begin > 1) return find(x, block);
  Holder whole;
  if (own.begin < own.end) whole.element = own.begin;
  return whole;
}

Holder Locator::nearest_of(const Vec3& x, Index block) const {
  Holder own = nearest_within(x, continued, [&](const Holder& h) { return h.block == block; });
  if (own.found() && own.other == none)
    own.other = other_of(own, near(x, continued), [](const Holder&) { return false; });
  return own;
}

Holder Locator::firm_for(const Vec3& x, const Holder& own) const {
  if (!own.found() || !is_sliver(own)) return own;
  const ElementNodes nodes = element_nodes(covers_, own.element);
  const Index material = material_of(covers_, own.element);
  Holder firm = nearest_within(x, continued, [&](const Holder& h) {
    return h.block == own.block && !is_sliver(h) && material_of(covers_, h.element) == material &&
           share_cover(nodes, element_nodes(covers_, h.element), covers_.nodes_per_part());
  });
  if (!firm.found()) return own;
  if (firm.other == none)
    firm.other = other_of(firm, near(x, continued), [&](const Holder& h) { return is_sliver(h); });
  return firm;
}

Holder Locator::holding(const Vec3& x, Index block) const {
  const Real slack = index_.point_slack();
  const int first_split = covers_.first_split_parts();
  Holder best;
  for (const Holder& h : near(x)) {
    if (h.violation > slack || (block != none && h.block != block) || h.part >= first_split)
      continue;
    if (!best.found() || std::tie(h.block, h.element) < std::tie(best.block, best.element))
      best = h;
  }
  return best;
}

template <class Accept>
Holder Locator::nearest_within(const Vec3& x, Real reach, const Accept& accept) const {
  const int first_split = covers_.first_split_parts();
  Holder best;
  for (const Holder& h : near(x, reach)) {
    if (h.violation > reach * spacing_ || h.part >= first_split || !accept(h)) continue;
    if (!best.found() || std::tie(h.violation, h.element) < std::tie(best.violation, best.element))
      best = h;
  }
  return best;
}

bool Locator::is_sliver(const Holder& holder) const {
  const Index whole = covers_.parts_per_cell() * covers_.regular_count();
  if (holder.element < whole || covers_.lattice.kind == LatticeKind::block) return false;
  const Index e = holder.element - whole;
  const CellSplit& split = covers_.lattice.split(covers_.element_cell[e]);
  Real volume = 0;
  for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q)
    volume += piece_volume(covers_, q);
  return volume <
         least_fill * cell_volume_ * part_share(split, split.part[covers_.element_part[e]]);
}

Index Locator::find_other(const Vec3& x, const Holder& holder) const {
  return other_of(holder, near(x), [](const Holder&) { return false; });
}

// The nearest of those that need not be avoided, or of all; where x is in slivers, their elements may be other lattice cells'.
template <class Avoid>
Index Locator::other_of(const Holder& holder, const Found& found, const Avoid& avoid) const {
  const int first_split = covers_.first_split_parts();
  if (first_split == covers_.parts_per_cell()) return none;
  Holder best;
  std::tuple<bool, bool, Real> best_rank;
  for (const Holder& h : found) {
    if (h.rock != holder.rock) continue;
    const bool elsewhere = h.lattice_cell != holder.lattice_cell;
    if (h.other != none && !elsewhere) return h.other;
    if (h.part < first_split && h.other == none) continue;
    const std::tuple rank{elsewhere, avoid(h), h.violation};
    if (best.found() && rank >= best_rank) continue;
    best = h;
    best_rank = rank;
  }
  return best.other != none ? best.other : best.element;
}

void Locator::add(const Vec3& x, const Holder& h, MaterialPoints& points) const {
  add_material_point(covers_, x, h.element, points, h.other);
}

MaterialPoints locate_points(const Covering& covering, const std::vector<Vec3>& points,
                             Slivers slivers) {
  const Locator locator(covering);
  MaterialPoints result;
  for (const Vec3& x : points)
    locator.add(x, slivers == Slivers::passed_over ? locator.find_firm(x) : locator.find(x),
                result);
  return result;
}

namespace {

MaterialPoints locate_vertices(const Covering& covering, const std::vector<Vec3>& x,
                               const std::vector<Index>& block, Slivers slivers) {
  const Locator locator(covering);
  MaterialPoints result;
  for (std::size_t v = 0; v < x.size(); ++v)
    locator.add(x[v], locator.of_vertex(x[v], block[v], slivers), result);
  return result;
}

}  // namespace

MaterialPoints locate_surface(const Covering& covering, const std::vector<Vec3>& x,
                              const std::vector<Index>& block) {
  return locate_vertices(covering, x, block, Slivers::as_they_are);
}

MaterialPoints locate_block_vertices(const Covering& covering, const BlockArrays& blocks) {
  std::vector<Index> block;
  block.reserve(blocks.vertex.size());
  for (Index b = 0; b < blocks.block_count(); ++b)
    block.insert(block.end(), blocks.vertex_begin[b + 1] - blocks.vertex_begin[b], b);
  return locate_vertices(covering, blocks.vertex, block, Slivers::passed_over);
}

}  // namespace rockfold
