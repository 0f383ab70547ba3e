#include <algorithm>
#include <utility>

#include "kernels/precondition/levels/contact_levels_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Rows of covers on the host: where blocks stand.
struct Pattern {
  std::vector<Index> begin{0}, column;

  Index covers() const { return static_cast<Index>(begin.size()) - 1; }
};

/// The columns of one row after the other, each once.
class PatternMaker {
 public:
  explicit PatternMaker(Index covers) : seen_by_(covers, none) {}
  void add(Index column) {
    const Index row = pattern_.covers();
    if (seen_by_[column] == row) return;
    seen_by_[column] = row;
    pattern_.column.push_back(column);
  }
  void end_row() {
    std::sort(pattern_.column.begin() + pattern_.begin.back(), pattern_.column.end());
    pattern_.begin.push_back(static_cast<Index>(pattern_.column.size()));
  }
  Pattern take() { return std::move(pattern_); }

 private:
  std::vector<Index> seen_by_;
  Pattern pattern_;
};

/// Of points, which act on functions 0 of all covers that they act on.
Pattern pattern_of_points(const PointTerms& terms, Index covers) {
  const std::vector<Index> begin = device::to_host(terms.points.begin),
                           unknown = device::to_host(terms.points.unknown),
                           row = device::to_host(terms.row),
                           row_begin = device::to_host(terms.row_begin),
                           row_point = device::to_host(terms.row_point);
  // The first of consecutive points that act on the same unknowns: those of one pair of elements mostly do.
  std::vector<Index> like(terms.points.count);
  for (Index n = 0; n < terms.points.count; ++n) {
    const auto at = [&](Index m) { return unknown.begin() + begin[m]; };
    like[n] = n > 0 && std::equal(at(n - 1), at(n), at(n), at(n + 1)) ? like[n - 1] : n;
  }
  PatternMaker maker(covers);
  std::size_t t = 0;
  for (Index p = 0; p < covers; ++p, maker.end_row()) {
    while (t < row.size() && row[t] < p) ++t;
    if (t == row.size() || row[t] != p) continue;
    Index before = none;
    for (Index i = row_begin[t]; i < row_begin[t + 1]; ++i) {
      const Index n = row_point[i];
      if (like[n] == before) continue;
      before = like[n];
      for (Index j = begin[n]; j < begin[n + 1]; ++j) maker.add(unknown[j] % covers);
    }
  }
  return maker.take();
}

/// Of Pᵀ A P.
Pattern pattern_of_product(const Pattern& fine, const Parents& p) {
  std::vector<std::vector<Index>> children(p.coarse);
  for (Index i = 0; i < fine.covers(); ++i)
    if (fine.begin[i] < fine.begin[i + 1])
      for (Index k = p.begin[i]; k < p.begin[i + 1]; ++k) children[p.parent[k]].push_back(i);
  PatternMaker maker(p.coarse);
  for (const std::vector<Index>& of_row : children) {
    for (const Index i : of_row)
      for (Index m = fine.begin[i]; m < fine.begin[i + 1]; ++m)
        for (Index k = p.begin[fine.column[m]]; k < p.begin[fine.column[m] + 1]; ++k)
          maker.add(p.parent[k]);
    maker.end_row();
  }
  return maker.take();
}

void set_pattern(ContactRows& to, const Pattern& pattern, int functions) {
  std::vector<Index> row;
  for (Index p = 0; p < pattern.covers(); ++p)
    if (pattern.begin[p] < pattern.begin[p + 1]) row.push_back(p);
  to.row = device::to_device("solve::contact_row", row);
  to.a.covers = pattern.covers();
  to.a.functions = functions;
  to.a.begin = device::to_device("solve::contact_begin", pattern.begin);
  to.a.column = device::to_device("solve::contact_column", pattern.column);
  device::grow(to.a.value, "solve::contact_value",
               pattern.column.size() * to.a.width() * to.a.width());
}

}  // namespace

void find_rows(ContactLevels& contacts, const PointTerms& terms, Index covers, int functions,
               const std::vector<Parents>& parents) {
  contacts.level.resize(parents.size() + 1);
  contacts.found = true;
  if (!terms.any()) {
    contacts.level.assign(parents.size() + 1, {});
    return;
  }
  Pattern pattern = pattern_of_points(terms, covers);
  set_pattern(contacts.level[0], pattern, functions);
  for (std::size_t l = 0; l < parents.size(); ++l) {
    pattern = pattern_of_product(pattern, parents[l]);
    set_pattern(contacts.level[l + 1], pattern, functions);
  }
}

void sum_points(const ContactRows& contacts, const PointTerms& terms, Real scale) {
  const CoverMatrix a = contacts.a;
  const Array<Index> cover = contacts.row;
  const PointTerms s = terms;
  const int width = a.width(), size = width * width;
  device::for_each(
      "rockfold::solve::sum_points", static_cast<Index>(cover.extent(0)),
      KOKKOS_LAMBDA(const Index c) {
        const Index p = cover(c);
        for (std::size_t e = static_cast<std::size_t>(a.begin(p)) * size;
             e < static_cast<std::size_t>(a.begin(p + 1)) * size; ++e)
          a.value(e) = 0;
        for (int k = 0; k < a.functions; ++k) {
          const Index t = find_row(s.row, k * a.covers + p);
          if (t == none) continue;
          for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i) {
            const Index n = s.row_point(i);
            for (Index j = s.points.begin(n); j < s.points.begin(n + 1); ++j) {
              const int l = s.points.unknown(j) / a.covers;
              const Real w = scale * s.row_weight(i) * s.points.weight(j);
              Real* to = find_block(a, p, s.points.unknown(j) % a.covers) + 3 * l * width + 3 * k;
              for (int d = 0; d < 3; ++d)
                for (int e = 0; e < 3; ++e)
                  to[e * width + d] += w * s.tangent(n, symmetric_entry(d, e));
            }
          }
        }
      },
      64);
}

void add_diagonal(const ContactRows& contacts, const Blocks& d) {
  const ContactRows c = contacts;
  device::for_each(
      "rockfold::solve::contact_diagonal", static_cast<Index>(c.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) {
        const Index p = c.row(t);
        const int at[6] = {0, 4, 8, 1, 5, 2};
        const Real* own = find_block(c.a, p, p);
        for (int m = 0; m < 6; ++m) d(p, m) += own[at[m]];
      });
}

}  // namespace rockfold::solve
