#include "host/flatten/near_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "host/cut/cells/patch.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr std::size_t leaf_size = 8;

std::uint64_t cell_key(std::int64_t i, std::int64_t j, std::int64_t k) {
  auto h = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(j) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 32)) + static_cast<std::uint64_t>(k) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

}  // namespace

Index VertexMerger::add(const Vec3& x) {
  // The point's cell and its nearest neighbours: eight cells hold all points within half a cell.
  const Real cell = 2 * tolerance_;
  std::int64_t low[3];
  for (int d = 0; d < 3; ++d) low[d] = static_cast<std::int64_t>(std::floor(x[d] / cell - 0.5));
  Index nearest = none;
  Real least = tolerance_;
  for (int c = 0; c < 8; ++c) {
    const auto [first, last] = by_cell_.equal_range(
        cell_key(low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2 & 1)));
    for (auto it = first; it != last; ++it)
      if (const Real d = norm(vertices_[it->second] - x); d < least)
        nearest = it->second, least = d;
  }
  if (nearest != none) return nearest;
  const auto id = static_cast<Index>(vertices_.size());
  vertices_.push_back(x);
  const auto own = [&](int d) { return static_cast<std::int64_t>(std::floor(x[d] / cell)); };
  by_cell_.emplace(cell_key(own(0), own(1), own(2)), id);
  return id;
}

VertexFinder::VertexFinder(const std::vector<Vec3>& vertices, Real tolerance)
    : vertices_(vertices),
      tolerance_(tolerance),
      order_(vertices.size()),
      axis_(vertices.size(), 0) {
  std::iota(order_.begin(), order_.end(), 0);
  build(0, order_.size());
}

void VertexFinder::build(std::size_t begin, std::size_t end) {
  if (end - begin <= leaf_size) return;
  Box box;
  for (std::size_t i = begin; i < end; ++i) box.add(vertices_[order_[i]]);
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (box.high[d] - box.low[d] > box.high[axis] - box.low[axis]) axis = d;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) {
    return std::pair{vertices_[a][axis], a} < std::pair{vertices_[b][axis], b};
  });
  axis_[middle] = static_cast<std::uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

// Visits what may lie near the part of the line a + t·e with t in [from, to].
template <class Visit>
void VertexFinder::visit(std::size_t begin, std::size_t end, const Line& line, Real from, Real to,
                         const Visit& found) const {
  if (end - begin <= leaf_size) {
    for (std::size_t i = begin; i < end; ++i) found(order_[i]);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  found(order_[middle]);
  const int d = axis_[middle];
  const Real split = vertices_[order_[middle]][d];
  const Real step = line.e[d], start = line.a[d] + from * step, stop = line.a[d] + to * step;
  // Where the line leaves the one half and enters the other.
  const auto cut = [&](Real at) { return std::clamp((at - line.a[d]) / step, from, to); };
  if (std::min(start, stop) <= split + tolerance_) {
    Real first = from, last = to;
    if (start > split + tolerance_) first = cut(split + tolerance_);
    if (stop > split + tolerance_) last = cut(split + tolerance_);
    visit(begin, middle, line, first, last, found);
  }
  if (std::max(start, stop) >= split - tolerance_) {
    Real first = from, last = to;
    if (start < split - tolerance_) first = cut(split - tolerance_);
    if (stop < split - tolerance_) last = cut(split - tolerance_);
    visit(middle + 1, end, line, first, last, found);
  }
}

std::vector<Index> VertexFinder::between(Index from, Index to) const {
  const Vec3& a = vertices_[from];
  const Vec3 e = vertices_[to] - a;
  const Real length2 = dot(e, e);
  std::vector<std::pair<Real, Index>> on;
  visit(0, order_.size(), {a, e}, 0, 1, [&](Index v) {
    if (v == from || v == to) return;
    const Vec3 r = vertices_[v] - a;
    const Real t = dot(r, e) / length2;
    if (t > 0 && t < 1 && norm(r - t * e) < tolerance_) on.emplace_back(t, v);
  });
  std::sort(on.begin(), on.end());
  std::vector<Index> ids;
  for (const auto& [t, v] : on) ids.push_back(v);
  return ids;
}

}  // namespace rockfold
