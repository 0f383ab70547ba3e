// Auxiliary planes that divide space before many small polygons cut it. A polygon's plane cuts whole cells: a hundred
// thousand triangles of a terrain would each slice large cells, where in small boxes they cut little more than they
// themselves are. What these planes cut is glued together again.
#pragma once

#include <vector>

#include "host/cut/cells/patch.hpp"

namespace rockfold {

class AuxTree {
 public:
  struct Node {
    Index plane = none;             ///< across an axis; none = a leaf
    Index child[2] = {none, none};  ///< below and above the plane
  };

  /// No divisions.
  AuxTree() : nodes_(1) {}

  /// Divides `space` (m, about the table's centre) until few of the bounded patches meet each box; their corners' planes
  /// are preferred. O(n log² n). Adds its planes to the table.
  AuxTree(PlaneTable& planes, const std::vector<const Patch*>& patches, const Box& space);

  const Node& operator[](Index node) const { return nodes_[node]; }
  static constexpr Index root = 0;

 private:
  struct Builder;
  std::vector<Node> nodes_;
};

}  // namespace rockfold
