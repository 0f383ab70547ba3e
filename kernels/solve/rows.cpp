#include "kernels/solve/rows.hpp"

#include <algorithm>
#include <utility>

namespace rockfold::solve {
namespace {

constexpr Offset corner_offset(int c) {
  return {c & 1, c >> 1 & 1, c >> 2 & 1};
}

/// Which covers are stencil rows, and their eight cells.
struct StencilCovers {
  std::vector<Index> cell;      ///< [P][8] the regular cell of which p is corner c, or none
  std::vector<Index> material;  ///< [P] none for block rows
};

StencilCovers find_stencil_covers(const CoverArrays& covers) {
  const std::size_t count = covers.cover_node.size();
  StencilCovers found{std::vector<Index>(8 * count, none), std::vector<Index>(count, none)};
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int c = 0; c < 8; ++c)
      found.cell[8 * static_cast<std::size_t>(covers.regular_cover[8 * r + c]) + c] = r;
  for (std::size_t p = 0; p < count; ++p) {
    const Index* cell = &found.cell[8 * p];
    const bool whole = std::all_of(cell, cell + 8, [&](Index r) {
      return r != none && cell[0] != none &&
             covers.regular_material[r] == covers.regular_material[cell[0]];
    });
    if (whole) found.material[p] = covers.regular_material[cell[0]];
  }
  return found;
}

/// The cover one offset away from stencil cover p.
Index neighbour(const CoverArrays& covers, const StencilCovers& stencil, Index p,
                const Offset& offset) {
  int from = 0, to = 0;  // the corners of a cell that holds both
  for (int d = 0; d < 3; ++d) {
    if (offset[d] < 0) from |= 1 << d;
    if (offset[d] > 0) to |= 1 << d;
  }
  return covers.regular_cover[8 * stencil.cell[8 * static_cast<std::size_t>(p) + from] + to];
}

StencilRuns make_runs(const CoverArrays& covers, const StencilCovers& stencil) {
  StencilRuns runs;
  const auto offsets = stencil_offsets();
  std::array<Index, 2 * half_neighbours> now{}, next{};
  for (Index p = 0; p < covers.cover_count(); ++p) {
    if (stencil.material[p] == none) continue;
    for (int o = 0; o < half_neighbours; ++o) {
      const Offset& plus = offsets[o];
      now[2 * o] = neighbour(covers, stencil, p, plus);
      now[2 * o + 1] = neighbour(covers, stencil, p, {-plus[0], -plus[1], -plus[2]});
    }
    const bool goes_on = runs.count() > 0 && runs.first.back() + runs.length.back() == p &&
                         runs.material.back() == stencil.material[p] &&
                         runs.length.back() < StencilRuns::max_length && now == next;
    if (goes_on) {
      ++runs.length.back();
    } else {
      runs.first.push_back(p);
      runs.length.push_back(1);
      runs.material.push_back(stencil.material[p]);
      runs.neighbour.insert(runs.neighbour.end(), now.begin(), now.end());
    }
    std::transform(now.begin(), now.end(), next.begin(), [](Index q) { return q + 1; });
  }
  return runs;
}

/// The block rows in ascending order of cover, with what is integrated into them, before slicing.
struct PlainRows {
  std::vector<Index> cover, source_begin, column_begin;
  std::vector<Source> source;
  std::vector<Index> column;

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

void gather_columns(const CoverArrays& covers, PlainRows& rows) {
  bool couple[8][8];
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b) couple[a][b] = corners_couple(a, b);
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
        for (int c = 0; c < 8; ++c)
          if (couple[source % 8][c]) add(covers.regular_cover[source / 8 * 8 + c]);
      } else {
        for (int a = 0; a < 4; ++a) add(covers.element_cover[(-1 - source) / 4 * 4 + a]);
      }
    }
    std::sort(rows.column.begin() + rows.column_begin.back(), rows.column.end());
    rows.column_begin.push_back(static_cast<Index>(rows.column.size()));
  }
}

/// Rows of like length side by side, sorted within windows small enough to keep neighbours near.
std::vector<Index> slice_order(const PlainRows& rows) {
  constexpr std::size_t window = 512;
  std::vector<Index> order(rows.cover.size());
  for (std::size_t b = 0; b < order.size(); ++b) order[b] = static_cast<Index>(b);
  for (std::size_t w = 0; w < order.size(); w += window)
    std::stable_sort(order.begin() + w, order.begin() + std::min(w + window, order.size()),
                     [&](Index a, Index b) { return rows.length(a) > rows.length(b); });
  return order;
}

BlockRows slice_rows(const PlainRows& rows, int lanes) {
  BlockRows sliced;
  sliced.lanes = lanes;
  sliced.slice_begin.push_back(0);
  sliced.source_begin.push_back(0);
  const std::vector<Index> order = slice_order(rows);
  for (std::size_t begin = 0; begin < order.size(); begin += lanes) {
    const Index longest = rows.length(order[begin]);
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

}  // namespace

std::array<Offset, half_neighbours> stencil_offsets() {
  std::vector<Offset> found;
  for (const auto& tet : tet6_corner)
    for (int from : tet)
      for (int to : tet) {
        const Offset a = corner_offset(from), b = corner_offset(to);
        const Offset offset{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        if (offset > Offset{0, 0, 0}) found.push_back(offset);
      }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::array<Offset, half_neighbours> result{};
  std::copy(found.begin(), found.end(), result.begin());
  return result;
}

bool corners_couple(int a, int b) {
  return std::any_of(std::begin(tet6_corner), std::end(tet6_corner), [=](const auto& tet) {
    auto has = [&](int c) { return std::find(std::begin(tet), std::end(tet), c) != std::end(tet); };
    return has(a) && has(b);
  });
}

Rows sort_rows(const CoverArrays& covers, int lanes, bool stencils) {
  StencilCovers stencil = find_stencil_covers(covers);
  if (!stencils) std::fill(stencil.material.begin(), stencil.material.end(), none);
  PlainRows plain;
  std::vector<Index> row_of_cover(covers.cover_node.size(), none);
  for (Index p = 0; p < covers.cover_count(); ++p)
    if (stencil.material[p] == none) {
      row_of_cover[p] = static_cast<Index>(plain.cover.size());
      plain.cover.push_back(p);
    }
  gather_sources(covers, row_of_cover, plain);
  gather_columns(covers, plain);

  Rows rows;
  rows.stencil = make_runs(covers, stencil);
  rows.block = slice_rows(plain, lanes);
  rows.block_rows = static_cast<Index>(plain.cover.size());
  rows.stencil_rows = covers.cover_count() - rows.block_rows;
  rows.block_entries = static_cast<std::int64_t>(plain.column.size());
  return rows;
}

}  // namespace rockfold::solve
