#include "host/cover/points/free_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/cover/points/surface_split.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real relative_slack =
    1e-9;  // of the model's size: corners that close to a box's side lie on it

/// What of a convex polygon lies where sign · x[axis] ≤ limit.
std::vector<Vec3> clip(const std::vector<Vec3>& corner, int axis, Real sign, Real limit,
                       Real slack) {
  std::vector<Vec3> inside;
  for (std::size_t i = 0; i < corner.size(); ++i) {
    const Vec3 &a = corner[i], &b = corner[(i + 1) % corner.size()];
    const Real da = sign * a[axis] - limit, db = sign * b[axis] - limit;
    if (da <= slack) inside.push_back(a);
    if ((da > slack && db < -slack) || (da < -slack && db > slack))
      inside.push_back(a + da / (da - db) * (b - a));
  }
  return inside;
}

class Visitor {
 public:
  Visitor(const Cutting& cutting, const Covering& covering, const FacesOf& faces,
          const Region& region, const std::function<void(const FacePolygon&)>& visit)
      : complex_(*cutting.complex),
        covering_(covering),
        faces_(faces),
        region_(region),
        visit_(visit),
        surface_(complex_, covering),
        slack_(relative_slack * covering.pieces->planes.model_size()) {}

  void run() {
    for (const FreePart& part : complex_.free_parts)
      if (wanted(part.origin)) split(complex_.polygon_of(part), part.cell, part.face);
    for (const Fragment& fragment : complex_.fragments)
      for (int side = 0; side < 2; ++side)
        if (!complex_.is_analysed(fragment.cell[1 - side]) && wanted(fragment.joint))
          split(complex_.polygon_of(fragment), fragment.cell[side], fragment.face[side]);
  }

 private:
  bool wanted(Index origin) const {
    return !faces_ || (origin != none && faces_(complex_.origins[origin]));
  }

  /// Splits a face of a cell of the complex over the elements.
  void split(const Polygon& polygon, Index rock, Index local_face) {
    if (!complex_.is_analysed(rock) || is_off_plane(polygon)) return;
    const HalfSpaceId inside = complex_.cells[rock].faces[local_face].inside;
    FacePolygon found;
    found.rock = rock;
    found.plane = polygon.plane;
    found.normal = outward(polygon, inside);
    found.share = cell_split(covering_.arrays.lattice.kind).share;
    surface_.split(polygon, rock, local_face, [&](const Holder& holder, const Polygon& within) {
      found.element = holder.element;
      take_corners(within, found);
    });
  }

  // All of the face counts, not the strip that a lattice plane cuts from it next to the region's plane.
  bool is_off_plane(const Polygon& polygon) const {
    const auto* plane = std::get_if<PlaneRegion>(&region_);
    return plane != nullptr &&
           std::any_of(polygon.corner.begin(), polygon.corner.end(), [&](const Vertex& v) {
             return std::abs(dot(plane->normal, v.x + complex_.planes.centre() - plane->point)) >
                    std::max(plane->tolerance, slack_);
           });
  }

  void take_corners(const Polygon& within, FacePolygon& found) const {
    found.corner.clear();
    for (const Vertex& v : within.corner) found.corner.push_back(v.x + complex_.planes.centre());
    Real least = 0;  // m²: what a box only touches it does not hold
    if (const auto* box = std::get_if<BoxRegion>(&region_)) {
      least = std::min(slack_ * slack_, 1e-6 * polygon_area(found.corner));
      for (int d = 0; d < 3; ++d) {
        found.corner = clip(found.corner, d, 1, box->max[d], slack_);
        found.corner = clip(found.corner, d, -1, -box->min[d], slack_);
      }
    }
    if (found.corner.size() >= 3 && polygon_area(found.corner) > least) visit_(found);
  }

  /// Polygons run counter-clockwise seen from above their plane.
  static Vec3 outward(const Polygon& polygon, HalfSpaceId inside) {
    Vec3 area{};
    const Vec3& o = polygon.corner[0].x;
    for (std::size_t k = 1; k + 1 < polygon.corner.size(); ++k)
      area += cross(polygon.corner[k].x - o, polygon.corner[k + 1].x - o);
    return (is_above(inside) ? -1 : 1) * normalized(area);
  }

  const Complex& complex_;
  const Covering& covering_;
  const FacesOf& faces_;  // empty: all
  const Region& region_;  // a plane or a box that they lie in; else all of them counts
  const std::function<void(const FacePolygon&)>& visit_;
  SurfaceSplitter surface_;
  const Real slack_;
};

}  // namespace

Real polygon_area(const std::vector<Vec3>& corner) {
  Vec3 area{};
  for (std::size_t k = 1; k + 1 < corner.size(); ++k)
    area += cross(corner[k] - corner[0], corner[k + 1] - corner[0]);
  return 0.5 * norm(area);
}

void visit_free_faces(const Cutting& cutting, const Covering& covering, const Region& region,
                      const std::function<void(const FacePolygon&)>& visit) {
  if (std::holds_alternative<PointRegion>(region) || std::holds_alternative<BlockRegion>(region))
    return;
  FacesOf faces;
  if (const auto* of_shape = std::get_if<FaceRegion>(&region))
    faces = [of_shape](const FaceOrigin& origin) { return of_shape->holds(origin); };
  Visitor(cutting, covering, faces, region, visit).run();
}

void visit_free_faces(const Cutting& cutting, const Covering& covering, const FacesOf& wanted,
                      const std::function<void(const FacePolygon&)>& visit) {
  const Region everywhere = FaceRegion{};
  Visitor(cutting, covering, wanted, everywhere, visit).run();
}

}  // namespace rockfold
