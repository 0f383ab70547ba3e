#include "host/files/meshes/mesh_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<bool, Kernel,
                                              CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
    CGAL::No_constraint_intersection_tag>;
using Triangle = std::array<Index, 3>;

/// Deviation from a plane over the size of a face that is taken for rounding in the file: six digits
/// of coordinates, faces of a thousandth of the whole.
constexpr Real planar_tolerance = 1e-3;
/// Of a polygon's size: a digit that takes its corners further off their plane is no rounding (as of [contact] tolerance).
constexpr Real most_rounding = 0.05;

/// For each vertex the first one of the same coordinates.
std::vector<Index> identical_vertices(const std::vector<Vec3>& vertices) {
  std::vector<Index> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](Index v) -> const Vec3& { return vertices[static_cast<std::size_t>(v)]; };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto v = static_cast<std::size_t>(order[i]);
    const bool same = i > 0 && at(order[i]) == at(order[i - 1]);
    first[v] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

/// The polygon's vector area (Newell); its length is the area.
Vec3 vector_area(const std::vector<Vec3>& corners) {
  Vec3 area{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    area += 0.5 * cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return area;
}

/// The points as seen against the normal's largest component.
std::vector<Point2> projected(const std::vector<Vec3>& corners, const Vec3& normal) {
  std::size_t k = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::abs(normal[d]) > std::abs(normal[k])) k = d;
  std::vector<Point2> points;
  for (const auto& p : corners) {
    const Real x = p[(k + 1) % 3], y = p[(k + 2) % 3];
    points.emplace_back(normal[k] > 0 ? x : y, normal[k] > 0 ? y : x);
  }
  return points;
}

/// "" or what is wrong with the polygon's plane, whose corners are rounded to `digit`.
std::string plane_fault(const std::vector<Vec3>& corners, const Vec3& area, Real digit) {
  if (!(norm(area) > 0)) return "has no area";
  const Vec3 normal = normalized(area);
  Real size = 0;
  for (const auto& corner : corners) size = std::max(size, norm(corner - corners[0]));
  for (const auto& corner : corners) {
    const Real distance = std::abs(dot(normal, corner - corners[0]));
    if (distance > std::max(planar_tolerance * size, std::min(2 * digit, most_rounding * size)))
      return fmt::format(
          "must be planar, but its corner {} lies {:.3g} m off the plane: split it "
          "into triangles",
          point_text(corner), distance);
  }
  return "";
}

/// Counter-clockwise triangles of a convex quadrilateral; none if it is not convex.
std::vector<Triangle> split_quadrilateral(const std::vector<Vec3>& corners,
                                          const std::vector<Point2>& points) {
  for (std::size_t i = 0; i < 4; ++i)
    if (CGAL::orientation(points[i], points[(i + 1) % 4], points[(i + 2) % 4]) != CGAL::LEFT_TURN)
      return {};
  if (norm(corners[3] - corners[1]) < norm(corners[2] - corners[0])) return {{0, 1, 3}, {1, 2, 3}};
  return {{0, 1, 2}, {0, 2, 3}};
}

/// Marks the faces that are reached from outside without crossing the polygon (info = true).
void mark_outside(Triangulation& triangulation) {
  for (auto face : triangulation.all_face_handles()) face->info() = false;
  std::vector<Triangulation::Face_handle> stack{triangulation.infinite_face()};
  stack.back()->info() = true;
  while (!stack.empty()) {
    const auto face = stack.back();
    stack.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info() || face->is_constrained(i)) continue;
      next->info() = true;
      stack.push_back(next);
    }
  }
}

/// Counter-clockwise triangles of a simple polygon of either sense; none if it is not simple.
std::vector<Triangle> triangulated(const std::vector<Point2>& points) {
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertices;
  for (const auto& point : points) {
    const auto before = triangulation.number_of_vertices();
    vertices.push_back(triangulation.insert(point));
    if (triangulation.number_of_vertices() == before) return {};  // two corners in one place
    vertices.back()->info() = static_cast<Index>(vertices.size() - 1);
  }
  if (triangulation.dimension() < 2) return {};
  try {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      triangulation.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return {};
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!triangulation.is_edge(vertices[i], vertices[(i + 1) % vertices.size()])) return {};
  mark_outside(triangulation);
  std::vector<Triangle> triangles;
  for (auto face : triangulation.finite_face_handles())
    if (!face->info())
      triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

class TriangleMaker {
 public:
  TriangleMaker(const PolygonSoup& soup, bool drop_collapsed, Faults& faults, Real digit)
      : soup_(soup),
        drop_collapsed_(drop_collapsed),
        faults_(faults),
        digit_(digit),
        first_(identical_vertices(soup.vertices)),
        number_(soup.vertices.size(), none) {}

  MeshTriangles make() {
    for (Index p = 0; p < soup_.polygon_count(); ++p) add_polygon(static_cast<std::size_t>(p));
    if (without_area_ > 0)
      faults_.add(first_line_, 0,
                  fmt::format("{} without area (all corners on one line), the first at {}",
                              counted(without_area_, "triangle"), point_text(first_place_)));
    faults_.throw_if_any();
    if (mesh_.line.empty()) faults_.fail("holds no triangles");
    return std::move(mesh_);
  }

 private:
  const Vec3& position(Index v) const { return soup_.vertices[static_cast<std::size_t>(v)]; }

  void add_polygon(std::size_t p) {
    const auto begin = soup_.corner.begin();
    std::vector<Index> corners(begin + soup_.corner_begin[p], begin + soup_.corner_begin[p + 1]);
    for (auto& corner : corners) corner = first_[static_cast<std::size_t>(corner)];
    if (corners.size() == 3) {
      add_triangle({corners[0], corners[1], corners[2]}, soup_.line[p]);
      return;
    }
    std::vector<Vec3> points;
    for (const Index corner : corners) points.push_back(position(corner));
    const Vec3 area = vector_area(points);
    auto fault = plane_fault(points, area, digit_);
    std::vector<Triangle> triangles;
    if (fault.empty()) {
      const auto plane = projected(points, area);
      if (corners.size() == 4) triangles = split_quadrilateral(points, plane);
      if (triangles.empty()) triangles = triangulated(plane);
      if (triangles.empty()) fault = "crosses or touches itself";
    }
    if (!fault.empty()) {
      faults_.add(soup_.line[p], 0,
                  fmt::format("face {} at {} {}", p + 1, point_text(points[0]), fault));
      return;
    }
    for (const auto& triangle : triangles)
      add_triangle({corners[static_cast<std::size_t>(triangle[0])],
                    corners[static_cast<std::size_t>(triangle[1])],
                    corners[static_cast<std::size_t>(triangle[2])]},
                   soup_.line[p]);
  }

  void add_triangle(Triangle triangle, int line) {
    const auto [a, b, c] = triangle;
    const bool collapsed = a == b || b == c || c == a;
    if (collapsed && drop_collapsed_) return;
    if (collapsed || lies_on_a_line(triangle)) {
      if (without_area_++ > 0) return;
      first_line_ = line;
      first_place_ = position(a);
      return;
    }
    for (auto& corner : triangle) corner = numbered(corner);
    mesh_.surface.triangles.push_back(triangle);
    mesh_.line.push_back(line);
  }

  bool lies_on_a_line(const Triangle& triangle) const {
    const auto point = [&](std::size_t i) {
      const Vec3& p = position(triangle[i]);
      return Kernel::Point_3(p[0], p[1], p[2]);
    };
    return CGAL::collinear(point(0), point(1), point(2));
  }

  Index numbered(Index vertex) {
    auto& number = number_[static_cast<std::size_t>(vertex)];
    if (number == none) {
      number = static_cast<Index>(mesh_.surface.vertices.size());
      mesh_.surface.vertices.push_back(position(vertex));
    }
    return number;
  }

  const PolygonSoup& soup_;
  bool drop_collapsed_;
  Faults& faults_;
  Real digit_;
  std::vector<Index> first_, number_;
  MeshTriangles mesh_;
  std::size_t without_area_ = 0;
  int first_line_ = 0;
  Vec3 first_place_{};
};

}  // namespace

MeshTriangles make_triangles(const PolygonSoup& soup, bool drop_collapsed, Faults& faults,
                             Real digit) {
  return TriangleMaker(soup, drop_collapsed, faults, digit).make();
}

}  // namespace rockfold
