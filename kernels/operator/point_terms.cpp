#include "kernels/operator/point_terms_kernel.hpp"

namespace rockfold::solve {

PointTerms make_point_terms(const MaterialPoints& points, Index unknowns) {
  PointTerms terms;
  static_cast<PointRows&>(terms) = make_point_rows(points, unknowns);
  terms.tangent = Blocks("rockfold::solve::term_tangent", terms.points.count);
  terms.force = device::make_field("solve::term_force", terms.points.count);
  return terms;
}

void append_points(MaterialPoints& to, const MaterialPoints& from) {
  const Index before = static_cast<Index>(to.unknown.size());
  to.element.insert(to.element.end(), from.element.begin(), from.element.end());
  to.local.insert(to.local.end(), from.local.begin(), from.local.end());
  to.unknown.insert(to.unknown.end(), from.unknown.begin(), from.unknown.end());
  to.weight.insert(to.weight.end(), from.weight.begin(), from.weight.end());
  for (std::size_t n = 0; n < from.size(); ++n) to.begin.push_back(before + from.begin[n + 1]);
}

namespace {

/// force += (−a_k Σ W_kl a_l · x_l) over l ≠ k of each group.
void add_couplings(const PointTerms& terms, const Field& x) {
  const PointTerms t = terms;
  const Couplings c = t.couplings;
  device::for_each(
      "rockfold::solve::couplings", c.groups, KOKKOS_LAMBDA(const Index g) {
        const Index begin = c.begin(g), count = c.begin(g + 1) - begin;
        for (Index l = 0; l < count; ++l) {
          Real u[3];
          interpolate_all(t.points, c.first + begin + l, x, u);
          Real along = 0;
          for (int i = 0; i < 3; ++i) along += c.lead(begin + l, i) * u[i];
          for (Index k = 0; k < count; ++k) {
            if (k == l) continue;
            const Real by = c.value(c.matrix(g) + k * count + l) * along;
            for (int i = 0; i < 3; ++i)
              t.force(c.first + begin + k, i) -= by * c.lead(begin + k, i);
          }
        }
      });
}

}  // namespace

void apply_terms(const PointTerms& terms, const Field& x, const Field& y, Index first) {
  if (terms.points.count <= first) return;
  const PointTerms t = terms;
  const bool whole = t.whole.extent(0) > 0;
  device::for_each(
      "rockfold::solve::term_forces", t.points.count, KOKKOS_LAMBDA(const Index n) {
        Real u[3] = {0, 0, 0};
        if (n >= first) interpolate_all(t.points, n, x, u);
        for (int i = 0; i < 3; ++i) {
          Real sum = 0;
          for (int j = 0; j < 3; ++j)
            sum += (whole ? t.whole(n, 3 * i + j) : t.tangent(n, symmetric_entry(i, j))) * u[j];
          t.force(n, i) = sum;
        }
      });
  if (t.couplings.any()) add_couplings(t, x);
  scatter(terms, 1, terms.force, y);
}

void add_terms_diagonal(const PointTerms& terms, const Blocks& block, Index first) {
  if (terms.points.count <= first) return;
  const PointTerms t = terms;
  device::for_each(
      "rockfold::solve::term_diagonal", static_cast<Index>(t.row.extent(0)),
      KOKKOS_LAMBDA(const Index r) {
        for (Index i = t.row_begin(r); i < t.row_begin(r + 1); ++i) {
          const Real w = t.row_weight(i);
          const Index n = t.row_point(i);
          if (n < first) continue;
          for (int m = 0; m < 6; ++m) block(t.row(r), m) += w * w * t.tangent(n, m);
        }
      });
}

}  // namespace rockfold::solve
