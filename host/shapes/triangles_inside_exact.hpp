// Triangulations of polygons and their holes. CGAL: include in .cpp only.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include "src/base/types.hpp"

namespace rockfold {

/// Constraints are the outlines; a vertex's info is its number, a face's its level (see
/// triangles_above). Outlines that cross throw Intersection_of_constraints_exception.
template <class Kernel>
using OutlineTriangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<
        CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>,
        CGAL::Constrained_triangulation_face_base_2<
            Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

/// The triangles of positive level, counter-clockwise. The level is 0 at infinity; across(here,
/// face, k) is the level beyond edge k of a face whose level is `here`.
template <class Triangulation, class Across>
std::vector<std::array<Index, 3>> triangles_above(Triangulation& plan, Across across) {
  using Face = typename Triangulation::Face_handle;
  if (plan.dimension() < 2) return {};
  constexpr int unseen = std::numeric_limits<int>::min();
  for (const Face face : plan.all_face_handles()) face->info() = unseen;
  std::vector<Face> open{plan.infinite_face()};
  open.back()->info() = 0;
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Face next = face->neighbor(k);
      if (next->info() != unseen) continue;
      next->info() = across(face->info(), face, k);
      open.push_back(next);
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  for (const Face face : plan.finite_face_handles())
    if (face->info() > 0)
      triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

/// The triangles inside, counter-clockwise: an odd number of outlines parts them from infinity.
template <class Triangulation>
std::vector<std::array<Index, 3>> triangles_inside(Triangulation& plan) {
  return triangles_above(plan, [&](int inside, auto face, int k) {
    return plan.is_constrained({face, k}) ? 1 - inside : inside;
  });
}

}  // namespace rockfold
