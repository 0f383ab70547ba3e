#include "host/cut/edge_planes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include "host/cut/patch.hpp"
#include "host/exact/plane_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real guard_sine = 1e-3;  // DESIGN.md, rule 3

struct Edge {
  Index polygon, side;
  Vec3 a, b;
  Real length;
  Index plane = none;  // found so far
  Real sine = 0;       // of its angle with the polygon's plane
};

using TreeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

TreeBox tree_box(const Vec3& low, const Vec3& high, Real slack, Index id) {
  return {CGAL::Bbox_3(low[0] - slack, low[1] - slack, low[2] - slack, high[0] + slack,
                       high[1] + slack, high[2] + slack),
          id};
}

TreeBox tree_box(const Edge& e, Real slack, Index id) {
  Box box;
  box.add(e.a), box.add(e.b);
  return tree_box(box.low, box.high, slack, id);
}

class EdgePlanes {
 public:
  EdgePlanes(PlaneTable& planes, const std::vector<FlatPolygon>& polygons)
      : planes_(planes), polygons_(polygons) {
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      const auto& c = polygons[p].corner;
      for (std::size_t k = 0; k < c.size(); ++k) {
        const Vec3 &a = c[k], &b = c[(k + 1) % c.size()];
        edges_.push_back({static_cast<Index>(p), static_cast<Index>(k), a, b, norm(b - a)});
      }
    }
  }

  // Rule 3.
  void take_given_planes(const std::vector<Index>& unbounded) {
    for (Edge& e : edges_)
      for (const Index plane : unbounded) offer(e, plane);
    std::vector<TreeBox> boxes, faces;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      boxes.push_back(tree_box(edges_[i], planes_.tolerance(), static_cast<Index>(i)));
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      Box box;
      for (const Vec3& x : polygons_[p].corner) box.add(x);
      faces.push_back(tree_box(box.low, box.high, 0, static_cast<Index>(p)));
    }
    CGAL::box_intersection_d(boxes.begin(), boxes.end(), faces.begin(), faces.end(),
                             [this](const TreeBox& edge, const TreeBox& face) {
                               offer(edges_[edge.info()], polygons_[face.info()].plane);
                             });
  }

  // Rule 4: long edges first, since they define a plane best.
  void take_edge_planes() {
    std::vector<Index> open;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (edges_[i].plane == none) open.push_back(static_cast<Index>(i));
    std::sort(open.begin(), open.end(), [this](Index i, Index j) { return before(i, j); });

    std::vector<std::vector<Index>> longer(open.size());  // neighbours decided before, by rank
    std::vector<TreeBox> boxes;
    for (std::size_t r = 0; r < open.size(); ++r)
      boxes.push_back(tree_box(edges_[open[r]], planes_.tolerance(), static_cast<Index>(r)));
    CGAL::box_self_intersection_d(
        boxes.begin(), boxes.end(), [&](const TreeBox& x, const TreeBox& y) {
          const Index low = std::min(x.info(), y.info()), high = std::max(x.info(), y.info());
          longer[high].push_back(low);
        });
    for (std::size_t r = 0; r < open.size(); ++r) {
      Edge& e = edges_[open[r]];
      std::sort(longer[r].begin(), longer[r].end());
      for (const Index other : longer[r]) {
        offer(e, edges_[open[other]].plane);
        if (e.plane != none) break;
      }
      if (e.plane == none) e.plane = own_plane(e);
    }
  }

  std::vector<std::vector<HalfSpaceId>> result() const {
    std::vector<std::vector<HalfSpaceId>> edges(polygons_.size());
    for (const Edge& e : edges_) {
      Real farthest = 0;  // the side that holds the polygon
      for (const Vec3& x : polygons_[e.polygon].corner)
        if (const Real d = distance(x, e.plane); std::abs(d) > std::abs(farthest)) farthest = d;
      edges[e.polygon].push_back(half_space(e.plane, farthest > 0));
    }
    return edges;
  }

 private:
  // Independent of how the polygons are numbered.
  bool before(Index i, Index j) const {
    const Edge &x = edges_[i], &y = edges_[j];
    if (x.length != y.length) return x.length > y.length;
    const auto xa = std::minmax(x.a, x.b), ya = std::minmax(y.a, y.b);
    if (xa != ya) return xa < ya;
    const Index p = polygons_[x.polygon].plane, q = polygons_[y.polygon].plane;
    return p != q ? p < q : i < j;
  }

  Real distance(const Vec3& x, Index plane) const {
    return dot(planes_.normal(plane), x) - planes_.offset(plane);
  }

  void offer(Edge& e, Index plane) const {
    const Index own = polygons_[e.polygon].plane;
    if (plane == own || plane == e.plane) return;
    if (std::abs(distance(e.a, plane)) > planes_.tolerance() ||
        std::abs(distance(e.b, plane)) > planes_.tolerance())
      return;
    const Real sine = norm(cross(planes_.normal(plane), planes_.normal(own)));
    if (sine <= guard_sine) return;
    // The steeper plane crosses the polygon's better; of equally steep ones the first.
    if (e.plane != none && (sine < e.sine - 1e-9 || (sine <= e.sine + 1e-9 && plane > e.plane)))
      return;
    e.plane = plane;
    e.sine = sine;
  }

  Index own_plane(const Edge& e) const {
    const ExactVec3 a = exact(e.a), b = exact(e.b), c = exact(planes_.centre());
    const ExactVec3 along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const ExactPlane plane = plane_along({a[0] + c[0], a[1] + c[1], a[2] + c[2]}, along,
                                         exact(planes_.normal(polygons_[e.polygon].plane)));
    const HalfSpaceId found = planes_.find(plane);
    return found != none ? plane_of(found) : planes_.add(plane);
  }

  PlaneTable& planes_;
  const std::vector<FlatPolygon>& polygons_;
  std::vector<Edge> edges_;
};

}  // namespace

std::vector<std::vector<HalfSpaceId>> edge_planes(PlaneTable& planes,
                                                  const std::vector<FlatPolygon>& polygons,
                                                  const std::vector<Index>& unbounded) {
  EdgePlanes edges(planes, polygons);
  edges.take_given_planes(unbounded);
  edges.take_edge_planes();
  return edges.result();
}

}  // namespace rockfold
