// Vertices that are one point although they were made by different planes, and vertices that lie on an edge.
#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "host/exact/plane_table.hpp"

namespace rockfold {

/// Numbers vertices so that one point has one number. A hash of the rounded position finds candidates, the signs of the
/// planes decide. O(1) a vertex.
class VertexMerger {
 public:
  explicit VertexMerger(const PlaneTable& planes);
  Index add(const Vertex& vertex);
  std::vector<Vertex> take() { return std::move(vertices_); }

 private:
  bool same(const Vertex& a, const Vertex& b) const;

  const PlaneTable& planes_;
  Real cell_;  // m, edge of the hash's cells
  std::vector<Vertex> vertices_;
  std::unordered_multimap<std::uint64_t, Index> by_cell_;
};

/// Finds the vertices in the interior of an edge by their order along the axes.
class VertexFinder {
 public:
  VertexFinder(const PlaneTable& planes, const std::vector<Vertex>& vertices);

  /// The vertices strictly between `from` and `to` on the line of planes p and q, in order from `from`.
  std::vector<Index> between(Index from, Index to, Index p, Index q) const;

 private:
  const PlaneTable& planes_;
  const std::vector<Vertex>& vertices_;
  std::array<std::vector<Index>, 3> along_;  // vertices sorted by x, y, z
};

}  // namespace rockfold
