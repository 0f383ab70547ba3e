#include "host/files/bodies/touching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <CGAL/Simple_cartesian.h>

#include "host/cut/bodies/union_find.hpp"
#include "host/cut/cells/near_boxes.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Kernel = CGAL::Simple_cartesian<Real>;  // distances, to rounding
using Triangle = std::array<Vec3, 3>;

Kernel::Point_3 point(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

bool is_near(const Vec3& x, const Triangle& t, Real reach) {
  const Kernel::Triangle_3 triangle(point(t[0]), point(t[1]), point(t[2]));
  return CGAL::squared_distance(point(x), triangle) <= reach * reach;
}

// Where two edges that are not parallel cross, seen along the normal, and pass each other within reach: the point between.
std::vector<Vec3> crossing(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                           const Vec3& normal, Real reach) {
  const Vec3 u = b - a, v = d - c, w = c - a;
  const Real det = dot(normal, cross(u, v));
  if (std::abs(det) <= 1e-6 * norm(u) * norm(v)) return {};
  const Real s = dot(normal, cross(w, v)) / det, t = dot(normal, cross(w, u)) / det;
  if (s < 0 || s > 1 || t < 0 || t > 1) return {};
  const Vec3 p = a + s * u, q = c + t * v;
  if (norm(q - p) > reach) return {};
  return {0.5 * (p + q)};
}

// Whether points do not lie on one line of that width.
bool span_area(const std::vector<Vec3>& points, Real width) {
  const Vec3 first = points.front();
  Vec3 farthest = first;
  for (const Vec3& x : points)
    if (norm(x - first) > norm(farthest - first)) farthest = x;
  const Vec3 along = farthest - first;
  if (norm(along) <= width) return false;
  return std::any_of(points.begin(), points.end(), [&](const Vec3& x) {
    return norm(cross(x - first, along)) > width * norm(along);
  });
}

class Finder {
 public:
  Finder(const BodySet& bodies, Real reach)
      : bodies_(bodies),
        reach_(reach),
        corners_(bodies.vertex_begin.back()),
        faces_(bodies.plane_begin.back()) {
    for (Index b = 0; b < static_cast<Index>(bodies.surface.size()); ++b) add_body(b);
  }

  Touching run() {
    found_.touches.assign(bodies_.surface.size(), false);
    join_corners();
    find_points_on_faces();
    find_crossings();
    join_faces();
    number();
    return std::move(found_);
  }

 private:
  void add_body(Index b) {
    const TriangleSurface& surface = *bodies_.surface[b];
    for (const Vec3& x : surface.vertices) {
      vertex_.push_back(x);
      body_of_vertex_.push_back(b);
      Box& box = vertex_box_.emplace_back();
      box.add(x);
    }
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      Box& box = triangle_box_.emplace_back();
      std::array<Index, 3> corner;
      for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = bodies_.vertex_begin[b] + surface.triangles[t][i];
        box.add(vertex_[corner[i]]);
      }
      triangle_.push_back(corner);
      body_of_triangle_.push_back(b);
      plane_of_triangle_.push_back(bodies_.plane_begin[b] + bodies_.planes[b].of_triangle[t]);
    }
  }

  Triangle corners_of(Index t) const {
    const auto& [a, b, c] = triangle_[t];
    return {vertex_[a], vertex_[b], vertex_[c]};
  }

  void touch(Index body, Index other) { found_.touches[body] = found_.touches[other] = true; }

  void join_corners() {
    const auto near = earlier_near_boxes(vertex_box_, reach_);
    for (Index v = 0; v < static_cast<Index>(near.size()); ++v)
      for (const Index w : near[v]) {
        if (body_of_vertex_[v] == body_of_vertex_[w] || norm(vertex_[v] - vertex_[w]) > reach_)
          continue;
        corners_.join(v, w);
        touch(body_of_vertex_[v], body_of_vertex_[w]);
      }
  }

  void find_points_on_faces() {
    for (Index t = 0; t < static_cast<Index>(triangle_.size()); ++t)
      for (const Index v : triangle_[t]) lies_on_.emplace_back(v, plane_of_triangle_[t]);
    const auto near = near_boxes(vertex_box_, triangle_box_, reach_);
    for (Index v = 0; v < static_cast<Index>(near.size()); ++v)
      for (const Index t : near[v]) {
        const Index body = body_of_vertex_[v], other = body_of_triangle_[t];
        if (body == other || !is_near(vertex_[v], corners_of(t), reach_)) continue;
        lies_on_.emplace_back(v, plane_of_triangle_[t]);
        touch(body, other);
      }
  }

  // Triangles of two bodies that face each other: their corners on each other and the crossings of their edges.
  void find_crossings() {
    constexpr Real facing =
        0.9;  // so far from parallel, no area of common points is as wide as asked for
    const auto near = earlier_near_boxes(triangle_box_, reach_);
    for (Index t = 0; t < static_cast<Index>(near.size()); ++t)
      for (const Index s : near[t]) {
        if (body_of_triangle_[t] == body_of_triangle_[s]) continue;
        const Index plane = plane_of_triangle_[t], other = plane_of_triangle_[s];
        const Vec3 normal = bodies_.outward(plane);
        if (dot(normal, bodies_.outward(other)) > -facing) continue;
        const Triangle a = corners_of(t), b = corners_of(s);
        auto& common = common_[{other, plane}];
        for (int i = 0; i < 3; ++i) {
          if (is_near(a[i], b, reach_)) common.push_back(a[i]);
          if (is_near(b[i], a, reach_)) common.push_back(b[i]);
          for (int j = 0; j < 3; ++j)
            for (const Vec3& x :
                 crossing(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], normal, reach_))
              common.push_back(x);
        }
      }
  }

  // A common area wider than what rounding of its edges makes is a contact.
  void join_faces() {
    for (const auto& [pair, points] : common_) {
      if (points.size() < 3 || !span_area(points, 4 * reach_)) continue;
      faces_.join(pair.first, pair.second);
      ++found_.contacts;
      touch(bodies_.body_of_plane(pair.first), bodies_.body_of_plane(pair.second));
    }
  }

  void number() {
    const auto number_of = [&](UnionFind& sets, const std::vector<Index>& begin, Index& count) {
      std::vector<Index> number(begin.back(), none);
      for (std::size_t b = 0; b + 1 < begin.size(); ++b)
        for (Index i = begin[b]; i < begin[b + 1] && found_.touches[b]; ++i) {
          const Index first = sets.find(i);
          if (number[first] == none) number[first] = count++;
          number[i] = number[first];
        }
      return number;
    };
    found_.corner = number_of(corners_, bodies_.vertex_begin, found_.corner_count);
    found_.face = number_of(faces_, bodies_.plane_begin, found_.face_count);
    for (const auto& [vertex, plane] : lies_on_)
      if (found_.corner[vertex] != none)
        found_.on.emplace_back(found_.corner[vertex], found_.face[plane]);
    std::sort(found_.on.begin(), found_.on.end());
    found_.on.erase(std::unique(found_.on.begin(), found_.on.end()), found_.on.end());
  }

  const BodySet& bodies_;
  Real reach_;
  std::vector<Vec3> vertex_;
  std::vector<std::array<Index, 3>> triangle_;
  std::vector<Index> body_of_vertex_, body_of_triangle_, plane_of_triangle_;
  std::vector<Box> vertex_box_, triangle_box_;
  UnionFind corners_, faces_;
  std::vector<std::pair<Index, Index>> lies_on_;                 // vertex, plane
  std::map<std::pair<Index, Index>, std::vector<Vec3>> common_;  // of planes that face each other
  Touching found_;
};

}  // namespace

void BodySet::add(const TriangleSurface& body, Real reach) {
  const auto number = static_cast<Index>(surface.size());
  surface.push_back(&body);
  planes.push_back(find_planes(body, reach));
  const auto count = static_cast<Index>(planes.back().outward.size());
  for (Index p = 0; p < count; ++p) plane_.emplace_back(number, p);
  plane_begin.push_back(plane_begin.back() + count);
  vertex_begin.push_back(vertex_begin.back() + static_cast<Index>(body.vertices.size()));
}

const Vec3& BodySet::outward(Index plane) const {
  return planes[plane_[plane].first].outward[plane_[plane].second];
}

Index BodySet::body_of_plane(Index plane) const {
  return plane_[plane].first;
}

Touching find_touching(const BodySet& bodies, Real reach) {
  return Finder(bodies, reach).run();
}

}  // namespace rockfold
