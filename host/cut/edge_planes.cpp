#include "host/cut/edge_planes.hpp"

#include <algorithm>
#include <cmath>

#include "host/cut/near_boxes.hpp"
#include "host/exact/plane_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real guard_sine = 1e-3;  // DESIGN.md, rule 3
// Of exactly known planes, which meet in the edge itself.
constexpr Real exact_guard_sine = 1e-8;

struct Edge {
  Index polygon, side;
  Vec3 a, b;
  Real length;
  Index plane = none;  // found so far
  Real sine = 0;       // of its angle with the polygon's plane
};

Box box_of(const Edge& e) {
  Box box;
  box.add(e.a), box.add(e.b);
  return box;
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
    std::vector<Box> boxes, faces;
    for (const Edge& e : edges_) boxes.push_back(box_of(e));
    for (const FlatPolygon& polygon : polygons_) {
      faces.emplace_back();
      for (const Vec3& x : polygon.corner) faces.back().add(x);
    }
    const auto near = near_boxes(boxes, faces, planes_.tolerance());
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (const Index p : near[i]) offer(edges_[i], polygons_[p].plane);
  }

  // Rule 4: long edges first, since they define a plane best.
  void take_edge_planes() {
    std::vector<Index> open;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (edges_[i].plane == none) open.push_back(static_cast<Index>(i));
    std::sort(open.begin(), open.end(), [this](Index i, Index j) { return before(i, j); });

    std::vector<Box> boxes;
    for (const Index i : open) boxes.push_back(box_of(edges_[i]));
    const auto longer = earlier_near_boxes(boxes, 2 * planes_.tolerance());
    for (std::size_t r = 0; r < open.size(); ++r) {
      Edge& e = edges_[open[r]];
      for (const Index other : longer[r]) {
        offer(e, edges_[open[other]].plane);
        if (e.plane != none) break;
      }
      if (e.plane == none) e.plane = own_plane(e);
    }
  }

  std::vector<std::vector<HalfSpaceId>> result() const {
    std::vector<std::vector<HalfSpaceId>> edges(polygons_.size());
    std::vector<bool> on_a_line(polygons_.size(), false);
    for (const Edge& e : edges_) {
      const FlatPolygon& polygon = polygons_[e.polygon];
      Real farthest = 0;  // the side that holds the polygon
      for (const Vec3& x : polygon.corner)
        if (const Real d = distance(x, e.plane); std::abs(d) > std::abs(farthest)) farthest = d;
      edges[e.polygon].push_back(half_space(e.plane, farthest > 0));
      if (std::abs(farthest) <= planes_.tolerance(e.plane, polygon.plane))
        on_a_line[e.polygon] = true;
    }
    // Nothing is on both sides of an edge: such a polygon cuts nothing.
    for (std::size_t p = 0; p < edges.size(); ++p)
      if (on_a_line[p]) edges[p] = {edges[p].front(), edges[p].front() ^ 1};
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
    return dot(planes_.normal(plane), x - planes_.centre()) - planes_.offset(plane);
  }

  void offer(Edge& e, Index plane) const {
    const Index own = polygons_[e.polygon].plane;
    if (plane == own || plane == e.plane) return;
    const Real tolerance = planes_.tolerance(plane, own);
    if (std::abs(distance(e.a, plane)) > tolerance || std::abs(distance(e.b, plane)) > tolerance)
      return;
    const Real sine = norm(cross(planes_.normal(plane), planes_.normal(own)));
    const bool exactly =
        planes_.known(own) == Known::exactly && planes_.known(plane) == Known::exactly;
    if (sine <= (exactly ? exact_guard_sine : guard_sine)) return;
    // The steeper plane crosses the polygon's better; of equally steep ones the first.
    if (e.plane != none && (sine < e.sine - 1e-9 || (sine <= e.sine + 1e-9 && plane > e.plane)))
      return;
    e.plane = plane;
    e.sine = sine;
  }

  Index own_plane(const Edge& e) const {
    const ExactVec3 a = exact(e.a), b = exact(e.b);
    const Index own = polygons_[e.polygon].plane;
    const ExactPlane plane =
        plane_along(a, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, exact(planes_.normal(own)));
    // Edges of a needle lie on planes that nearly coincide and are not one.
    if (planes_.known(own) == Known::exactly) return planes_.add(plane, Known::exactly);
    return plane_of(planes_.find_or_add(plane));
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
