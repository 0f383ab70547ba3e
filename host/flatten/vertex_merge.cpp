#include "host/flatten/vertex_merge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/cut/patch.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Cells far larger than the error of any position, far smaller than any distance worth modelling.
constexpr Real relative_cell = 1e-8;
constexpr std::size_t leaf_size = 8;

std::uint64_t cell_key(std::int64_t i, std::int64_t j, std::int64_t k) {
  auto h = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29)) + static_cast<std::uint64_t>(j) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 32)) + static_cast<std::uint64_t>(k) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

}  // namespace

VertexMerger::VertexMerger(const PlaneTable& planes)
    : planes_(planes), cell_(relative_cell * planes.model_size()) {}

bool VertexMerger::same(const Vertex& a, const Vertex& b) const {
  if (a.plane == b.plane) return true;
  IntentCount ignored;
  return std::all_of(b.plane.begin(), b.plane.end(),
                     [&](Index p) { return planes_.side(a, p, ignored) == 0; });
}

Index VertexMerger::add(const Vertex& vertex) {
  // The point's cell and its nearest neighbours: eight cells hold all points within half a cell.
  std::int64_t low[3];
  for (int d = 0; d < 3; ++d)
    low[d] = static_cast<std::int64_t>(std::floor(vertex.x[d] / cell_ - 0.5));
  for (int c = 0; c < 8; ++c) {
    const auto [first, last] = by_cell_.equal_range(
        cell_key(low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2 & 1)));
    for (auto it = first; it != last; ++it)
      if (norm(vertices_[it->second].x - vertex.x) < cell_ && same(vertices_[it->second], vertex))
        return it->second;
  }
  const auto id = static_cast<Index>(vertices_.size());
  vertices_.push_back(vertex);
  const auto own = [&](int d) {
    return static_cast<std::int64_t>(std::floor(vertex.x[d] / cell_));
  };
  by_cell_.emplace(cell_key(own(0), own(1), own(2)), id);
  return id;
}

VertexFinder::VertexFinder(const PlaneTable& planes, const std::vector<Vertex>& vertices)
    : planes_(planes), vertices_(vertices), order_(vertices.size()), axis_(vertices.size(), 0) {
  std::iota(order_.begin(), order_.end(), 0);
  build(0, order_.size());
}

void VertexFinder::build(std::size_t begin, std::size_t end) {
  if (end - begin <= leaf_size) return;
  Box box;
  for (std::size_t i = begin; i < end; ++i) box.add(vertices_[order_[i]].x);
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (box.high[d] - box.low[d] > box.high[axis] - box.low[axis]) axis = d;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) {
    return std::pair{vertices_[a].x[axis], a} < std::pair{vertices_[b].x[axis], b};
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
  const Real split = vertices_[order_[middle]].x[d], slack = planes_.tolerance();
  const Real step = line.e[d], start = line.a[d] + from * step, stop = line.a[d] + to * step;
  // Where the line leaves the one half and enters the other.
  const auto cut = [&](Real at) { return std::clamp((at - line.a[d]) / step, from, to); };
  if (std::min(start, stop) <= split + slack) {
    Real first = from, last = to;
    if (start > split + slack) first = cut(split + slack);
    if (stop > split + slack) last = cut(split + slack);
    visit(begin, middle, line, first, last, found);
  }
  if (std::max(start, stop) >= split - slack) {
    Real first = from, last = to;
    if (start < split - slack) first = cut(split - slack);
    if (stop < split - slack) last = cut(split - slack);
    visit(middle + 1, end, line, first, last, found);
  }
}

std::vector<Index> VertexFinder::between(Index from, Index to, Index p, Index q) const {
  const Vec3& a = vertices_[from].x;
  const Vec3 e = vertices_[to].x - a;
  const Real length2 = dot(e, e);
  std::vector<std::pair<Real, Index>> on;
  IntentCount ignored;
  visit(0, order_.size(), {a, e}, 0, 1, [&](Index v) {
    if (v == from || v == to) return;
    const Vec3 r = vertices_[v].x - a;
    const Real t = dot(r, e) / length2;
    if (!(t > 0 && t < 1) || norm(r - t * e) > 100 * planes_.tolerance()) return;
    if (planes_.side(vertices_[v], p, ignored) == 0 && planes_.side(vertices_[v], q, ignored) == 0)
      on.emplace_back(t, v);
  });
  std::sort(on.begin(), on.end());
  std::vector<Index> ids;
  for (const auto& [t, v] : on) ids.push_back(v);
  return ids;
}

}  // namespace rockfold
