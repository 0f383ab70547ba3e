// Closed loops as edges of a triangulation, and how often they wind around its triangles. CGAL: include in .cpp only.
#pragma once

#include <array>
#include <map>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "host/shapes/triangles_inside_exact.hpp"

namespace rockfold {

/// How often loops pass each edge between numbered vertices: forwards less backwards.
class EdgeCount {
 public:
  void add(Index from, Index to, int passes);
  int of(Index from, Index to) const;
  int take(Index from, Index to);  ///< and leaves 0
  const std::map<std::array<Index, 2>, int>& passes() const { return passes_; }

 private:
  std::map<std::array<Index, 2>, int> passes_;  ///< the smaller number first
};

/// Draws closed loops as constraints. Each remains a closed path of edges whatever is in its way,
/// so that the winding number of each triangle is defined.
class WindingOutline {
 public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Plan = OutlineTriangulation<Kernel>;

  /// `bends` bounds the work where many edges cross.
  WindingOutline(Plan& plan, std::size_t bends) : plan_(plan), bends_(bends) {}

  /// The straight edge between two vertices, passed so many times. It goes through the vertices on it. Of two edges that
  /// cross, one is bent to the nearest of the four ends: by no more than rounding has moved it, where rounding made them
  /// cross. When no bends are left, the edge goes around what is in its way, on the left.
  void draw(Plan::Vertex_handle from, Plan::Vertex_handle to, int passes);

  /// The winding number beyond edge k of a face with winding number `here`.
  int across(int here, Plan::Face_handle face, int k) const;

 private:
  using Vertex = Plan::Vertex_handle;
  struct Segment {
    Vertex from, to;
    int passes;
  };
  /// The way from a vertex straight to another.
  struct View {
    Vertex reached{};               ///< the first vertex on it, the end at the latest
    Plan::Edge barrier{{}, 0};      ///< the first constraint across it; no face = none
    std::vector<Vertex> on_left{};  ///< a path to `reached` along edges
  };
  View look(Vertex from, Vertex to) const;
  View look_across(Plan::Edge edge, Vertex from, Vertex to) const;
  void bend(const Segment& segment, Plan::Edge barrier, std::vector<Segment>& open);
  void lay(Vertex from, Vertex to, int passes);

  Plan& plan_;
  std::size_t bends_;
  EdgeCount laid_;
};

}  // namespace rockfold
