#include "src/system/rows.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "src/space/shape_functions.hpp"

namespace rockfold::solve {
namespace {

/// Which covers are stencil rows, and their cells.
struct StencilCovers {
  int nodes = 0;                ///< of a cell
  std::vector<Index> cell;      ///< [P][nodes] the regular cell of which p is node c, or none
  std::vector<Index> material;  ///< [P] none for block rows
  std::vector<NodeClass> classes;
  std::vector<std::uint8_t> of;  ///< [P] class
  std::vector<std::uint8_t>
      shares_node;  ///< [P] 1 where the node has other covers; empty where none has

  Index cell_at(Index p, int node) const {
    return cell[static_cast<std::size_t>(nodes) * p + node];
  }
};

/// The material of a cover's cells, or none where not all are regular and alike.
Index common_material(const CoverArrays& covers, const StencilCovers& found, Index p) {
  Index material = none;
  for (const auto& corner : found.classes[found.of[p]].cell) {
    const Index r = found.cell_at(p, corner.node);
    if (r == none) return none;
    if (material != none && covers.regular_material[r] != material) return none;
    material = covers.regular_material[r];
  }
  return material;
}

/// Whether p's cells agree on the covers of their common nodes. They do not where a joint on a lattice plane, which enters no cell,
/// ends at p.
bool cells_agree(const CoverArrays& covers, const StencilCovers& found, Index p) {
  std::vector<Index> split;  // covers of split nodes
  for (const auto& corner : found.classes[found.of[p]].cell) {
    const Index* cell = &covers.regular_cover[found.nodes * found.cell_at(p, corner.node)];
    for (int b = 0; b < found.nodes; ++b)
      if (found.shares_node[cell[b]] != 0) split.push_back(cell[b]);
  }
  std::sort(split.begin(), split.end());
  split.erase(std::unique(split.begin(), split.end()), split.end());
  return std::adjacent_find(split.begin(), split.end(), [&](Index a, Index b) {
           return covers.cover_node[a] == covers.cover_node[b];
         }) == split.end();
}

/// See StencilCovers.
std::vector<std::uint8_t> find_shared_nodes(const CoverArrays& covers) {
  std::vector<std::uint8_t> shares;
  for (std::size_t p = 1; p < covers.cover_node.size(); ++p)
    if (covers.cover_node[p - 1] == covers.cover_node[p]) {
      shares.resize(covers.cover_node.size(), 0);
      shares[p - 1] = shares[p] = 1;
    }
  return shares;
}

StencilCovers find_stencil_covers(const CoverArrays& covers) {
  const std::size_t count = covers.cover_node.size();
  StencilCovers found;
  found.nodes = covers.nodes_per_cell();
  found.classes = node_classes(covers.lattice.kind);
  found.material.assign(count, none);
  if (covers.regular_count() == 0) return found;
  found.cell.assign(found.nodes * count, none);
  found.of.resize(count);
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int c = 0; c < found.nodes; ++c) {
      const std::size_t p = covers.regular_cover[found.nodes * r + c];
      found.cell[found.nodes * p + c] = r;
    }
  found.shares_node = find_shared_nodes(covers);
  for (std::size_t p = 0; p < count; ++p) {
    found.of[p] = static_cast<std::uint8_t>(class_of_node(covers.lattice, covers.cover_node[p]));
    found.material[p] = common_material(covers, found, static_cast<Index>(p));
    if (found.material[p] != none && !found.shares_node.empty() &&
        !cells_agree(covers, found, static_cast<Index>(p)))
      found.material[p] = none;
  }
  return found;
}

/// `result`: one room for all covers, who are many.
void find_neighbours(const CoverArrays& covers, const StencilCovers& stencil, Index p,
                     std::vector<Index>& result) {
  result.clear();
  for (const auto& [from, to] : stencil.classes[stencil.of[p]].pair)
    result.push_back(covers.regular_cover[stencil.nodes * stencil.cell_at(p, from) + to]);
}

StencilRuns make_runs(const CoverArrays& covers, const StencilCovers& stencil) {
  StencilRuns runs;
  runs.stride = covers.lattice.kind == LatticeKind::tet5 ? 2 : 1;
  struct Open {
    Index run = none;
    std::vector<Index> next;  ///< neighbours of the cover that would go on
  };
  std::vector<Open> open(stencil.classes.size());
  std::vector<Index> now;
  for (Index p = 0; p < covers.cover_count(); ++p) {
    if (stencil.material[p] == none) continue;
    Open& last = open[stencil.of[p]];
    find_neighbours(covers, stencil, p, now);
    const bool goes_on = last.run != none &&
                         runs.first[last.run] + runs.stride * runs.length[last.run] == p &&
                         runs.material[last.run] == stencil.material[p] &&
                         runs.length[last.run] < StencilRuns::max_length && now == last.next;
    if (goes_on) {
      ++runs.length[last.run];
    } else {
      last.run = runs.count();
      runs.first.push_back(p);
      runs.length.push_back(1);
      runs.material.push_back(stencil.material[p]);
      runs.node_class.push_back(stencil.of[p]);
      runs.neighbour_begin.push_back(static_cast<Index>(runs.neighbour.size()));
      runs.neighbour.insert(runs.neighbour.end(), now.begin(), now.end());
    }
    for (Index& q : now) q += runs.stride;
    last.next.swap(now);
  }
  return runs;
}

/// The block rows in ascending order of cover, with what is integrated into them, before slicing.
struct PlainRows {
  std::vector<Index> cover, source_begin, column_begin;
  std::vector<Source> source;
  std::vector<Index> column;
  std::vector<Index> alike;  ///< rows of one number have the same values in the same order; or none

  Index length(Index b) const { return column_begin[b + 1] - column_begin[b]; }
};

template <class Visit>
void for_each_source(const CoverArrays& covers, Visit visit) {
  for (std::size_t i = 0; i < covers.regular_cover.size(); ++i)
    visit(covers.regular_cover[i], static_cast<Source>(i));
  for (std::size_t i = 0; i < covers.element_cover.size(); ++i)
    visit(covers.element_cover[i], -1 - static_cast<Source>(i));
}

void gather_sources(const CoverArrays& covers, const std::vector<Index>& row_of_cover,
                    PlainRows& rows) {
  rows.source_begin.assign(rows.cover.size() + 1, 0);
  for_each_source(covers, [&](Index p, Source) {
    if (row_of_cover[p] != none) ++rows.source_begin[row_of_cover[p] + 1];
  });
  for (std::size_t b = 0; b < rows.cover.size(); ++b)
    rows.source_begin[b + 1] += rows.source_begin[b];
  rows.source.resize(rows.source_begin.back());
  std::vector<Index> end(rows.source_begin.begin(), rows.source_begin.end() - 1);
  for_each_source(covers, [&](Index p, Source source) {
    if (row_of_cover[p] != none) rows.source[end[row_of_cover[p]]++] = source;
  });
}

/// [form][a][b] whether two nodes of a cell couple.
std::vector<std::vector<std::vector<bool>>> couplings(const CoverArrays& covers) {
  const int nodes = covers.nodes_per_cell();
  const LatticeKind kind = covers.lattice.kind;
  std::vector<std::vector<std::vector<bool>>> couple(
      kind == LatticeKind::tet5 ? 2 : 1,
      std::vector<std::vector<bool>>(nodes, std::vector<bool>(nodes)));
  for (std::size_t form = 0; form < couple.size(); ++form)
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b)
        couple[form][a][b] = nodes_couple(kind, static_cast<int>(form), a, b);
  return couple;
}

void gather_columns(const CoverArrays& covers, PlainRows& rows) {
  const auto couple = couplings(covers);
  const int nodes = covers.nodes_per_cell(), per_part = covers.nodes_per_part();
  std::vector<Index> seen_by(covers.cover_node.size(), none);
  rows.column_begin.assign(1, 0);
  for (std::size_t b = 0; b < rows.cover.size(); ++b) {
    seen_by[rows.cover[b]] = static_cast<Index>(b);
    auto add = [&](Index q) {
      if (seen_by[q] != static_cast<Index>(b)) rows.column.push_back(q);
      seen_by[q] = static_cast<Index>(b);
    };
    for (Index s = rows.source_begin[b]; s < rows.source_begin[b + 1]; ++s) {
      const Source source = rows.source[s];
      if (source >= 0) {
        const Source r = source / nodes;
        const int form = form_of_cell(covers.lattice, covers.regular_cell[r]);
        for (int c = 0; c < nodes; ++c)
          if (couple[form][source % nodes][c]) add(covers.regular_cover[r * nodes + c]);
      } else {
        for (int a = 0; a < per_part; ++a)
          add(covers.element_cover[(-1 - source) / per_part * per_part + a]);
      }
    }
    std::sort(rows.column.begin() + rows.column_begin.back(), rows.column.end());
    rows.column_begin.push_back(static_cast<Index>(rows.column.size()));
  }
}

/// Rows between regular cells alone are alike where the same cells of the same materials meet in the same places, and their couplings
/// stand in the same columns: at the boundary of what is whole, and between materials.
void find_alike(const CoverArrays& covers, PlainRows& rows) {
  const auto couple = couplings(covers);
  const int nodes = covers.nodes_per_cell();
  std::map<std::vector<Index>, Index> known;
  std::vector<Index> place(covers.cover_node.size()), key;
  rows.alike.assign(rows.cover.size(), none);
  for (std::size_t b = 0; b < rows.cover.size(); ++b) {
    const Index end = rows.source_begin[b + 1];
    if (rows.source_begin[b] == end || rows.source[end - 1] < 0) continue;
    for (Index k = rows.column_begin[b]; k < rows.column_begin[b + 1]; ++k)
      place[rows.column[k]] = k - rows.column_begin[b];
    place[rows.cover[b]] = none;
    key.clear();
    for (Index s = rows.source_begin[b]; s < end; ++s) {
      const Index r = static_cast<Index>(rows.source[s] / nodes);
      const int node = static_cast<int>(rows.source[s] % nodes);
      const int form = form_of_cell(covers.lattice, covers.regular_cell[r]);
      key.insert(key.end(), {node, form, covers.regular_material[r]});
      for (int c = 0; c < nodes; ++c)
        if (couple[form][node][c]) key.push_back(place[covers.regular_cover[r * nodes + c]]);
    }
    rows.alike[b] = known.try_emplace(key, static_cast<Index>(known.size())).first->second;
  }
}

/// Rows of like length, and of those the ones that are alike, side by side, sorted within windows small enough to keep neighbours near.
std::vector<Index> slice_order(const PlainRows& rows) {
  constexpr std::size_t window = 512;
  std::vector<Index> order(rows.cover.size());
  for (std::size_t b = 0; b < order.size(); ++b) order[b] = static_cast<Index>(b);
  for (std::size_t w = 0; w < order.size(); w += window)
    std::stable_sort(order.begin() + w, order.begin() + std::min(w + window, order.size()),
                     [&](Index a, Index b) {
                       return rows.length(a) != rows.length(b) ? rows.length(a) > rows.length(b)
                                                               : rows.alike[a] < rows.alike[b];
                     });
  return order;
}

/// Which values the next slice has: of so many columns, its rows order[begin …].
void share_values(const PlainRows& rows, const std::vector<Index>& order, std::size_t begin,
                  Index columns, std::vector<Index>& owner_of, BlockRows& sliced) {
  const Index slice = static_cast<Index>(sliced.value_begin.size());
  Index alike = begin + sliced.lanes <= order.size() ? rows.alike[order[begin]] : none;
  for (int l = 1; l < sliced.lanes && alike != none; ++l)
    if (rows.alike[order[begin + l]] != alike) alike = none;
  if (alike != none && owner_of.size() <= static_cast<std::size_t>(alike))
    owner_of.resize(alike + 1, none);
  if (alike != none && owner_of[alike] != none) {
    sliced.value_begin.push_back(sliced.value_begin[owner_of[alike]]);
    sliced.owner.push_back(sliced.owner[owner_of[alike]]);
    return;
  }
  if (alike != none) owner_of[alike] = slice;
  sliced.value_begin.push_back(sliced.value_columns);
  sliced.value_columns += columns;
  sliced.owner.push_back(static_cast<Index>(sliced.owning.size()));
  sliced.owning.push_back(slice);
}

BlockRows slice_rows(const PlainRows& rows, int lanes) {
  BlockRows sliced;
  sliced.lanes = lanes;
  sliced.slice_begin.push_back(0);
  sliced.source_begin.push_back(0);
  const std::vector<Index> order = slice_order(rows);
  std::vector<Index> owner_of;  // the slice that has the values of rows that are alike
  for (std::size_t begin = 0; begin < order.size(); begin += lanes) {
    const Index longest = rows.length(order[begin]);
    share_values(rows, order, begin, longest, owner_of, sliced);
    const std::size_t first_column = sliced.column.size();
    sliced.column.resize(first_column + static_cast<std::size_t>(longest) * lanes, 0);
    for (int l = 0; l < lanes; ++l) {
      const Index b = begin + l < order.size() ? order[begin + l] : none;
      sliced.row.push_back(b == none ? none : rows.cover[b]);
      if (b != none) {
        for (Index k = 0; k < longest; ++k)
          sliced.column[first_column + static_cast<std::size_t>(k) * lanes + l] =
              k < rows.length(b) ? rows.column[rows.column_begin[b] + k] : rows.cover[b];
        sliced.source.insert(sliced.source.end(), rows.source.begin() + rows.source_begin[b],
                             rows.source.begin() + rows.source_begin[b + 1]);
      }
      sliced.source_begin.push_back(static_cast<Index>(sliced.source.size()));
    }
    sliced.slice_begin.push_back(sliced.slice_begin.back() + longest);
  }
  return sliced;
}

/// Which sort of node this is: 0 corner, 1 … 3 centre of a face across that axis, 4 centre of the cell.
int sort_of(const HalfSteps& at) {
  const int odd = (at[0] & 1) + (at[1] & 1) + (at[2] & 1);
  if (odd == 0) return 0;
  if (odd == 3) return 4;
  return (at[0] & 1) == 0 ? 1 : (at[1] & 1) == 0 ? 2 : 3;
}

/// The class of nodes of a sort; `parity`: of the corner's i + j + k, tet5 alone.
NodeClass make_class(LatticeKind kind, int sort, int parity) {
  const CellSplit& split = cell_split(kind);
  NodeClass result;
  std::set<Offset> found;
  std::vector<std::pair<Offset, std::array<int, 2>>> pairs;
  for (int a = 0; a < split.node_count(); ++a) {
    if (sort_of(split.node[a]) != sort) continue;
    // A cell's parity is that of its lower corner: the node's less the steps up to it.
    const int form =
        kind == LatticeKind::tet5 ? (parity + (a & 1) + (a >> 1 & 1) + (a >> 2)) & 1 : 0;
    result.cell.push_back({form, a});
    for (int b = 0; b < split.node_count(); ++b) {
      if (a == b || !nodes_couple(kind, form, a, b)) continue;
      Offset offset;
      for (int d = 0; d < 3; ++d) offset[d] = split.node[b][d] - split.node[a][d];
      if (found.insert(offset).second) pairs.push_back({offset, {a, b}});
    }
  }
  for (const Offset& offset : found)
    if (offset > Offset{0, 0, 0}) result.positive.push_back(offset);
  for (const Offset& plus : result.positive)
    for (const int sign : {1, -1})
      for (const auto& [offset, nodes] : pairs)
        if (offset == Offset{sign * plus[0], sign * plus[1], sign * plus[2]})
          result.pair.push_back(nodes);
  return result;
}

}  // namespace

std::vector<NodeClass> node_classes(LatticeKind kind) {
  switch (kind) {
    case LatticeKind::block:
      return {};
    case LatticeKind::tet5:
      return {make_class(kind, 0, 0), make_class(kind, 0, 1)};
    case LatticeKind::tet24:
      return {make_class(kind, 0, 0), make_class(kind, 1, 0), make_class(kind, 2, 0),
              make_class(kind, 3, 0), make_class(kind, 4, 0)};
    default:
      return {make_class(kind, 0, 0)};
  }
}

int class_of_node(const Lattice& lattice, Index node) {
  if (lattice.kind == LatticeKind::tet24) return node / lattice.grid();
  if (lattice.kind != LatticeKind::tet5) return 0;
  const auto n = lattice.node_ijk(node);
  return (n[0] + n[1] + n[2] + (lattice.odd_origin ? 1 : 0)) & 1;
}

bool nodes_couple(LatticeKind kind, int form, int a, int b) {
  const auto& parts = cell_split(kind, form == 1).part;
  return std::any_of(parts.begin(), parts.end(), [=](const CellPart& part) {
    const auto end = part.node.begin() + part.nodes;
    return std::find(part.node.begin(), end, a) != end &&
           std::find(part.node.begin(), end, b) != end;
  });
}

Rows sort_rows(const CoverArrays& covers, int lanes, bool stencils) {
  StencilCovers stencil;
  if (stencils)
    stencil = find_stencil_covers(covers);
  else
    stencil.material.assign(covers.cover_node.size(), none);
  PlainRows plain;
  std::vector<Index> row_of_cover(covers.cover_node.size(), none);
  for (Index p = 0; p < covers.cover_count(); ++p)
    if (stencil.material[p] == none) {
      row_of_cover[p] = static_cast<Index>(plain.cover.size());
      plain.cover.push_back(p);
    }
  gather_sources(covers, row_of_cover, plain);
  gather_columns(covers, plain);
  if (stencils)
    find_alike(covers, plain);
  else
    plain.alike.assign(plain.cover.size(), none);

  Rows rows;
  rows.stencil = make_runs(covers, stencil);
  rows.block = slice_rows(plain, lanes);
  rows.block_covers = static_cast<Index>(plain.cover.size());
  rows.stencil_covers = covers.cover_count() - rows.block_covers;
  rows.neighbours = static_cast<std::int64_t>(plain.column.size());
  return rows;
}

}  // namespace rockfold::solve
