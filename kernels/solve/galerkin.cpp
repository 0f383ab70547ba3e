// Coarse levels: their rows, interpolation, and Galerkin's product. A coarse row gathers from the rows of its children, so that
// each value is summed by one thread in one order.
#include <algorithm>

#include "kernels/solve/level_kernel.hpp"

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

/// Rows of like length side by side, within windows small enough to keep neighbours near.
std::vector<Index> slice_order(const CoarseCovers& covers) {
  constexpr Index window = 512;
  std::vector<Index> order(covers.place.size());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = static_cast<Index>(p);
  const auto length = [&](Index p) { return covers.column_begin[p + 1] - covers.column_begin[p]; };
  for (Index w = 0; w < covers.count(); w += window)
    std::stable_sort(order.begin() + w, order.begin() + std::min(w + window, covers.count()),
                     [&](Index a, Index b) { return length(a) > length(b); });
  return order;
}

/// Products under way: some slices of the coarse matrix in double precision.
struct Products {
  LevelMatrix fine;
  Interpolation p;
  Array<Index>
      spring_row;  ///< [fine rows] their row among those of the springs, or none; empty where there are no springs
  SingleBlocks block;
  Array<std::int64_t> lattice;
  Index first_slice = 0;
  Array<Real> sum;  ///< as block.value, from first_slice on
};

/// A coarse row under way.
struct ProductRow {
  Index row, begin, end;  ///< columns
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

/// Where the sums of column q are; null where the row has none: a spring between covers that share no element. What it
/// couples then stays in the row's own sum: that keeps the matrix definite.
KOKKOS_INLINE_FUNCTION Real* entry_of(const Products& g, const ProductRow& row, Index q) {
  const int node = neighbour_number(g.lattice(row.row), g.lattice(q));
  if (node >= 27) return nullptr;
  const Index begin = g.block.slice_begin(g.first_slice);
  for (Index k = row.first[node]; k < row.first[node + 1]; ++k)
    if (g.block.column(k * slice_lanes + row.lane) == q)
      return &g.sum(static_cast<std::size_t>(k - begin) * 9 * slice_lanes + row.lane);
  return nullptr;
}

/// Adds weight · block (its entries `stride` apart) for column j of the finer level.
KOKKOS_INLINE_FUNCTION void add_column(const Products& g, const ProductRow& row, Index j,
                                       float weight, const float* block, int stride) {
  for (Index k = g.p.parent_begin(j); k < g.p.parent_begin(j + 1); ++k) {
    const Index q = g.p.parent(k);
    if (q == row.row) continue;
    Real* sum = entry_of(g, row, q);
    if (sum == nullptr) continue;
    const Real w = Real(weight) * g.p.parent_weight(k);
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
    for (Index k = b.slice_begin(slice); k < b.slice_begin(slice + 1); ++k) {
      const Index j = b.column(k * slice_lanes + lane);
      if (j == i) continue;
      const float* block = &b.value(static_cast<std::size_t>(k) * 9 * slice_lanes + lane);
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

KOKKOS_INLINE_FUNCTION void add_springs(const Products& g, const ProductRow& row, Index i,
                                        float weight, Real* own) {
  const SingleSprings& s = g.fine.springs;
  const Index t = g.spring_row(i);
  if (t == none) return;
  for (Index k = s.row_begin(t); k < s.row_begin(t + 1); ++k) {
    const Index n = s.entry_point(s.row_entry(k));
    const float w = static_cast<float>(weight * s.points.weight(s.row_entry(k)));
    for (Index e = s.points.begin(n); e < s.points.begin(n + 1); ++e) {
      const Real v = w * s.points.weight(e);
      float block[9] = {};
      for (int d = 0; d < 3; ++d) {
        block[4 * d] = s.stiffness(n, d);
        own[d] += v * s.stiffness(n, d);
      }
      add_column(g, row, s.points.unknown(e), static_cast<float>(v), block, 1);
    }
  }
}

KOKKOS_INLINE_FUNCTION void multiply_row(const Products& g, Index slot) {
  const Index slice = slot / slice_lanes;
  ProductRow row{g.block.row(slot),
                 g.block.slice_begin(slice),
                 g.block.slice_begin(slice + 1),
                 slot % slice_lanes,
                 {}};
  Real own[3] = {0, 0, 0};
  if (row.row != none) {
    find_nodes(g, row);
    for (Index c = g.p.child_begin(row.row); c < g.p.child_begin(row.row + 1); ++c) {
      add_row(g, row, g.p.child(c), g.p.child_weight(c), own);
      if (g.spring_row.extent(0) > 0) add_springs(g, row, g.p.child(c), g.p.child_weight(c), own);
    }
  }
  for (int d = 0; d < 3; ++d)
    g.block.own(3 * static_cast<std::size_t>(slot) + d) = static_cast<float>(own[d]);
}

/// The products of slices [begin, end).
void multiply_slices(Products& g, const std::vector<Index>& slice_begin, Index begin, Index end) {
  const std::size_t first = static_cast<std::size_t>(slice_begin[begin]) * 9 * slice_lanes;
  const Index values = (slice_begin[end] - slice_begin[begin]) * 9 * slice_lanes;
  g.first_slice = begin;
  const Products now = g;
  device::for_each(
      "rockfold::solve::clear_products", values, KOKKOS_LAMBDA(const Index i) { now.sum(i) = 0; });
  device::for_each(
      "rockfold::solve::products", (end - begin) * slice_lanes,
      KOKKOS_LAMBDA(const Index i) { multiply_row(now, begin * slice_lanes + i); });
  device::for_each(
      "rockfold::solve::store_products", values, KOKKOS_LAMBDA(const Index i) {
        now.block.value(first + i) = static_cast<float>(now.sum(i));
      });
}

Array<Index> find_spring_rows(const LevelMatrix& fine) {
  if (fine.springs.points.count == 0) return {};
  Array<Index> found = device::allocate<Index>("solve::spring_row_of", fine.rows);
  Kokkos::deep_copy(found, none);
  const auto row = fine.springs.row;
  device::for_each(
      "rockfold::solve::spring_row_of", static_cast<Index>(row.extent(0)),
      KOKKOS_LAMBDA(const Index t) { found(row(t)) = t; });
  return found;
}

}  // namespace

Interpolation make_interpolation(const CoarseCovers& coarse) {
  std::vector<Index> begin(coarse.place.size() + 1, 0), child(coarse.parent.size());
  std::vector<float> weight(child.size());
  for (Index q : coarse.parent) ++begin[q + 1];
  for (std::size_t q = 0; q < coarse.place.size(); ++q) begin[q + 1] += begin[q];
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  for (std::size_t p = 0; p + 1 < coarse.parent_begin.size(); ++p)
    for (Index k = coarse.parent_begin[p]; k < coarse.parent_begin[p + 1]; ++k) {
      const Index at = end[coarse.parent[k]]++;
      child[at] = static_cast<Index>(p);
      weight[at] = coarse.weight[k];
    }
  using device::to_device;
  return {to_device("solve::parent_begin", coarse.parent_begin),
          to_device("solve::parent", coarse.parent),
          to_device("solve::parent_weight", coarse.weight),
          to_device("solve::child_begin", begin),
          to_device("solve::child", child),
          to_device("solve::child_weight", weight)};
}

CoarseRows make_coarse_rows(const CoarseCovers& coarse) {
  const std::vector<Index> order = slice_order(coarse);
  const Index rows = coarse.count();
  const auto length = [&](Index p) {
    return coarse.column_begin[p + 1] - coarse.column_begin[p] - 1;  // without its own
  };
  std::vector<Index> row, slice_begin{0}, column, place(coarse.place.size());
  for (Index begin = 0; begin < rows; begin += slice_lanes) {
    const Index longest = length(order[begin]);
    const std::size_t first = column.size();
    column.resize(first + static_cast<std::size_t>(longest) * slice_lanes, 0);
    for (int l = 0; l < slice_lanes; ++l) {
      const Index p = begin + l < rows ? order[begin + l] : none;
      row.push_back(p);
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
  }
  std::vector<std::int64_t> lattice;
  for (const HalfPlace& p : coarse.place) lattice.push_back(pack(p));
  using device::to_device;
  CoarseRows result;
  result.block = {to_device("solve::coarse_row", row),
                  to_device("solve::coarse_slice_begin", slice_begin),
                  to_device("solve::coarse_column", column),
                  device::allocate<float>("solve::coarse_value", 9 * column.size()),
                  device::allocate<float>("solve::coarse_own", 3 * row.size())};
  result.place = to_device("solve::coarse_place", place);
  result.lattice = to_device("solve::coarse_lattice", lattice);
  return result;
}

LevelMatrix coarse_matrix(const LevelMatrix& fine, const Interpolation& p, const CoarseRows& rows) {
  constexpr Index most_columns = 1 << 14;  // at once: 9 MB of sums
  const std::vector<Index> begin = device::to_host(rows.block.slice_begin);
  const Index slices = rows.block.slices();
  Index largest = 0;
  std::vector<Index> portion{0};
  for (Index s = 0; s < slices; ++s)
    if (s + 1 == slices || begin[s + 2] - begin[portion.back()] > most_columns) {
      largest = std::max(largest, begin[s + 1] - begin[portion.back()]);
      portion.push_back(s + 1);
    }
  Products g{fine,
             p,
             find_spring_rows(fine),
             rows.block,
             rows.lattice,
             0,
             device::allocate<Real>("solve::products",
                                    static_cast<std::size_t>(largest) * 9 * slice_lanes)};
  for (std::size_t i = 0; i + 1 < portion.size(); ++i)
    multiply_slices(g, begin, portion[i], portion[i + 1]);
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
          for (Index k = block.slice_begin(slice); k < block.slice_begin(slice + 1); ++k)
            sum -= block.value((static_cast<std::size_t>(k) * 9 + at[m]) * slice_lanes + lane);
          diagonal(p, m) = sum;
        }
      });
  invert_blocks(diagonal);
  device::for_each(
      "rockfold::solve::level_inverse", a.rows, KOKKOS_LAMBDA(const Index p) {
        for (int m = 0; m < 6; ++m) inverse(p, m) = static_cast<float>(diagonal(p, m));
      });
}

}  // namespace rockfold::solve
