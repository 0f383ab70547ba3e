#include "host/files/bodies/overlapping.hpp"

#include <cmath>
#include <memory>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include "host/cut/cells/near_boxes.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;

Kernel::Point_3 point(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

/// A body to ask how deep a point lies in it.
class Inside {
 public:
  explicit Inside(const TriangleSurface& surface) {
    std::vector<Mesh::Vertex_index> vertex;
    for (const Vec3& x : surface.vertices) vertex.push_back(mesh_.add_vertex(point(x)));
    for (const auto& [a, b, c] : surface.triangles)
      mesh_.add_face(vertex[static_cast<std::size_t>(a)], vertex[static_cast<std::size_t>(b)],
                     vertex[static_cast<std::size_t>(c)]);
    tree_.insert(faces(mesh_).first, faces(mesh_).second, mesh_);
    tree_.build();
    side_ = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel>>(mesh_);
  }

  /// m; 0 outside.
  Real depth(const Vec3& x) const {
    if ((*side_)(point(x)) != CGAL::ON_BOUNDED_SIDE) return 0;
    return std::sqrt(tree_.squared_distance(point(x)));
  }

 private:
  Mesh mesh_;
  Tree tree_;
  std::unique_ptr<CGAL::Side_of_triangle_mesh<Mesh, Kernel>> side_;
};

}  // namespace

Overlap find_overlap(const std::vector<const TriangleSurface*>& bodies, Real reach) {
  std::vector<Box> boxes;
  for (const TriangleSurface* body : bodies) {
    Box& box = boxes.emplace_back();
    for (const Vec3& x : body->vertices) box.add(x);
  }
  Overlap found;
  const auto near = near_boxes(boxes, boxes, 0);
  for (Index b = 0; b < static_cast<Index>(bodies.size()); ++b) {
    std::unique_ptr<Inside> inside;
    for (const Index other : near[b]) {
      if (other == b) continue;
      Real deepest = 0;
      for (const Vec3& x : bodies[other]->vertices) {
        const Box& box = boxes[b];
        bool within = true;
        for (int d = 0; d < 3; ++d)
          within = within && x[d] > box.low[d] + reach && x[d] < box.high[d] - reach;
        if (!within) continue;
        if (!inside) inside = std::make_unique<Inside>(*bodies[b]);
        deepest = std::max(deepest, inside->depth(x));
      }
      if (!(deepest > reach)) continue;
      ++found.count;
      if (deepest > found.depth) found.depth = deepest, found.body = other, found.other = b;
    }
  }
  return found;
}

}  // namespace rockfold
