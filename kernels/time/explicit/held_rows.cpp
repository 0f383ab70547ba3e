#include <cmath>
#include <numeric>

#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

/// Of a row's own size: what is left of one that others make up is rounding.
constexpr Real independent = 1e-8;

/// A component of a point that is held, as a row of its block's functions (index 3k + d), and what it is of the rows chosen so far.
struct Row {
  Index point = 0;
  int component = 0;
  Real resists = 0;  ///< kg, of the block against this row
  std::vector<Real> weight, left, combine;
};

/// On the host: the arrays of HeldRows.
struct Lists {
  std::vector<Index> cover, begin{0}, point, entry_begin{0}, entry_point;
  std::vector<int> component, entry_component;
  std::vector<Real> combine, row, way, share;
};

std::vector<Real> product(const std::vector<Real>& a, const std::vector<Real>& x) {
  std::vector<Real> y(x.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += a[i * x.size() + j] * x[j];
  return y;
}

Real dot(const std::vector<Real>& a, const std::vector<Real>& b) {
  Real sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// R A Rᵀ, function by function.
std::vector<Real> turned(const Real* a, const Real* r, int width) {
  std::vector<Real> half(width * width, 0), whole(width * width, 0);
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j)
      for (int k = 0; k < 3; ++k)
        half[i * width + j] += r[3 * (i % 3) + k] * a[(i / 3 * 3 + k) * width + j];
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j)
      for (int k = 0; k < 3; ++k)
        whole[i * width + j] += half[i * width + j / 3 * 3 + k] * r[3 * (j % 3) + k];
  return whole;
}

/// [rows][width] what each row takes of the impulses of those chosen, [chosen][width] C: T W (WᵀTW)⁻ Cᵀ, each as much as
/// the block resists there. (Not through W in those chosen:
/// stiff strain makes their lengths differ by many powers of ten.)
std::vector<Real> find_shares(const std::vector<Row>& rows, const std::vector<Real>& units,
                              int chosen, int width) {
  std::vector<Real> normal(width * width, 0), scale(width, 0), share(rows.size() * width, 0);
  for (const Row& row : rows)
    for (int i = 0; i < width; ++i)
      for (int j = 0; j < width; ++j)
        normal[i * width + j] += row.resists * row.weight[i] * row.weight[j];
  for (int i = 0; i < width; ++i)
    if (normal[i * width + i] > 0) scale[i] = 1 / std::sqrt(normal[i * width + i]);
  for (int i = 0; i < width; ++i)
    for (int j = 0; j < width; ++j) normal[i * width + j] *= scale[i] * scale[j];
  solve::invert_symmetric(width, normal.data());
  for (int c = 0; c < chosen; ++c) {
    std::vector<Real> load(width, 0);
    for (int i = 0; i < width; ++i)
      for (int j = 0; j < width; ++j)
        load[i] += scale[i] * scale[j] * units[c * width + j] *
                   (i <= j ? normal[i * width + j] : normal[j * width + i]);
    for (std::size_t r = 0; r < rows.size(); ++r)
      share[r * width + c] = rows[r].resists * dot(rows[r].weight, load);
  }
  return share;
}

/// Gram and Schmidt with the largest row first, in the measure of the block's inverse inertia.
void add_block(Index cover, std::vector<Row> rows, const std::vector<Real>& inverse, int width,
               Lists& to) {
  std::vector<std::vector<Real>> ways;
  std::vector<Real> first;
  for (Row& row : rows) {
    row.left = row.weight;
    row.combine.assign(width, 0);
    first.push_back(dot(row.weight, product(inverse, row.weight)));
    row.resists = first.back() > 0 ? 1 / first.back() : 0;
  }
  for (int chosen = 0; chosen < width; ++chosen) {
    std::size_t best = rows.size();
    Real most = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Real size = dot(rows[r].left, product(inverse, rows[r].left));
      if (!(size > independent * first[r]) || !(size > most)) continue;
      best = r;
      most = size;
    }
    if (best == rows.size()) break;
    Row unit = rows[best];
    unit.combine[chosen] += 1;
    const Real scale = 1 / std::sqrt(most);
    for (Real& w : unit.left) w *= scale;
    for (Real& c : unit.combine) c *= scale;
    const std::vector<Real> way = product(inverse, unit.left);
    to.point.push_back(unit.point);
    to.component.push_back(unit.component);
    to.row.insert(to.row.end(), unit.left.begin(), unit.left.end());
    to.way.insert(to.way.end(), way.begin(), way.end());
    to.combine.insert(to.combine.end(), unit.combine.begin(), unit.combine.end());
    ways.push_back(way);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Real share = dot(rows[r].left, way);
      for (int k = 0; k < width; ++k) {
        rows[r].left[k] = r == best ? 0 : rows[r].left[k] - share * unit.left[k];
        rows[r].combine[k] -= share * unit.combine[k];
      }
    }
  }
  if (ways.empty()) return;
  for (const Row& row : rows) {
    to.entry_point.push_back(row.point);
    to.entry_component.push_back(row.component);
  }
  const std::vector<Real> units(to.row.end() - static_cast<std::ptrdiff_t>(ways.size()) * width,
                                to.row.end());
  const std::vector<Real> share = find_shares(rows, units, static_cast<int>(ways.size()), width);
  to.share.insert(to.share.end(), share.begin(), share.end());
  to.cover.push_back(cover);
  to.begin.push_back(static_cast<Index>(to.point.size()));
  to.entry_begin.push_back(static_cast<Index>(to.entry_point.size()));
}

/// What each of these covers has of an array, `size` numbers, on the host.
std::vector<Real> gather(const Array<Real>& from, const std::vector<Index>& covers,
                         std::size_t size) {
  const Array<Index> cover = device::to_device("motion::gathered_cover", covers);
  const Array<Real> to("rockfold::motion::gathered", covers.size() * size);
  device::for_each(
      "rockfold::motion::gather", static_cast<Index>(covers.size()), KOKKOS_LAMBDA(const Index i) {
        for (std::size_t k = 0; k < size; ++k) to(i * size + k) = from(cover(i) * size + k);
      });
  return device::to_host(to);
}

}  // namespace

HeldRows find_held_rows(const Motion::Data& m) {
  const solve::Springs& springs = m.system.springs;
  HeldRows held;
  const int n = m.explicit_scheme.functions, width = held.width = 3 * n;
  if (!springs.any()) return held;
  const std::vector<Index> begin = device::to_host(springs.points.begin),
                           unknown = device::to_host(springs.points.unknown);
  const std::vector<Real> weight = device::to_host(springs.points.weight);
  const std::vector<Vec3> is_held = device::copy_to_host(springs.held);
  std::vector<std::vector<Row>> rows(m.covers);
  for (Index p = 0; p < springs.points.count; ++p)
    for (int d = 0; d < 3; ++d) {
      if (!(is_held[p][d] > 0) || begin[p] == begin[p + 1]) continue;
      Row row{p, d, 0, std::vector<Real>(width, 0), {}, {}};
      for (Index i = begin[p]; i < begin[p + 1]; ++i)
        row.weight[3 * (unknown[i] / m.covers) + d] += weight[i];
      rows[unknown[begin[p]] % m.covers].push_back(row);
    }
  std::vector<Index> held_covers;
  for (Index p = 0; p < m.covers; ++p)
    if (!rows[p].empty()) held_covers.push_back(p);
  const std::size_t size = static_cast<std::size_t>(width) * width;
  const std::vector<Real> slowed = gather(m.explicit_scheme.slowed, held_covers, size),
                          turn = gather(m.explicit_scheme.turn, held_covers, 9);
  Lists lists;
  std::vector<Index> of_block(m.covers + 1, 0);
  std::size_t next = 0;
  for (Index p = 0; p < m.covers; ++p) {
    of_block[p] = static_cast<Index>(lists.cover.size());
    if (rows[p].empty()) continue;
    add_block(p, std::move(rows[p]), turned(&slowed[next * size], &turn[next * 9], width), width,
              lists);
    ++next;
  }
  of_block[m.covers] = held.sets = static_cast<Index>(lists.cover.size());
  held.of_block = device::to_device("motion::held_of_block", of_block);
  held.cover = device::to_device("motion::held_cover", lists.cover);
  held.begin = device::to_device("motion::held_begin", lists.begin);
  held.point = device::to_device("motion::held_point", lists.point);
  held.component = device::to_device("motion::held_component", lists.component);
  held.combine = device::to_device("motion::held_combine", lists.combine);
  held.row = device::to_device("motion::held_row", lists.row);
  held.way = device::to_device("motion::held_way", lists.way);
  held.entry_begin = device::to_device("motion::held_entry_begin", lists.entry_begin);
  held.entry_point = device::to_device("motion::held_entry_point", lists.entry_point);
  held.entry_component = device::to_device("motion::held_entry_component", lists.entry_component);
  held.share = device::to_device("motion::held_share", lists.share);
  held.impulse = Array<Real>("rockfold::motion::held_impulse", lists.point.size());
  return held;
}

}  // namespace rockfold::motion
