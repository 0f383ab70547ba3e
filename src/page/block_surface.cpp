#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>

#include "src/base/vector.hpp"
#include "src/io/result_reader.hpp"
#include "src/page/page_surface.hpp"

namespace rockfold {

namespace {

using hdf5::File;

/// Cosine of 20°: polygons of one face (of the ground, a mesh, a tunnel's wall) that meet at less have no edge between them.
constexpr Real smooth = 0.94;
constexpr int joint_kind = 0;  // FaceOrigin::Kind::joint

/// The polygons of all blocks, in the order of the blocks.
struct Polygons {
  std::vector<Index> begin, vertex;  // [Q+1], [C]
  std::vector<Index> block, origin;  // [Q] from 0
  std::vector<Vec3> point;           // [V]
};

Polygons read_polygons(const File& file, std::size_t origins) {
  const std::string grid = "/VTKHDF/Blocks/";
  Polygons all;
  all.point = read_points(file, grid + "Points");
  all.vertex = read_indices(file, grid + "Polygons/Connectivity", 0, all.point.size());
  all.begin = read_begins(file, grid + "Polygons/Offsets", all.vertex.size());
  all.block = read_indices(file, grid + "CellData/block", 1, std::numeric_limits<Index>::max());
  all.origin = read_indices(file, grid + "CellData/origin", 0, origins + 1);
  if (all.block.size() + 1 != all.begin.size() || all.origin.size() != all.block.size())
    throw std::out_of_range(grid);
  for (Index& b : all.block) --b;
  for (Index& o : all.origin) --o;
  return all;
}

/// Newell's normal, unit.
Vec3 normal_of(const Polygons& all, Index polygon) {
  Vec3 sum{};
  const Index first = all.begin[polygon], count = all.begin[polygon + 1] - first;
  for (Index c = 0; c < count; ++c) {
    const Vec3& a = all.point[all.vertex[first + c]];
    const Vec3& b = all.point[all.vertex[first + (c + 1) % count]];
    sum += cross(a - all.point[all.vertex[first]], b - all.point[all.vertex[first]]);
  }
  const Real length = norm(sum);
  return length > 0 ? (1 / length) * sum : sum;
}

/// A side of a polygon: its ends in ascending order, and where it stands.
struct Side {
  Index low, high, corner, polygon;
  bool same_ends(const Side& other) const { return low == other.low && high == other.high; }
};

/// Marks the sides of polygons `from` to `to` (of one block) that are edges of the block: all but those between two
/// polygons of one face that meet smoothly.
void mark_edges(const Polygons& all, Index from, Index to, std::vector<std::uint8_t>& edge) {
  std::vector<Side> sides;
  for (Index p = from; p < to; ++p)
    for (Index c = all.begin[p]; c < all.begin[p + 1]; ++c) {
      const Index next = c + 1 < all.begin[p + 1] ? c + 1 : all.begin[p];
      const auto [low, high] = std::minmax(all.vertex[c], all.vertex[next]);
      sides.push_back({low, high, c, p});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high);
  });
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[i + 1];
    const bool pair = a.same_ends(b) && all.origin[a.polygon] == all.origin[b.polygon];
    if (pair && dot(normal_of(all, a.polygon), normal_of(all, b.polygon)) > smooth)
      edge[a.corner] = edge[b.corner] = 0;
  }
}

/// Whether any face of the block is a boundary of the rock or of an excavation.
bool is_seen(const Polygons& all, Index from, Index to, const std::vector<std::int64_t>& kind) {
  for (Index p = from; p < to; ++p)
    if (all.origin[p] < 0 || kind[all.origin[p]] != joint_kind) return true;
  return false;
}

void add_block(const Polygons& all, Index from, Index to, const std::vector<std::uint8_t>& edge,
               PageSurface& out) {
  std::map<Index, std::uint32_t> local;
  for (Index p = from; p < to; ++p) {
    const Index count = all.begin[p + 1] - all.begin[p];
    out.corner_count.push_back(static_cast<std::uint32_t>(count));
    out.origin.push_back(static_cast<std::uint32_t>(std::max<Index>(0, all.origin[p])));
    for (Index c = all.begin[p]; c < all.begin[p + 1]; ++c) {
      const Index v = all.vertex[c];
      const auto [met, is_new] = local.try_emplace(v, static_cast<std::uint32_t>(local.size()));
      if (is_new) {
        out.point_row.push_back(v);
        out.point.push_back(all.point[v]);
      }
      out.corner_point.push_back(met->second);
      out.corner_edge.push_back(edge[c]);
    }
  }
  out.block.push_back(all.block[from]);
  out.point_begin.push_back(static_cast<Index>(out.point.size()));
  out.polygon_begin.push_back(static_cast<Index>(out.corner_count.size()));
}

}  // namespace

PageSurface block_surface(const File& file, bool seen_only) {
  PageSurface out;
  out.grid = "Blocks";
  out.point_begin = out.polygon_begin = {0};
  if (!file.exists("/VTKHDF/Blocks")) return out;
  const std::vector<std::int64_t> kind = file.read_integers("/rockfold/origins/kind");
  const Polygons all = read_polygons(file, kind.size());
  std::vector<std::uint8_t> edge(all.vertex.size(), 1);
  const auto count = static_cast<Index>(all.block.size());
  for (Index from = 0, to = 0; from < count; from = to) {
    while (to < count && all.block[to] == all.block[from]) ++to;
    if (seen_only && !is_seen(all, from, to, kind)) continue;
    mark_edges(all, from, to, edge);
    add_block(all, from, to, edge, out);
  }
  return out;
}

}  // namespace rockfold
