#include "host/files/terrain/terrain_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Unique_hash_map.h>
#include <fmt/format.h>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;
using Triangle = std::array<Index, 3>;
using SizeT = std::size_t;

/// Of the elevations: what differences that are equal as decimals may differ by as doubles. Decimals of up to fourteen digits that are not
/// equal differ by more.
constexpr Real tie = 4 * std::numeric_limits<Real>::epsilon();

/// Height over length of border triangles that are taken for rounding of posts on one line.
constexpr Real sliver = 1e-6;

/// The triangles at each vertex: those of v are at[begin[v]] … at[begin[v + 1] − 1].
struct Fans {
  std::vector<Index> begin, at;
};

Fans fans_of(const TriangleSurface& ground) {
  Fans fans;
  fans.begin.assign(ground.vertices.size() + 1, 0);
  for (const auto& triangle : ground.triangles)
    for (const Index v : triangle) ++fans.begin[static_cast<SizeT>(v) + 1];
  for (SizeT v = 1; v < fans.begin.size(); ++v) fans.begin[v] += fans.begin[v - 1];
  fans.at.resize(3 * ground.triangles.size());
  std::vector<Index> next(fans.begin.begin(), fans.begin.end() - 1);
  for (SizeT t = 0; t < ground.triangles.size(); ++t)
    for (const Index v : ground.triangles[t])
      fans.at[static_cast<SizeT>(next[static_cast<SizeT>(v)]++)] = static_cast<Index>(t);
  return fans;
}

/// Of the triangles at a vertex v, those that are no part of the largest group joined by edges at v (of equal
/// groups the first).
std::vector<Index> apart_at(const TriangleSurface& ground, Index v, std::vector<Index> triangles) {
  const auto share_edge = [&](Index s, Index t) {
    for (const Index a : ground.triangles[static_cast<SizeT>(s)])
      for (const Index b : ground.triangles[static_cast<SizeT>(t)])
        if (a == b && a != v) return true;
    return false;
  };
  std::vector<std::vector<Index>> groups;
  while (!triangles.empty()) {
    std::vector<Index> group{triangles.front()};
    triangles.erase(triangles.begin());
    for (SizeT i = 0; i < group.size(); ++i)
      for (auto t = triangles.begin(); t != triangles.end();) {
        const bool joined = share_edge(group[i], *t);
        if (joined) group.push_back(*t);
        t = joined ? triangles.erase(t) : t + 1;
      }
    groups.push_back(std::move(group));
  }
  SizeT largest = 0;
  for (SizeT g = 1; g < groups.size(); ++g)
    if (groups[g].size() > groups[largest].size()) largest = g;
  std::vector<Index> apart;
  for (SizeT g = 0; g < groups.size(); ++g)
    if (g != largest) apart.insert(apart.end(), groups[g].begin(), groups[g].end());
  return apart;
}

/// Removes the triangles that are marked.
void remove_triangles(TriangleSurface& ground, const std::vector<bool>& removed) {
  SizeT kept = 0;
  for (SizeT t = 0; t < ground.triangles.size(); ++t)
    if (!removed[t]) ground.triangles[kept++] = ground.triangles[t];
  ground.triangles.resize(kept);
}

/// Leaves one fan of triangles at each vertex. Each turn removes a triangle at least, and the vertices of a grid
/// have six triangles at most.
void separate_touching_parts(TriangleSurface& ground) {
  while (true) {
    const Fans fans = fans_of(ground);
    std::vector<bool> removed(ground.triangles.size(), false);
    bool any = false;
    for (SizeT v = 0; v < ground.vertices.size(); ++v) {
      std::vector<Index> triangles;
      for (Index i = fans.begin[v]; i < fans.begin[v + 1]; ++i)
        if (!removed[static_cast<SizeT>(fans.at[static_cast<SizeT>(i)])])
          triangles.push_back(fans.at[static_cast<SizeT>(i)]);
      for (const Index t : apart_at(ground, static_cast<Index>(v), std::move(triangles)))
        removed[static_cast<SizeT>(t)] = any = true;
    }
    if (!any) return;
    remove_triangles(ground, removed);
  }
}

/// Takes out vertices without triangles; the others keep their order.
void drop_lone_vertices(TriangleSurface& ground) {
  std::vector<Index> number(ground.vertices.size(), none);
  for (const auto& triangle : ground.triangles)
    for (const Index v : triangle) number[static_cast<SizeT>(v)] = 0;
  Index count = 0;
  for (SizeT v = 0; v < number.size(); ++v) {
    if (number[v] == none) continue;
    ground.vertices[static_cast<SizeT>(count)] = ground.vertices[v];
    number[v] = count++;
  }
  ground.vertices.resize(static_cast<SizeT>(count));
  for (auto& triangle : ground.triangles)
    for (auto& v : triangle) v = number[static_cast<SizeT>(v)];
}

/// The triangles of one square; corners[0 … 3] are its posts south-west, south-east, north-east, north-west (none
/// where there is no post).
void add_square(const std::array<Index, 4>& corners, TriangleSurface& ground) {
  const auto missing = std::count(corners.begin(), corners.end(), none);
  if (missing > 1) return;
  if (missing == 1) {
    Triangle triangle{};
    SizeT i = 0;
    for (const Index corner : corners)
      if (corner != none) triangle[i++] = corner;
    ground.triangles.push_back(triangle);
    return;
  }
  const auto z = [&](SizeT i) { return ground.vertices[static_cast<SizeT>(corners[i])][2]; };
  // In plan the diagonals of a rectangle are equally long.
  const Real north_east = std::abs(z(2) - z(0)), north_west = std::abs(z(3) - z(1));
  const Real largest = std::max({std::abs(z(0)), std::abs(z(1)), std::abs(z(2)), std::abs(z(3))});
  if (north_east - north_west > tie * largest) {
    ground.triangles.push_back({corners[0], corners[1], corners[3]});
    ground.triangles.push_back({corners[1], corners[2], corners[3]});
  } else {
    ground.triangles.push_back({corners[0], corners[1], corners[2]});
    ground.triangles.push_back({corners[0], corners[2], corners[3]});
  }
}

/// Twice the area in plan over the square of the longest side: height over length.
Real flatness(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Real area = cross(b - a, c - a)[2];
  Real longest = 0;
  for (const Vec3& side : {b - a, c - b, a - c})
    longest = std::max(longest, side[0] * side[0] + side[1] * side[1]);
  return area / longest;
}

/// Peels slivers off the border until none is left that can go: those with two border sides, whose tip goes with them,
/// and those whose inner corner is no border corner yet; others would leave parts that touch at a point.
std::vector<Triangle> without_border_slivers(Delaunay& delaunay, const std::vector<Vec3>& posts) {
  std::vector<bool> on_border(posts.size(), false);
  std::vector<std::pair<Delaunay::Face_handle, int>>
      stack;  // a face and the place of its inner corner
  CGAL::Unique_hash_map<Delaunay::Face_handle, bool> removed(false);
  const auto post = [&](Delaunay::Face_handle face, int i) {
    return static_cast<SizeT>(face->vertex(i)->info());
  };
  for (auto face : delaunay.all_face_handles()) {
    if (!delaunay.is_infinite(face)) continue;
    removed[face] = true;
    const int i = face->index(delaunay.infinite_vertex());
    on_border[post(face, delaunay.ccw(i))] = true;
    const auto inner = face->neighbor(i);
    stack.emplace_back(inner, inner->index(face));
  }
  while (!stack.empty()) {
    const auto [face, i] = stack.back();
    stack.pop_back();
    const SizeT corner = post(face, i);
    const bool is_tip =
        removed[face->neighbor(delaunay.cw(i))] || removed[face->neighbor(delaunay.ccw(i))];
    if (removed[face] || (on_border[corner] && !is_tip)) continue;
    if (flatness(posts[post(face, 0)], posts[post(face, 1)], posts[post(face, 2)]) > sliver)
      continue;
    removed[face] = on_border[corner] = true;
    for (const int side : {delaunay.cw(i), delaunay.ccw(i)})
      if (!removed[face->neighbor(side)])
        stack.emplace_back(face->neighbor(side), face->neighbor(side)->index(face));
  }
  std::vector<Triangle> triangles;
  for (auto face : delaunay.finite_face_handles())
    if (!removed[face])
      triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

void check_count(SizeT posts, Faults& faults) {
  constexpr SizeT most =
      std::numeric_limits<Index>::max() / 6;  // sides of triangles are counted too
  if (posts > most) faults.fail(fmt::format("has {} posts: at most {} can be used", posts, most));
}

}  // namespace

Real least_post_distance(const Vec3& size) {
  return 1e-9 * norm(size);
}

TriangleSurface ground_of_grid(const PostGrid& grid, Faults& faults) {
  check_count(grid.z.size(), faults);
  const SizeT columns = grid.x.size(), rows = grid.y.size();
  TriangleSurface ground;
  std::vector<Index> vertex(grid.z.size(), none);
  for (SizeT i = 0; i < grid.z.size(); ++i) {
    if (std::isnan(grid.z[i])) continue;
    vertex[i] = static_cast<Index>(ground.vertices.size());
    ground.vertices.push_back({grid.x[i % columns], grid.y[i / columns], grid.z[i]});
  }
  const bool has_gaps = ground.vertices.size() < grid.z.size();
  if (columns > 1 && rows > 1) ground.triangles.reserve(2 * ground.vertices.size());
  for (SizeT j = 0; j + 1 < rows; ++j)
    for (SizeT i = 0; i + 1 < columns; ++i) {
      const SizeT at = j * columns + i;
      add_square({vertex[at], vertex[at + 1], vertex[at + columns + 1], vertex[at + columns]},
                 ground);
    }
  if (has_gaps) separate_touching_parts(ground);
  if (ground.triangles.empty())
    faults.fail("has no three neighbouring posts: a ground needs two rows and columns at least");
  if (has_gaps) drop_lone_vertices(ground);
  return ground;
}

TriangleSurface ground_of_posts(std::vector<Vec3> posts, Faults& faults) {
  check_count(posts.size(), faults);
  std::sort(posts.begin(),
            posts.end());  // the triangulation is that of the posts, not of their order
  std::vector<std::pair<Kernel::Point_2, Index>> points;
  points.reserve(posts.size());
  for (const auto& post : posts)
    points.emplace_back(Kernel::Point_2(post[0], post[1]), static_cast<Index>(points.size()));
  Delaunay delaunay(points.begin(), points.end());
  TriangleSurface ground;
  if (delaunay.dimension() == 2) ground.triangles = without_border_slivers(delaunay, posts);
  if (ground.triangles.empty())
    faults.fail("must have posts that do not all lie on one line in plan");
  ground.vertices = std::move(posts);
  drop_lone_vertices(ground);
  return ground;
}

}  // namespace rockfold
