// Points nearer to each other than a tolerance as one, and the points on an edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// Numbers points so that those nearer than the tolerance (m) to one that is there become it, the nearest. O(1) a point.
class VertexMerger {
 public:
  explicit VertexMerger(Real tolerance) : tolerance_(tolerance) {}
  Index add(const Vec3& x);
  const std::vector<Vec3>& vertices() const { return vertices_; }

 private:
  const Real tolerance_;
  std::vector<Vec3> vertices_;
  std::unordered_multimap<std::uint64_t, Index> by_cell_;  // of a grid
};

/// Finds the vertices in the interior of an edge by a tree of halves. O(log n) an edge and what is near it.
class VertexFinder {
 public:
  VertexFinder(const std::vector<Vec3>& vertices, Real tolerance);

  /// The vertices between `from` and `to`, nearer to their line than the tolerance, in order from `from`.
  std::vector<Index> between(Index from, Index to) const;

 private:
  struct Line {
    Vec3 a, e;
  };
  void build(std::size_t begin, std::size_t end);
  template <class Visit>
  void visit(std::size_t begin, std::size_t end, const Line& line, Real from, Real to,
             const Visit& found) const;

  const std::vector<Vec3>& vertices_;
  const Real tolerance_;
  std::vector<Index> order_;        // a range is divided at its middle
  std::vector<std::uint8_t> axis_;  // that the range with this middle is divided along
};

}  // namespace rockfold
