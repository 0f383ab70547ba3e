#include "host/cut/planes/edge_planes.hpp"

#include <algorithm>
#include <cmath>

#include "host/cut/cells/near_boxes.hpp"
#include "host/cut/cells/polygon.hpp"
#include "host/exact/plane_exact.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real guard_sine = 1e-3;  // decision 5, rule 3

struct Edge {
  Index polygon, side;
  Vec3 a, b;
  Real length;
  Index plane = none;    // found so far
  Real sine = 0;         // of its angle with the polygon's plane
  bool exactly = false;  // whether it lies on the plane found exactly
};

Box box_of(const Edge& e) {
  Box box;
  box.add(e.a), box.add(e.b);
  return box;
}

Real distance(const PlaneTable& planes, const Vec3& x, Index plane) {
  return dot(planes.normal(plane), x - planes.centre()) - planes.offset(plane);
}

// Exactly through both ends, perpendicular to another plane.
NewPlane plane_of_edge(const PlaneTable& planes, const Vec3& a, const Vec3& b,
                       Index perpendicular_to) {
  IntegerPlane plane = plane_through_edge(a, b, planes.normal(perpendicular_to), planes.centre());
  const UnitPlane unit = rounded(plane);
  return {std::move(plane), unit};
}

const Vec3& farthest_from(const PlaneTable& planes, Index plane, const std::vector<Vec3>& corners) {
  return *std::max_element(corners.begin(), corners.end(), [&](const Vec3& x, const Vec3& y) {
    return std::abs(distance(planes, x, plane)) < std::abs(distance(planes, y, plane));
  });
}

class EdgeFinder {
 public:
  EdgeFinder(PlaneTable& planes, const std::vector<FlatPolygon>& polygons)
      : planes_(planes), polygons_(polygons) {
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      const auto& c = polygons[p].corner;
      for (std::size_t k = 0; k < c.size(); ++k) {
        const Vec3 &a = c[k], &b = c[(k + 1) % c.size()];
        edges_.push_back({static_cast<Index>(p), static_cast<Index>(k), a, b, norm(b - a)});
      }
    }
  }

  void take_given_planes(const std::vector<GivenFace>& given) {
    std::vector<Box> boxes, faces;
    std::vector<Index> plane, everywhere;
    for (const Edge& e : edges_) boxes.push_back(box_of(e));
    for (const GivenFace& face : given) {
      if (face.box.low[0] == -Box::infinity) {
        everywhere.push_back(face.plane);
      } else {
        faces.push_back(face.box);
        plane.push_back(face.plane);
      }
    }
    for (const FlatPolygon& polygon : polygons_) {
      faces.emplace_back();
      for (const Vec3& x : polygon.corner) faces.back().add(x);
      plane.push_back(polygon.plane);
    }
    const auto near = near_boxes(boxes, faces, planes_.identity_tolerance());
    parallel_for(static_cast<std::int64_t>(edges_.size()), 64, [&](std::int64_t i) {
      for (const Index p : everywhere) offer(edges_[i], p);
      for (const Index p : near[i]) offer(edges_[i], plane[p]);
    });
  }

  // Long edges first, since they define a plane best.
  void take_edge_planes() {
    std::vector<Index> open;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (edges_[i].plane == none) open.push_back(static_cast<Index>(i));
    std::sort(open.begin(), open.end(), [this](Index i, Index j) { return before(i, j); });

    std::vector<Box> boxes;
    for (const Index i : open) boxes.push_back(box_of(edges_[i]));
    const auto longer = earlier_near_boxes(boxes, 2 * planes_.identity_tolerance());
    // Few of them will take another one's plane.
    std::vector<NewPlane> own(open.size());
    parallel_for(static_cast<std::int64_t>(open.size()), 64, [&](std::int64_t r) {
      const Edge& e = edges_[open[r]];
      own[r] = plane_of_edge(planes_, e.a, e.b, polygons_[e.polygon].plane);
    });
    for (std::size_t r = 0; r < open.size(); ++r) {
      Edge& e = edges_[open[r]];
      for (const Index other : longer[r]) {
        offer(e, edges_[open[other]].plane);
        if (e.plane != none) break;
      }
      if (e.plane != none) continue;
      e.plane = plane_of(planes_.find_or_add(std::move(own[r])));
      e.exactly = true;
    }
  }

  EdgePlanes result() const {
    EdgePlanes result;
    result.edges.resize(polygons_.size());
    for (const Edge& e : edges_) {
      result.identified += e.exactly ? 0 : 1;
      const HalfSpaceId h = side_of_corners(planes_, e.plane, polygons_[e.polygon].corner);
      result.edges[e.polygon].push_back(h != none ? h : half_space(e.plane, true));
    }
    // Nothing is on both sides of an edge: a polygon so narrow that its corners lie on one line cuts nothing.
    for (std::size_t p = 0; p < polygons_.size(); ++p)
      if (width_in_plane(polygons_[p].corner, planes_.normal(polygons_[p].plane)) <=
          planes_.identity_tolerance())
        result.edges[p] = {result.edges[p].front(), result.edges[p].front() ^ 1};
    return result;
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

  bool lies_exactly_on(const Edge& e, Index plane) const {
    return planes_.exact_side(e.a, plane) == 0 && planes_.exact_side(e.b, plane) == 0;
  }

  void offer(Edge& e, Index plane) const {
    const Index own = polygons_[e.polygon].plane;
    if (plane == own || plane == e.plane) return;
    const Real tolerance = planes_.identity_tolerance();
    if (std::abs(distance(planes_, e.a, plane)) > tolerance ||
        std::abs(distance(planes_, e.b, plane)) > tolerance)
      return;
    const bool exactly = lies_exactly_on(e, plane);
    const Real sine = norm(cross(planes_.normal(plane), planes_.normal(own)));
    if (sine <= guard_sine && !(exactly && lies_exactly_on(e, own))) return;
    // The steeper plane crosses the polygon's better; of equally steep ones the first.
    if (e.plane != none && (sine < e.sine - 1e-9 || (sine <= e.sine + 1e-9 && plane > e.plane)))
      return;
    e.plane = plane;
    e.sine = sine;
    e.exactly = exactly;
  }

  PlaneTable& planes_;
  const std::vector<FlatPolygon>& polygons_;
  std::vector<Edge> edges_;
};

}  // namespace

Index plane_across(PlaneTable& planes, const Vec3& a, const Vec3& b, Index perpendicular_to) {
  return plane_of(planes.find_or_add(plane_of_edge(planes, a, b, perpendicular_to)));
}

HalfSpaceId side_of_corners(const PlaneTable& planes, Index edge_plane,
                            const std::vector<Vec3>& corners) {
  const Vec3& far = farthest_from(planes, edge_plane, corners);
  const Real d = distance(planes, far, edge_plane);
  if (std::abs(d) > planes.identity_tolerance()) return half_space(edge_plane, d > 0);
  for (const Vec3& x : corners)
    if (const int side = planes.exact_side(x, edge_plane); side != 0)
      return half_space(edge_plane, side > 0);
  return none;
}

EdgePlanes edge_planes(PlaneTable& planes, const std::vector<FlatPolygon>& polygons,
                       const std::vector<GivenFace>& given) {
  EdgeFinder edges(planes, polygons);
  edges.take_given_planes(given);
  edges.take_edge_planes();
  return edges.result();
}

}  // namespace rockfold
