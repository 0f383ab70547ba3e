#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "kernels/constraints/elimination_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Of a row of unit length, what is left once others are taken off it: less, and it all but depends on them …
constexpr Real nearly_dependent = 1e-2;
/// … and less than that is rounding.
constexpr Real dependent = 1e-12;
/// Where all that a cover holds is a speck far from its node, or a strip narrow beside the spacing, its functions are known to a few digits.
constexpr Real least_motion_ratio = 1e-3;
/// Of what points of a cover prescribe: what differs less is the same.
constexpr Real rounding = 1e-9;

/// A row over the functions of a cover, and the points that it is made of.
struct Row {
  std::vector<Real> value;       ///< [functions]
  std::map<Index, Real> factor;  ///< [point]

  Real length() const {
    Real sum = 0;
    for (const Real v : value) sum += v * v;
    return std::sqrt(sum);
  }
  void add(Real times, const Row& other) {
    for (std::size_t k = 0; k < value.size(); ++k) value[k] += times * other.value[k];
    for (const auto& [n, f] : other.factor) factor[n] += times * f;
  }
};

Real product(const Row& a, const Row& b) {
  Real sum = 0;
  for (std::size_t k = 0; k < a.value.size(); ++k) sum += a.value[k] * b.value[k];
  return sum;
}

/// The cover to which all unknowns of a point belong, or none.
Index only_cover(const MaterialPoints& points, std::size_t n, Index covers) {
  Index cover = none;
  for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
    if (points.weight[i] == 0) continue;
    const Index p = points.unknown[i] % covers;
    if (cover != none && p != cover) return none;
    cover = p;
  }
  return cover;
}

Row row_of(const MaterialPoints& points, std::size_t n, Index covers, int functions) {
  Row row{std::vector<Real>(functions, 0), {{static_cast<Index>(n), 1}}};
  for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
    row.value[points.unknown[i] / covers] += points.weight[i];
  return row;
}

/// Whether what a row that depends on others prescribes follows from what they do, at all times.
bool is_consistent(const Row& nothing, const FixedPoints& fixed, int d) {
  Real sum = 0, size = 0;
  std::map<Index, Real> of_table;
  for (const auto& [n, f] : nothing.factor) {
    const Index table = fixed.table.empty() ? none : fixed.table[n];
    if (table != none) {
      of_table[table] += f;
      continue;
    }
    sum += f * fixed.value[n][d];
    size = std::max(size, std::abs(f * fixed.value[n][d]));
  }
  return std::abs(sum) <= rounding * size &&
         std::all_of(of_table.begin(), of_table.end(),
                     [](const auto& t) { return std::abs(t.second) <= rounding; });
}

/// The rows of a cover and a component.
struct ConstrainedCover {
  std::vector<Row> row;  ///< of unit length; once `orthonormal` is done, an orthonormal set
  std::vector<Index> point;
  bool sound = true;  ///< their points can all be kept

  void take_in(Row next) {
    point.push_back(next.factor.begin()->first);
    Row unit{std::vector<Real>(next.value.size(), 0), {}};
    unit.add(1 / next.length(), next);
    row.push_back(std::move(unit));
  }

  /// By Gram & Schmidt, twice, those first that say most beyond the ones before. Of what differs least from them, each has to follow.
  void make_orthonormal(const FixedPoints& fixed, int d) {
    std::vector<Row> left = std::move(row);
    row.clear();
    while (!left.empty() && sound) {
      const auto most = std::max_element(left.begin(), left.end(), [](const Row& a, const Row& b) {
        return a.length() < b.length();
      });
      const Real length = most->length();
      if (length <= nearly_dependent) {
        sound = length <= dependent &&
                std::all_of(left.begin(), left.end(),
                            [&](const Row& nothing) { return is_consistent(nothing, fixed, d); });
        return;
      }
      Row next = std::move(*most);
      left.erase(most);
      for (const Row& known : row) next.add(-product(known, next), known);
      Row unit{std::vector<Real>(next.value.size(), 0), {}};
      unit.add(1 / next.length(), next);
      for (Row& other : left) other.add(-product(unit, other), unit);
      row.push_back(std::move(unit));
    }
  }
};

}  // namespace

EliminationOfPoints eliminate(const FixedPoints& fixed, Index covers, int functions) {
  EliminationOfPoints result;
  result.eliminated.resize(fixed.points.size());
  std::map<std::pair<Index, Index>, ConstrainedCover> held;  // by cover and component
  for (std::size_t n = 0; n < fixed.points.size(); ++n) {
    if (fixed.enforce[n] == Enforce::penalty) continue;
    const Index p = only_cover(fixed.points, n, covers);
    if (p == none) continue;
    const bool narrow = !fixed.motion_ratio.empty() && fixed.motion_ratio[n] < least_motion_ratio;
    for (int d = 0; d < 3; ++d) {
      if (!fixed.component[n][d]) continue;
      ConstrainedCover& cover = held[{p, d}];
      cover.take_in(row_of(fixed.points, n, covers, functions));
      cover.sound = cover.sound && !narrow;
    }
  }
  std::vector<Index> cover, component, begin{0}, source_begin{0}, source;
  std::vector<Real> value, factor;
  for (auto& [at, of_cover] : held) {
    of_cover.make_orthonormal(fixed, at.second);
    if (!of_cover.sound) continue;
    for (const Index n : of_cover.point) result.eliminated[n][at.second] = 1;
    const std::vector<Row>& rows = of_cover.row;
    cover.push_back(at.first);
    component.push_back(at.second);
    for (const Row& row : rows) {
      value.insert(value.end(), row.value.begin(), row.value.end());
      for (const auto& [n, f] : row.factor) {
        source.push_back(n);
        factor.push_back(f);
      }
      source_begin.push_back(static_cast<Index>(source.size()));
    }
    begin.push_back(begin.back() + static_cast<Index>(rows.size()));
  }
  using device::to_device;
  result.elimination = {covers,
                        functions,
                        to_device("solve::eliminated_cover", cover),
                        to_device("solve::eliminated_component", component),
                        to_device("solve::eliminated_begin", begin),
                        to_device("solve::eliminated_row", value),
                        to_device("solve::eliminated_source_begin", source_begin),
                        to_device("solve::eliminated_source", source),
                        to_device("solve::eliminated_factor", factor)};
  return result;
}

namespace {

/// C v of a row.
KOKKOS_INLINE_FUNCTION Real along(const Elimination& e, Index i, Index p, Index d, const Field& v) {
  Real sum = 0;
  for (int k = 0; k < e.functions; ++k) sum += e.row(i * e.functions + k) * v(k * e.covers + p, d);
  return sum;
}

KOKKOS_INLINE_FUNCTION void add_row(const Elimination& e, Index i, Index p, Index d, Real times,
                                    const Field& v) {
  for (int k = 0; k < e.functions; ++k)
    v(k * e.covers + p, d) += times * e.row(i * e.functions + k);
}

}  // namespace

void project(const Elimination& elimination, const Field& v) {
  if (!elimination.any()) return;
  const Elimination e = elimination;
  device::for_each(
      "rockfold::solve::project", e.count(), KOKKOS_LAMBDA(const Index h) {
        const Index p = e.cover(h), d = e.component(h);
        for (Index i = e.begin(h); i < e.begin(h + 1); ++i)
          add_row(e, i, p, d, -along(e, i, p, d, v), v);
      });
}

namespace {

/// Row i of C, of a component of a cover.
struct HostRow {
  int component = 0;
  std::vector<Real> value;  ///< [functions]
};

std::vector<std::vector<HostRow>> rows_of_covers(const Elimination& e) {
  const std::vector<Index> cover = device::to_host(e.cover),
                           component = device::to_host(e.component),
                           begin = device::to_host(e.begin);
  const std::vector<Real> row = device::to_host(e.row);
  std::vector<std::vector<HostRow>> rows(e.covers);
  for (std::size_t h = 0; h < cover.size(); ++h)
    for (Index i = begin[h]; i < begin[h + 1]; ++i) {
      const auto first = row.begin() + static_cast<std::ptrdiff_t>(i) * e.functions;
      rows[cover[h]].push_back({static_cast<int>(component[h]), {first, first + e.functions}});
    }
  return rows;
}

/// v ← v − c (c·v) of a column of a block (stride 1), or of a row of it (stride: its width).
void take_off(const HostRow& c, Real* v, std::size_t stride) {
  Real sum = 0;
  for (std::size_t k = 0; k < c.value.size(); ++k)
    sum += c.value[k] * v[(3 * k + c.component) * stride];
  for (std::size_t k = 0; k < c.value.size(); ++k)
    v[(3 * k + c.component) * stride] -= sum * c.value[k];
}

}  // namespace

void constrain(const Elimination& e, BlockMatrix& a) {
  if (!e.any()) return;
  const auto rows = rows_of_covers(e);
  const std::size_t width = a.width, size = width * width;
  for (Index i = 0; i < a.rows(); ++i)
    for (Index m = a.begin[i]; m < a.begin[i + 1]; ++m) {
      Real* block = &a.value[m * size];
      std::array<Real, 3> largest{};
      for (std::size_t k = 0; k < width; ++k)
        largest[k % 3] = std::max(largest[k % 3], block[k * width + k]);
      for (const HostRow& c : rows[i])
        for (std::size_t column = 0; column < width; ++column)
          take_off(c, block + column * width, 1);
      for (const HostRow& c : rows[a.column[m]])
        for (std::size_t row = 0; row < width; ++row) take_off(c, block + row, width);
      if (a.column[m] != i) continue;
      for (const HostRow& c : rows[i])
        for (std::size_t k = 0; k < c.value.size(); ++k)
          for (std::size_t l = 0; l < c.value.size(); ++l)
            block[(3 * l + c.component) * width + 3 * k + c.component] +=
                largest[c.component] * c.value[k] * c.value[l];
    }
}

void split(const Elimination& elimination, const Field& prescribed, const Field& x,
           const Field& part) {
  const Elimination e = elimination;
  Kokkos::deep_copy(part, 0.0);
  device::for_each(
      "rockfold::solve::split", e.count(), KOKKOS_LAMBDA(const Index h) {
        const Index p = e.cover(h), d = e.component(h);
        for (Index i = e.begin(h); i < e.begin(h + 1); ++i) {
          Real wanted = 0;
          for (Index s = e.source_begin(i); s < e.source_begin(i + 1); ++s)
            wanted += e.factor(s) * prescribed(e.source(s), d);
          add_row(e, i, p, d, -along(e, i, p, d, x), x);
          add_row(e, i, p, d, wanted, part);
        }
      });
}

void add_reactions(const Elimination& elimination, const Field& r, const Field& multiplier) {
  const Elimination e = elimination;
  device::for_each(
      "rockfold::solve::add_reactions", e.count(), KOKKOS_LAMBDA(const Index h) {
        const Index p = e.cover(h), d = e.component(h);
        for (Index i = e.begin(h); i < e.begin(h + 1); ++i) {
          const Real force = along(e, i, p, d, r);
          for (Index s = e.source_begin(i); s < e.source_begin(i + 1); ++s)
            multiplier(e.source(s), d) += e.factor(s) * force;
        }
      });
}

}  // namespace rockfold::solve
