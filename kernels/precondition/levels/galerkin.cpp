// Coarse levels: their rows, interpolation, and Galerkin's product. A coarse row gathers from the rows of its children, so that
// each value is summed by one thread in one order.
#include <algorithm>
#include <array>
#include <map>

#include "kernels/precondition/levels/level_kernel.hpp"

namespace rockfold::solve {
namespace {

constexpr int x_bits = 0, y_bits = 21, z_bits = 42;

std::int64_t pack(const HalfPlace& place) {
  return (std::int64_t{place[0] / 2} << x_bits) + (std::int64_t{place[1] / 2} << y_bits) +
         (std::int64_t{place[2] / 2} << z_bits);
}

/// Neighbouring nodes, themselves among them, in the order of columns: 0 … 26.
KOKKOS_INLINE_FUNCTION int neighbour_number(std::int64_t from, std::int64_t to) {
  const std::int64_t one =
      (std::int64_t{1} << x_bits) + (std::int64_t{1} << y_bits) + (std::int64_t{1} << z_bits);
  const std::int64_t step = to - from + one;  // 0, 1 or 2 in each direction
  return static_cast<int>((step >> x_bits & 3) + 3 * (step >> y_bits & 3) +
                          9 * (step >> z_bits & 3));
}

/// Rows of like length and class side by side, within windows small enough to keep neighbours near.
std::vector<Index> slice_order(const CoarseCovers& covers, const std::vector<Index>& classes) {
  constexpr Index window = 512;
  std::vector<Index> order(covers.place.size());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = static_cast<Index>(p);
  const auto length = [&](Index p) { return covers.column_begin[p + 1] - covers.column_begin[p]; };
  for (Index w = 0; w < covers.count(); w += window)
    std::stable_sort(order.begin() + w, order.begin() + std::min(w + window, covers.count()),
                     [&](Index a, Index b) {
                       return length(a) != length(b) ? length(a) > length(b)
                                                     : classes[a] < classes[b];
                     });
  return order;
}

/// Products under way: some slices of the coarse matrix in double precision.
struct Products {
  LevelMatrix fine;
  Interpolation p;
  SingleBlocks block;
  Array<std::int64_t> lattice;
  Index first_slice = 0;
  Array<Real> sum;  ///< as block.value, from the first slice's on
};

/// A coarse row under way.
struct ProductRow {
  Index row, begin, end;  ///< columns
  Index sums;             ///< where those of the first column stand, in columns
  int lane;
  Index first[28];  ///< the first column of each neighbouring node
};

KOKKOS_INLINE_FUNCTION void find_nodes(const Products& g, ProductRow& row) {
  Index k = row.begin;
  for (int node = 0; node < 27; ++node) {
    row.first[node] = k;
    while (k < row.end && g.block.column(k * slice_lanes + row.lane) != row.row &&
           neighbour_number(g.lattice(row.row),
                            g.lattice(g.block.column(k * slice_lanes + row.lane))) == node)
      ++k;
  }
  row.first[27] = k;
}

/// Where the sums of column q are; null where the row has none.
KOKKOS_INLINE_FUNCTION Real* entry_of(const Products& g, const ProductRow& row, Index q) {
  const int node = neighbour_number(g.lattice(row.row), g.lattice(q));
  if (node >= 27) return nullptr;
  for (Index k = row.first[node]; k < row.first[node + 1]; ++k)
    if (g.block.column(k * slice_lanes + row.lane) == q)
      return &g.sum(static_cast<std::size_t>(row.sums + k - row.begin) * 9 * slice_lanes +
                    row.lane);
  return nullptr;
}

/// Adds weight · block (its entries `stride` apart) for column j of the finer level.
KOKKOS_INLINE_FUNCTION void add_column(const Products& g, const ProductRow& row, Index j,
                                       float weight, const float* block, int stride) {
  const Real w = Real(weight) * g.p.parent_weight(j);
  for (Index k = g.p.parent_begin(j); k < g.p.parent_begin(j + 1); ++k) {
    const Index q = g.p.parent(k);
    if (q == row.row) continue;
    Real* sum = entry_of(g, row, q);
    if (sum == nullptr) continue;
    for (int m = 0; m < 9; ++m) sum[m * slice_lanes] += w * block[m * stride];
  }
}

/// Adds weight · row i of the finer level; own: D. The row's diagonal block is what its D and its other blocks leave.
KOKKOS_INLINE_FUNCTION void add_row(const Products& g, const ProductRow& row, Index i, float weight,
                                    Real* own) {
  const Index place = g.fine.place(i);
  float diagonal[9] = {}, sum[3];
  if (place < 0) {
    const SingleStencil& s = g.fine.stencil;
    const Index run = -1 - place, along = i - s.first(run), offsets = 2 * s.run_pairs(run);
    const float* block = &s.table(s.run_table(run));
    for (Index o = 0; o < offsets; ++o, block += 9) {
      add_column(g, row, s.neighbour(s.neighbour_begin(run) + o) + along, weight, block, 1);
      for (int m = 0; m < 9; ++m) diagonal[m] -= block[m];
    }
    for (float& entry : sum) entry = *block;
  } else {
    const SingleBlocks& b = g.fine.block;
    const Index slice = place / slice_lanes;
    const int lane = place % slice_lanes;
    const float* block = b.values(slice) + lane;
    for (Index k = b.slice_begin(slice); k < b.slice_begin(slice + 1);
         ++k, block += 9 * slice_lanes) {
      const Index j = b.column(k * slice_lanes + lane);
      if (j == i) continue;
      add_column(g, row, j, weight, block, slice_lanes);
      for (int m = 0; m < 9; ++m) diagonal[m] -= block[m * slice_lanes];
    }
    for (int d = 0; d < 3; ++d) sum[d] = b.own(3 * static_cast<std::size_t>(place) + d);
  }
  for (int d = 0; d < 3; ++d) {
    diagonal[4 * d] += sum[d];
    own[d] += Real(weight) * sum[d];
  }
  add_column(g, row, i, weight, diagonal, 1);
}

KOKKOS_INLINE_FUNCTION void multiply_row(const Products& g, Index slot) {
  const Index slice = slot / slice_lanes;
  ProductRow row{g.block.row(slot),
                 g.block.slice_begin(slice),
                 g.block.slice_begin(slice + 1),
                 g.block.value_begin(slice) - g.block.value_begin(g.first_slice),
                 slot % slice_lanes,
                 {}};
  Real own[3] = {0, 0, 0};
  if (row.row != none) {
    find_nodes(g, row);
    for (Index c = g.p.child_begin(row.row); c < g.p.child_begin(row.row + 1); ++c)
      add_row(g, row, g.p.child(c), g.p.child_weight(c), own);
  }
  for (int d = 0; d < 3; ++d)
    g.block.own(3 * static_cast<std::size_t>(slot) + d) = static_cast<float>(own[d]);
}

/// The products of `count` slices.
void multiply_slices(Products& g, const Index* slice, Index count, Index columns) {
  const Index values = columns * 9 * slice_lanes;
  g.first_slice = slice[0];
  const Products now = g;
  const auto list =
      device::to_device("solve::product_slices", std::vector<Index>(slice, slice + count));
  device::for_each(
      "rockfold::solve::clear_products", values, KOKKOS_LAMBDA(const Index i) { now.sum(i) = 0; });
  device::for_each(
      "rockfold::solve::products", count * slice_lanes, KOKKOS_LAMBDA(const Index i) {
        multiply_row(now, list(i / slice_lanes) * slice_lanes + i % slice_lanes);
      });
  device::for_each(
      "rockfold::solve::store_products", values, KOKKOS_LAMBDA(const Index i) {
        now.block.values(now.first_slice)[i] = static_cast<float>(now.sum(i));
      });
}

}  // namespace

Interpolation make_interpolation(const CoarseCovers& coarse) {
  std::vector<Index> begin(coarse.place.size() + 1, 0), child(coarse.parent.size());
  std::vector<std::uint8_t> parents(child.size());
  for (Index q : coarse.parent) ++begin[q + 1];
  for (std::size_t q = 0; q < coarse.place.size(); ++q) begin[q + 1] += begin[q];
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  for (std::size_t p = 0; p + 1 < coarse.parent_begin.size(); ++p)
    for (Index k = coarse.parent_begin[p]; k < coarse.parent_begin[p + 1]; ++k) {
      const Index at = end[coarse.parent[k]]++;
      child[at] = static_cast<Index>(p);
      parents[at] = static_cast<std::uint8_t>(coarse.parent_begin[p + 1] - coarse.parent_begin[p]);
    }
  using device::to_device;
  return {to_device("solve::parent_begin", coarse.parent_begin),
          to_device("solve::parent", coarse.parent), to_device("solve::child_begin", begin),
          to_device("solve::child", child), to_device("solve::child_parents", parents)};
}

std::vector<Index> coarse_classes(const CoarseCovers& coarse, const std::vector<Index>& fine) {
  constexpr int around = 27;
  std::vector<std::array<Index, around>> children(coarse.place.size());
  std::vector<int> count(coarse.place.size(), 0);
  for (std::size_t p = 0; p < fine.size(); ++p)
    for (Index k = coarse.parent_begin[p]; k < coarse.parent_begin[p + 1]; ++k) {
      const Index q = coarse.parent[k];
      if (count[q] < around) children[q][count[q]] = fine[p];
      ++count[q];
    }
  std::map<std::array<Index, around>, Index> known;
  std::vector<Index> classes(coarse.place.size(), none);
  for (Index q = 0; q < coarse.count(); ++q) {
    if (count[q] != around) continue;
    if (std::count(children[q].begin(), children[q].end(), none) > 0) continue;
    const Index begin = coarse.column_begin[q], columns = coarse.column_begin[q + 1] - begin;
    std::array<bool, around> met{};
    for (Index k = begin; k < begin + columns; ++k)
      met[neighbour_number(pack(coarse.place[q]), pack(coarse.place[coarse.column[k]]))] = true;
    if (columns != around || std::count(met.begin(), met.end(), true) != around) continue;
    classes[q] = known.try_emplace(children[q], static_cast<Index>(known.size())).first->second;
  }
  return classes;
}

CoarseRows make_coarse_rows(const CoarseCovers& coarse, const std::vector<Index>& classes) {
  const std::vector<Index> order = slice_order(coarse, classes);
  const Index rows = coarse.count();
  const auto length = [&](Index p) {
    return coarse.column_begin[p + 1] - coarse.column_begin[p] - 1;  // without its own
  };
  CoarseRows result;
  std::vector<Index> row, slice_begin{0}, column, value_begin, like, place(coarse.place.size());
  std::map<Index, Index> of_class;  // the slice that has its values
  Index values = 0;
  for (Index begin = 0; begin < rows; begin += slice_lanes) {
    const Index longest = length(order[begin]), slice = static_cast<Index>(like.size());
    const std::size_t first = column.size();
    column.resize(first + static_cast<std::size_t>(longest) * slice_lanes, 0);
    Index shared = classes[order[begin]];
    for (int l = 0; l < slice_lanes; ++l) {
      const Index p = begin + l < rows ? order[begin + l] : none;
      row.push_back(p);
      if (p == none || classes[p] != shared) shared = none;
      if (p == none) continue;
      place[p] = begin + l;
      std::size_t at = first + l;
      for (Index k = coarse.column_begin[p]; k < coarse.column_begin[p + 1]; ++k)
        if (coarse.column[k] != p) {
          column[at] = coarse.column[k];
          at += slice_lanes;
        }
      for (; at < column.size(); at += slice_lanes) column[at] = p;  // padding
    }
    slice_begin.push_back(slice_begin.back() + longest);
    like.push_back(shared == none ? slice : of_class.try_emplace(shared, slice).first->second);
    value_begin.push_back(like[slice] == slice ? values : value_begin[like[slice]]);
    if (like[slice] != slice) continue;
    values += longest;
    result.unlike.push_back(slice);
  }
  std::vector<std::int64_t> lattice;
  for (const HalfPlace& p : coarse.place) lattice.push_back(pack(p));
  using device::to_device;
  result.block = {to_device("solve::coarse_row", row),
                  to_device("solve::coarse_slice_begin", slice_begin),
                  to_device("solve::coarse_column", column),
                  to_device("solve::coarse_value_begin", value_begin),
                  device::allocate<float>("solve::coarse_value",
                                          static_cast<std::size_t>(values) * 9 * slice_lanes),
                  device::allocate<float>("solve::coarse_own", 3 * row.size())};
  result.like = to_device("solve::coarse_like", like);
  result.place = to_device("solve::coarse_place", place);
  result.lattice = to_device("solve::coarse_lattice", lattice);
  return result;
}

LevelMatrix coarse_matrix(const LevelMatrix& fine, const Interpolation& p, const CoarseRows& rows) {
  constexpr Index most_columns = 1 << 13;  // at once: 5 MB of sums
  const std::vector<Index> slice_begin = device::to_host(rows.block.slice_begin);
  const auto columns = [&](Index slice) { return slice_begin[slice + 1] - slice_begin[slice]; };
  struct Portion {
    std::size_t first;
    Index slices, columns;
  };
  std::vector<Portion> portions;
  Index largest = 0;
  for (std::size_t i = 0; i < rows.unlike.size(); ++i) {
    const Index more = columns(rows.unlike[i]);
    if (portions.empty() || portions.back().columns + more > most_columns)
      portions.push_back({i, 0, 0});
    ++portions.back().slices;
    portions.back().columns += more;
    largest = std::max(largest, portions.back().columns);
  }
  Products g{fine,
             p,
             rows.block,
             rows.lattice,
             0,
             device::allocate<Real>("solve::products",
                                    static_cast<std::size_t>(largest) * 9 * slice_lanes)};
  for (const Portion& portion : portions)
    multiply_slices(g, &rows.unlike[portion.first], portion.slices, portion.columns);
  const auto like = rows.like;
  const SingleBlocks block = rows.block;
  device::for_each(
      "rockfold::solve::share_own", block.slices(), KOKKOS_LAMBDA(const Index s) {
        if (like(s) == s) return;
        for (int e = 0; e < 3 * slice_lanes; ++e)
          block.own(3 * static_cast<std::size_t>(s) * slice_lanes + e) =
              block.own(3 * static_cast<std::size_t>(like(s)) * slice_lanes + e);
      });
  LevelMatrix coarse;
  coarse.rows = static_cast<Index>(rows.place.extent(0));
  coarse.block = rows.block;
  coarse.place = rows.place;
  return coarse;
}

void invert_diagonal(const LevelMatrix& a, const SingleInverse& inverse) {
  const Blocks diagonal("rockfold::solve::level_diagonal", a.rows);
  const SingleBlocks block = a.block;
  device::for_each(
      "rockfold::solve::level_diagonal", static_cast<Index>(block.row.extent(0)),
      KOKKOS_LAMBDA(const Index slot) {
        const Index p = block.row(slot), slice = slot / slice_lanes, lane = slot % slice_lanes;
        if (p == none) return;
        const int at[6] = {0, 4, 8, 1, 5, 2};
        for (int m = 0; m < 6; ++m) {
          Real sum = m < 3 ? block.own(3 * static_cast<std::size_t>(slot) + m) : 0;
          const Index columns = block.slice_begin(slice + 1) - block.slice_begin(slice);
          for (Index k = 0; k < columns; ++k)
            sum -=
                block.values(slice)[(static_cast<std::size_t>(k) * 9 + at[m]) * slice_lanes + lane];
          diagonal(p, m) = sum;
        }
      });
  const SingleTerms terms = a.terms;
  device::for_each(
      "rockfold::solve::level_terms", static_cast<Index>(terms.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) {
        for (Index k = terms.row_begin(t); k < terms.row_begin(t + 1); ++k) {
          const Real w = terms.row_weight(k);
          for (int m = 0; m < 6; ++m)
            diagonal(terms.row(t), m) += w * w * terms.tangent(terms.row_point(k), m);
        }
      });
  add_diagonal(a.contacts, diagonal);
  invert_blocks(diagonal);
  device::for_each(
      "rockfold::solve::level_inverse", a.rows, KOKKOS_LAMBDA(const Index p) {
        for (int m = 0; m < 6; ++m) inverse(p, m) = static_cast<float>(diagonal(p, m));
      });
}

}  // namespace rockfold::solve
