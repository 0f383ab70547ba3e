#include <cmath>

#include "kernels/precondition/levels/dense_parts_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Pivots below this share of their diagonal are rounding: blocks are sums in double of values in single precision.
constexpr Real no_pivot = 2e-6;

/// Inverts a symmetric positive semi-definite matrix a[n][n] by Cholesky's factors, leaving out the unknowns that depend on the
/// ones before: their rows and columns of the inverse are zero.
void invert_dense(Real* a, std::size_t n) {
  std::vector<Real> l(a, a + n * n), column(n);
  for (std::size_t j = 0; j < n; ++j) {
    Real* row_j = &l[n * j];
    Real pivot = row_j[j];
    for (std::size_t k = 0; k < j; ++k) pivot -= row_j[k] * row_j[k];
    const bool regular = pivot > no_pivot * row_j[j];
    row_j[j] = regular ? std::sqrt(pivot) : 0;
    for (std::size_t i = j + 1; i < n; ++i) {
      Real* row_i = &l[n * i];
      Real sum = row_i[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row_i[k] * row_j[k];
      row_i[j] = regular ? sum / row_j[j] : 0;
    }
  }
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      Real sum = i == c ? 1 : 0;
      for (std::size_t k = c; k < i; ++k) sum -= l[n * i + k] * column[k];
      column[i] = i < c || l[n * i + i] == 0 ? 0 : sum / l[n * i + i];
    }
    for (std::size_t i = n; i-- > 0;) {
      Real sum = column[i];
      for (std::size_t k = i + 1; k < n; ++k) sum -= l[n * k + i] * column[k];
      column[i] = l[n * i + i] == 0 ? 0 : sum / l[n * i + i];
    }
    for (std::size_t i = 0; i < n; ++i) a[n * i + c] = column[i];
  }
}

/// The matrix on the host.
struct HostMatrix {
  std::vector<Index> slice_begin, value_begin, column, row, place;
  std::vector<float> value, own;
  std::vector<Index> point_begin, unknown;  // of the terms
  std::vector<Real> weight;
  std::vector<std::array<Real, 6>> tangent;

  explicit HostMatrix(const LevelMatrix& a)
      : slice_begin(device::to_host(a.block.slice_begin)),
        value_begin(device::to_host(a.block.value_begin)),
        column(device::to_host(a.block.column)),
        row(device::to_host(a.block.row)),
        place(device::to_host(a.place)),
        value(device::to_host(a.block.value)),
        own(device::to_host(a.block.own)) {
    const SingleTerms& s = a.terms;
    if (!s.any()) return;
    point_begin = device::to_host(s.points.begin);
    unknown = device::to_host(s.points.unknown);
    weight = device::to_host(s.points.weight);
    tangent.resize(point_begin.size() - 1);
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), s.tangent);
    for (std::size_t n = 0; n < tangent.size(); ++n)
      for (int m = 0; m < 6; ++m) tangent[n][m] = host(n, m);
  }

  void add(HostBlocks& to) const {
    for (Index p = 0; p < to.covers; ++p) {
      const Index slot = place[p], slice = slot / slice_lanes, lane = slot % slice_lanes;
      std::array<Real, 9> diagonal{};
      for (int i = 0; i < 3; ++i) diagonal[4 * i] = own[3 * static_cast<std::size_t>(slot) + i];
      for (Index k = slice_begin[slice]; k < slice_begin[slice + 1]; ++k) {
        const Index q = column[static_cast<std::size_t>(k) * slice_lanes + lane];
        if (q == p) continue;
        const std::size_t first =
            9 * static_cast<std::size_t>(value_begin[slice] + k - slice_begin[slice]);
        Real* block = to.at(p, q);
        for (int ij = 0; ij < 9; ++ij) {
          const Real v = value[(first + ij) * slice_lanes + lane];
          block[ij % 3 * 3 + ij / 3] += v;
          diagonal[ij] -= v;
        }
      }
      Real* block = to.at(p, p);
      for (int ij = 0; ij < 9; ++ij) block[ij % 3 * 3 + ij / 3] += diagonal[ij];
    }
  }

  /// Adds the rows `member` to dense[n][n], n = 3 · members.
  void add(const Index* member, Index members, const std::vector<Index>& at, Real* dense) const {
    const std::size_t n = 3 * static_cast<std::size_t>(members);
    for (Index m = 0; m < members; ++m) {
      const Index p = member[m], slot = place[p];
      const Index slice = slot / slice_lanes, lane = slot % slice_lanes;
      auto entry = [&](int i, Index to, int j) -> Real& {
        return dense[n * (3 * m + i) + 3 * static_cast<std::size_t>(to) + j];
      };
      for (int i = 0; i < 3; ++i) entry(i, m, i) += own[3 * static_cast<std::size_t>(slot) + i];
      for (Index k = slice_begin[slice]; k < slice_begin[slice + 1]; ++k) {
        const Index q = column[static_cast<std::size_t>(k) * slice_lanes + lane];
        if (q == p) continue;
        const std::size_t first =
            9 * static_cast<std::size_t>(value_begin[slice] + k - slice_begin[slice]);
        for (int ij = 0; ij < 9; ++ij) {
          const Real v = value[(first + ij) * slice_lanes + lane];
          entry(ij / 3, at[q], ij % 3) += v;
          entry(ij / 3, m, ij % 3) -= v;
        }
      }
    }
  }
};

/// Adds the terms between members of one part to that part's matrix, dense[first …].
void add_terms(const HostMatrix& a, const std::vector<Index>& part, const std::vector<Index>& at,
               const std::vector<Index>& begin, const std::vector<std::int64_t>& first,
               std::vector<Real>& dense) {
  for (std::size_t n = 0; n < a.tangent.size(); ++n)
    for (Index i = a.point_begin[n]; i < a.point_begin[n + 1]; ++i)
      for (Index j = a.point_begin[n]; j < a.point_begin[n + 1]; ++j) {
        const Index p = a.unknown[i], q = a.unknown[j], c = part[p];
        if (part[q] != c) continue;
        const std::int64_t width = std::int64_t{3} * (begin[c + 1] - begin[c]);
        const Real w = a.weight[i] * a.weight[j];
        for (int d = 0; d < 3; ++d)
          for (int e = 0; e < 3; ++e)
            dense[first[c] + width * (3 * at[p] + d) + 3 * at[q] + e] +=
                w * a.tangent[n][symmetric_entry(d, e)];
      }
}

}  // namespace

DenseParts make_dense_parts(const std::vector<Index>& part) {
  const std::size_t rows = part.size();
  std::vector<Index> number(rows, none), of_row(rows), at(rows), size, begin{0}, member(rows);
  for (std::size_t p = 0; p < rows; ++p) {
    Index& n = number[part[p]];
    if (n == none) {
      n = static_cast<Index>(size.size());
      size.push_back(0);
    }
    of_row[p] = n;
    at[p] = size[n]++;
  }
  std::vector<std::int64_t> first;
  std::int64_t values = 0;
  for (Index s : size) {
    first.push_back(values);
    values += 9 * std::int64_t{s} * s;
    begin.push_back(begin.back() + s);
  }
  for (std::size_t p = 0; p < rows; ++p) member[begin[of_row[p]] + at[p]] = static_cast<Index>(p);
  using device::to_device;
  return {to_device("solve::part", of_row),
          to_device("solve::part_begin", begin),
          to_device("solve::part_member", member),
          to_device("solve::part_at", at),
          to_device("solve::part_first", first),
          device::allocate<float>("solve::part_inverse", static_cast<std::size_t>(values))};
}

void invert_parts(const LevelMatrix& a, const DenseParts& parts) {
  const HostMatrix matrix(a);
  const std::vector<Index> begin = device::to_host(parts.begin),
                           member = device::to_host(parts.member), at = device::to_host(parts.at);
  const std::vector<std::int64_t> first = device::to_host(parts.first);
  std::vector<Real> values(parts.inverse.extent(0), 0.0);
  add_terms(matrix, device::to_host(parts.part), at, begin, first, values);
  for (std::size_t c = 0; c + 1 < begin.size(); ++c) {
    const Index members = begin[c + 1] - begin[c];
    matrix.add(&member[begin[c]], members, at, &values[first[c]]);
    invert_dense(&values[first[c]], 3 * static_cast<std::size_t>(members));
  }
  std::vector<float> inverse(values.begin(), values.end());
  Kokkos::deep_copy(parts.inverse, device::Unmanaged<float>(inverse.data(), inverse.size()));
}

void factorise(CoarsestFactors& coarsest, const LevelMatrix& a) {
  HostBlocks blocks{a.rows, 3, {}, {}, {}, {}};
  HostMatrix(a).add(blocks);
  add_rows(blocks, a.contacts.a);
  if (a.terms.any())
    add_points(blocks, a.terms.points, tangents_on_host(a.terms.points.count, a.terms.tangent));
  factorise(coarsest, blocks, 0, no_pivot);
}

void solve_parts(const DenseParts& parts, const SingleField& r, const SingleField& x) {
  const DenseParts p = parts;
  device::for_each(
      "rockfold::solve::solve_parts", static_cast<Index>(p.part.extent(0)),
      KOKKOS_LAMBDA(const Index row) {
        const Index part = p.part(row), begin = p.begin(part), members = p.begin(part + 1) - begin;
        for (int i = 0; i < 3; ++i) {
          const float* a =
              &p.inverse(p.first(part) + std::int64_t{3} * members * (3 * p.at(row) + i));
          float sum = 0;
          for (Index m = 0; m < members; ++m)
            for (int j = 0; j < 3; ++j) sum += a[3 * m + j] * r(p.member(begin + m), j);
          x(row, i) = sum;
        }
      });
}

}  // namespace rockfold::solve
