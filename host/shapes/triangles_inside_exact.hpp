// Triangulations of polygons and their holes. CGAL: include in .cpp only.
#pragma once

#include <array>
#include <map>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "src/base/types.hpp"

namespace rockfold {

/// Constraints are the outlines; a vertex's info is its number. Outlines that cross throw
/// Intersection_of_constraints_exception.
template <class Kernel>
using OutlineTriangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>,
                                         CGAL::Constrained_triangulation_face_base_2<Kernel>>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// The triangles inside, counter-clockwise: an odd number of outlines parts them from infinity.
template <class Triangulation>
std::vector<std::array<Index, 3>> triangles_inside(const Triangulation& plan) {
  using Face = typename Triangulation::Face_handle;
  std::map<Face, bool> inside;
  std::vector<Face> open{plan.infinite_face()};
  inside[plan.infinite_face()] = false;
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    const bool here = inside[face];
    for (int k = 0; k < 3; ++k) {
      const Face next = face->neighbor(k);
      const bool there = here != plan.is_constrained({face, k});
      if (inside.try_emplace(next, there).second) open.push_back(next);
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  for (const Face face : plan.finite_face_handles())
    if (inside[face])
      triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

}  // namespace rockfold
