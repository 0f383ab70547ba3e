// From posts of a ground surface to triangles.
#pragma once

#include <vector>

#include "host/files/faults.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Posts at each x of `x` and each y of `y`.
struct PostGrid {
  std::vector<Real> x, y;  ///< m, ascending
  std::vector<Real> z;     ///< [y][x] m; NaN = no post
};

/// m, in plan, below which the cutter may not tell posts of a ground of this size (m, along x, y, z) apart.
Real least_post_distance(const Vec3& size);

/// Squares of four posts become two triangles along the diagonal that is shorter in space (of equal ones
/// the one towards north-east; elevations that are equal as decimals count as equal), those of three posts one triangle; counter-clockwise seen from above.
/// Where parts of the ground touch at one post alone, the smaller side's triangles at that post are left
/// out, so that the outlines of what remains are simple polygons.
/// Throws Error(model) if no triangle remains or there are too many posts.
TriangleSurface ground_of_grid(const PostGrid& grid, Faults& faults);

/// Scattered posts, no two of the same (x, y): Delaunay's triangulation in plan (CGAL, exact). Triangles
/// at its border that are flatter than 1e-6 of their length are left out. Throws Error(model) if all posts lie
/// on one line.
TriangleSurface ground_of_posts(std::vector<Vec3> posts, Faults& faults);

}  // namespace rockfold
