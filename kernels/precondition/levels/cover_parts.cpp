#include "kernels/precondition/cover_grid_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Added to the unit diagonal. Functions are dependent: what rounding leaves of a residual in directions of no energy must not grow.
constexpr Real least_stiffness = 1e-3;

/// Where entry (row e of member m, column f of member o) of a part stands.
KOKKOS_INLINE_FUNCTION std::int64_t entry(Index members, int width, Index m, int e, Index o,
                                          int f) {
  return (std::int64_t{m} * width + e) * members * width + std::int64_t{o} * width + f;
}

KOKKOS_INLINE_FUNCTION void add_terms(const CoverParts& parts, const PointTerms& s, Index covers,
                                      int functions, Index p, Real* a) {
  const Index part = parts.part(p), members = parts.begin(part + 1) - parts.begin(part);
  for (int k = 0; k < functions; ++k) {
    const Index t = find_row(s.row, k * covers + p);
    if (t == none) continue;
    for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i) {
      const Index point = s.row_point(i);
      for (Index j = s.points.begin(point); j < s.points.begin(point + 1); ++j) {
        const Index q = s.points.unknown(j) % covers;
        const int l = s.points.unknown(j) / covers;
        if (parts.part(q) != part) continue;
        const Real w = s.row_weight(i) * s.points.weight(j);
        for (int d = 0; d < 3; ++d)
          for (int e = 0; e < 3; ++e)
            a[entry(members, 3 * functions, parts.at(p), 3 * k + d, parts.at(q), 3 * l + e)] +=
                w * s.tangent(point, symmetric_entry(d, e));
      }
    }
  }
}

/// Scales the matrix of a part to a unit diagonal and inverts it.
KOKKOS_INLINE_FUNCTION void invert_part(const CoverParts& parts, Index part, int width, Real* a) {
  const Index begin = parts.begin(part), members = parts.begin(part + 1) - begin;
  const std::int64_t n = std::int64_t{members} * width;
  const auto scale = [&](std::int64_t i) -> Real& {
    return parts.scale(std::int64_t{parts.member(begin + i / width)} * width + i % width);
  };
  for (std::int64_t i = 0; i < n; ++i)
    scale(i) = a[i * n + i] > 0 ? 1 / device::math::sqrt(a[i * n + i]) : 0;
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = 0; j < n; ++j) a[i * n + j] *= scale(i) * scale(j);
  for (std::int64_t i = 0; i < n; ++i) a[i * n + i] += least_stiffness;
  invert_symmetric(static_cast<int>(n), a);
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = i; j < n; ++j) {
      a[i * n + j] *= scale(i) * scale(j);
      a[j * n + i] = a[i * n + j];
    }
}

}  // namespace

CoverParts make_cover_parts(const std::vector<Index>& part, int functions) {
  const std::size_t covers = part.size();
  std::vector<Index> number(covers, none), of(covers), at(covers), size, begin{0}, member(covers);
  for (std::size_t p = 0; p < covers; ++p) {
    Index& n = number[part[p]];
    if (n == none) {
      n = static_cast<Index>(size.size());
      size.push_back(0);
    }
    of[p] = n;
    at[p] = size[n]++;
  }
  std::vector<std::int64_t> first;
  std::int64_t values = 0;
  for (const Index s : size) {
    first.push_back(values);
    values += std::int64_t{s} * s * 9 * functions * functions;
    begin.push_back(begin.back() + s);
  }
  for (std::size_t p = 0; p < covers; ++p) member[begin[of[p]] + at[p]] = static_cast<Index>(p);
  using device::to_device;
  return {to_device("solve::cover_part_begin", begin),
          to_device("solve::cover_part_member", member),
          to_device("solve::cover_part", of),
          to_device("solve::cover_part_at", at),
          to_device("solve::cover_part_first", first),
          device::allocate<Real>("solve::cover_part_inverse", static_cast<std::size_t>(values)),
          device::allocate<Real>("solve::cover_part_scale", covers * 3 * functions)};
}

void invert_parts(const CoverMatrix& a, const PointTerms& terms, const CoverParts& parts) {
  const CoverMatrix m = a;
  const CoverParts to = parts;
  Kokkos::deep_copy(parts.inverse, 0.0);
  device::for_each(
      "rockfold::solve::gather_parts", m.covers, KOKKOS_LAMBDA(const Index p) {
        const Index part = to.part(p), members = to.begin(part + 1) - to.begin(part);
        const int width = m.width();
        Real* values = &to.inverse(to.first(part));
        for (Index k = m.begin(p); k < m.begin(p + 1); ++k)
          for (int f = 0; f < width; ++f)
            for (int e = 0; e < width; ++e)
              values[entry(members, width, to.at(p), e, to.at(m.column(k)), f)] =
                  m.value((static_cast<std::size_t>(k) * width + f) * width + e);
        if (terms.any()) add_terms(to, terms, m.covers, m.functions, p, values);
      });
  device::for_each(
      "rockfold::solve::invert_cover_parts", static_cast<Index>(parts.first.extent(0)),
      KOKKOS_LAMBDA(const Index part) {
        invert_part(to, part, m.width(), &to.inverse(to.first(part)));
      });
}

void factorise(CoarsestFactors& coarsest, const CoverMatrix& a, const PointTerms& terms,
               const ContactRows& contacts) {
  HostBlocks blocks{a.covers, a.width(), {}, {}, {}, {}};
  add_rows(blocks, a);
  add_rows(blocks, contacts.a);
  if (terms.any())
    add_points(blocks, terms.points, tangents_on_host(terms.points.count, terms.tangent));
  factorise(coarsest, blocks, least_stiffness, least_pivot);
}

void solve_parts(const CoverParts& parts, int functions, const Field& r, const Field& x) {
  const CoverParts p = parts;
  const Index covers = static_cast<Index>(p.part.extent(0));
  const int width = 3 * functions;
  device::for_each(
      "rockfold::solve::solve_cover_parts", covers, KOKKOS_LAMBDA(const Index row) {
        const Index part = p.part(row), begin = p.begin(part), members = p.begin(part + 1) - begin;
        const Real* a = &p.inverse(p.first(part) + entry(members, width, p.at(row), 0, 0, 0));
        for (int e = 0; e < width; ++e) {
          Real sum = 0;
          for (Index m = 0; m < members; ++m)
            for (int f = 0; f < width; ++f, ++a)
              sum += *a * r(f / 3 * covers + p.member(begin + m), f % 3);
          x(e / 3 * covers + row, e % 3) = sum;
        }
      });
}

}  // namespace rockfold::solve
