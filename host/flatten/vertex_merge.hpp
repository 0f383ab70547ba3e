// Vertices that are one point although they were made by different planes, and vertices that lie on an edge.
#pragma once

#include <cstddef>
#include <cstdint>
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

/// Finds the vertices in the interior of an edge by a tree of halves. O(log n) an edge and what is near it.
class VertexFinder {
 public:
  VertexFinder(const PlaneTable& planes, const std::vector<Vertex>& vertices);

  /// The vertices strictly between `from` and `to` on the line of planes p and q, in order from `from`.
  std::vector<Index> between(Index from, Index to, Index p, Index q) const;

 private:
  struct Line {
    Vec3 a, e;
  };
  void build(std::size_t begin, std::size_t end);
  template <class Visit>
  void visit(std::size_t begin, std::size_t end, const Line& line, Real from, Real to,
             const Visit& found) const;

  const PlaneTable& planes_;
  const std::vector<Vertex>& vertices_;
  std::vector<Index> order_;        // a range is divided at its middle
  std::vector<std::uint8_t> axis_;  // that the range with this middle is divided along
};

}  // namespace rockfold
