#include "host/flatten/vertex_merge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Cells far larger than the error of any position, far smaller than any distance worth modelling.
constexpr Real relative_cell = 1e-8;

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
    : planes_(planes), vertices_(vertices) {
  for (int d = 0; d < 3; ++d) {
    along_[d].resize(vertices.size());
    std::iota(along_[d].begin(), along_[d].end(), 0);
    std::sort(along_[d].begin(), along_[d].end(), [&](Index a, Index b) {
      return vertices[a].x[d] != vertices[b].x[d] ? vertices[a].x[d] < vertices[b].x[d] : a < b;
    });
  }
}

std::vector<Index> VertexFinder::between(Index from, Index to, Index p, Index q) const {
  const Vec3 &a = vertices_[from].x, &b = vertices_[to].x;
  const Real slack = planes_.tolerance();
  const Index *first = nullptr, *last = nullptr;
  for (int d = 0; d < 3; ++d) {
    const auto value = [&](Index v) { return vertices_[v].x[d]; };
    const auto lo = std::partition_point(along_[d].begin(), along_[d].end(), [&](Index v) {
      return value(v) < std::min(a[d], b[d]) - slack;
    });
    const auto hi = std::partition_point(
        lo, along_[d].end(), [&](Index v) { return value(v) <= std::max(a[d], b[d]) + slack; });
    if (first == nullptr || hi - lo < last - first) {
      first = along_[d].data() + (lo - along_[d].begin());
      last = along_[d].data() + (hi - along_[d].begin());
    }
  }
  const Vec3 e = b - a;
  const Real length2 = dot(e, e);
  std::vector<std::pair<Real, Index>> on;
  IntentCount ignored;
  for (; first != last; ++first) {
    const Index v = *first;
    if (v == from || v == to) continue;
    const Vec3 r = vertices_[v].x - a;
    const Real t = dot(r, e) / length2;
    if (!(t > 0 && t < 1) || norm(r - t * e) > 100 * slack) continue;
    if (planes_.side(vertices_[v], p, ignored) == 0 && planes_.side(vertices_[v], q, ignored) == 0)
      on.emplace_back(t, v);
  }
  std::sort(on.begin(), on.end());
  std::vector<Index> ids;
  for (const auto& [t, v] : on) ids.push_back(v);
  return ids;
}

}  // namespace rockfold
