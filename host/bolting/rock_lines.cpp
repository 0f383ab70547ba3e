#include "host/bolting/rock_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Real parallel = 1e-12;  // sine of the angle between line and face
constexpr Real aside = 1e-7;      // of the model's size
constexpr std::array<Real, 2> odd{0.842, 0.539};
constexpr int attempts = 4;

constexpr Real infinite = std::numeric_limits<Real>::infinity();

/// Whether a point of the face's plane lies in its polygon: even-odd over all loops, seen along the axis nearest the
/// normal.
bool holds(const BlockArrays& blocks, Index face, const Vec3& point) {
  const Vec3& n = blocks.face_normal[face];
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (std::abs(n[d]) > std::abs(n[axis])) axis = d;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  bool inside = false;
  for (Index loop = blocks.loop_begin[face]; loop < blocks.loop_begin[face + 1]; ++loop) {
    const Index first = blocks.corner_begin[loop], end = blocks.corner_begin[loop + 1];
    for (Index c = first, before = end - 1; c < end; before = c++) {
      const Vec3& p = blocks.vertex[blocks.corner_vertex[c]];
      const Vec3& q = blocks.vertex[blocks.corner_vertex[before]];
      if ((p[b] > point[b]) == (q[b] > point[b])) continue;
      if (point[a] < p[a] + (point[b] - p[b]) / (q[b] - p[b]) * (q[a] - p[a])) inside = !inside;
    }
  }
  return inside;
}

/// A little larger than the block, so that no line beside it is missed.
Bounds bounds_of(const BlockArrays& blocks, Index block, Real margin) {
  Bounds box{{infinite, infinite, infinite}, {-infinite, -infinite, -infinite}};
  for (Index v = blocks.vertex_begin[block]; v < blocks.vertex_begin[block + 1]; ++v)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = std::min(box.min[d], blocks.vertex[v][d]);
      box.max[d] = std::max(box.max[d], blocks.vertex[v][d]);
    }
  for (int d = 0; d < 3; ++d) box.min[d] -= margin, box.max[d] += margin;
  return box;
}

}  // namespace

std::optional<Real> line_meets_face(const BlockArrays& blocks, Index face, const Vec3& from,
                                    const Vec3& direction) {
  const Vec3& n = blocks.face_normal[face];
  const Real slope = dot(n, direction);
  if (std::abs(slope) <= parallel) return {};
  const Real t = way_to_plane(blocks, face, from, direction);
  if (!holds(blocks, face, from + t * direction)) return {};
  return t;
}

Real way_to_plane(const BlockArrays& blocks, Index face, const Vec3& from, const Vec3& direction) {
  const Vec3& n = blocks.face_normal[face];
  const Vec3& corner =
      blocks.vertex[blocks.corner_vertex[blocks.corner_begin[blocks.loop_begin[face]]]];
  return dot(n, corner - from) / dot(n, direction);
}

Real model_size(const BlockArrays& blocks) {
  Real size = 0;
  for (int d = 0; d < 3; ++d) {
    Real low = infinite, high = -infinite;
    for (const Vec3& v : blocks.vertex) low = std::min(low, v[d]), high = std::max(high, v[d]);
    size = std::max(size, high - low);
  }
  return size;
}

RockLines::RockLines(const BlockArrays& blocks, const Vec3& down)
    : blocks_(blocks), down_(normalized(down)), size_(model_size(blocks)) {
  std::vector<Bounds> boxes;
  boxes.reserve(static_cast<std::size_t>(blocks.block_count()));
  Real volume = 0;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    boxes.push_back(bounds_of(blocks, b, 2 * attempts * aside * size_));
    volume += blocks.volume[b];
    centre_ += blocks.volume[b] * blocks.centroid[b];
  }
  if (volume > 0) centre_ = (1 / volume) * centre_;
  tree_ = BoxTree(std::move(boxes));
}

/// Across a line, in a sense that turns and moves with the model: level and up, of a line along gravity towards and beside the
/// middle of the rock, and only there towards an axis.
Vec3 RockLines::sideways(const Vec3& start, const Vec3& direction) const {
  constexpr Real least = 1e-6;
  Vec3 level = rockfold::cross(direction, down_);
  if (norm(level) < least) level = (1 / size_) * rockfold::cross(direction, centre_ - start);
  if (norm(level) < least) level = rockfold::cross(direction, Vec3{1, 0, 0});
  if (norm(level) < least) level = rockfold::cross(direction, Vec3{0, 1, 0});
  level = normalized(level);
  return odd[0] * level + odd[1] * rockfold::cross(direction, level);
}

/// False where the line touches an edge: entering and leaving do not alternate.
bool RockLines::cross(Index block, const Line& line, std::vector<RockSegment>& segments) const {
  std::vector<std::pair<Real, Index>> crossings;
  for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f)
    if (const auto t = line_meets_face(blocks_, f, line.beside, line.direction))
      crossings.emplace_back(*t, f);
  std::sort(crossings.begin(), crossings.end());
  if (crossings.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < crossings.size(); i += 2) {
    const Index entry = crossings[i].second, exit = crossings[i + 1].second;
    if (dot(blocks_.face_normal[entry], line.direction) > 0 ||
        dot(blocks_.face_normal[exit], line.direction) < 0)
      return false;
    const Real in = way_to_plane(blocks_, entry, line.start, line.direction);
    const Real out = way_to_plane(blocks_, exit, line.start, line.direction);
    const Real from = in > 0 ? in : 0, to = std::min(out, line.length);
    if (to - from > 1e-9 * size_)
      segments.push_back({block, from, to, out <= line.length ? exit : none, from - in});
  }
  return true;
}

std::vector<RockSegment> RockLines::along(const Vec3& start, const Vec3& direction,
                                          Real length) const {
  const Vec3 aside_direction = sideways(start, direction);
  const std::vector<Index> near = tree_.along(start, direction, 0, length);
  std::vector<RockSegment> segments;
  for (const Index block : near) {
    for (int attempt = 1; attempt <= attempts; ++attempt) {
      const std::size_t before = segments.size();
      const Vec3 beside = start + (attempt * aside * size_) * aside_direction;
      if (cross(block, {start, beside, direction, length}, segments)) break;
      segments.resize(before);
    }
  }
  std::sort(segments.begin(), segments.end(), [](const RockSegment& a, const RockSegment& b) {
    return a.from != b.from ? a.from < b.from : a.block < b.block;
  });
  return segments;
}

}  // namespace rockfold
