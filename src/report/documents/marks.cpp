#include "src/report/documents/marks.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

using Json = nlohmann::ordered_json;

/// More symbols of one condition would cover the rock.
constexpr std::size_t most_points = 60;

/// Points on faces, with the faces' outward normals (zero where a point is on no face).
struct MarkedPoints {
  std::vector<Vec3> point, normal;
  void add(const Vec3& p, const Vec3& n) {
    point.push_back(p);
    normal.push_back(n);
  }
};

/// The corners of a face's outer boundary.
std::vector<Vec3> corners(const BlockArrays& blocks, Index face) {
  const Index loop = blocks.loop_begin[face];
  std::vector<Vec3> list;
  for (Index c = blocks.corner_begin[loop]; c < blocks.corner_begin[loop + 1]; ++c)
    list.push_back(blocks.vertex[blocks.corner_vertex[c]]);
  return list;
}

Vec3 mean(const std::vector<Vec3>& points) {
  Vec3 sum{};
  for (const Vec3& p : points) sum += p;
  return (1.0 / static_cast<Real>(points.size())) * sum;
}

/// m²
Real area(const std::vector<Vec3>& polygon) {
  Vec3 sum{};
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    sum += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return 0.5 * norm(sum);
}

bool inside(const BoxRegion& box, const Vec3& p) {
  for (int d = 0; d < 3; ++d)
    if (p[d] < box.min[d] || p[d] > box.max[d]) return false;
  return true;
}

bool inside(const PlaneRegion& plane, const Vec3& p) {
  return std::abs(dot(plane.normal, p - plane.point)) <= plane.tolerance;
}

/// What of a polygon lies in a box (Sutherland & Hodgman 1974); nothing where the box only touches it.
std::vector<Vec3> part_in(const BoxRegion& box, std::vector<Vec3> polygon) {
  const Real slack = 1e-9 * norm(box.max - box.min);
  const Real whole = area(polygon);
  for (int side = 0; side < 6; ++side) {
    const int d = side / 2;
    const auto depth = [&](const Vec3& p) {
      return slack + (side % 2 ? box.max[d] - p[d] : p[d] - box.min[d]);
    };
    std::vector<Vec3> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const Real of_a = depth(a), of_b = depth(b);
      if (of_a >= 0) part.push_back(a);
      if ((of_a > 0 && of_b < 0) || (of_a < 0 && of_b > 0))
        part.push_back(a + of_a / (of_a - of_b) * (b - a));
    }
    polygon = std::move(part);
  }
  return area(polygon) > 1e-6 * whole ? polygon : std::vector<Vec3>{};
}

/// Middles of what `part` takes of the faces of the rock's boundary.
template <typename Part>
MarkedPoints on_faces(const BlockArrays& blocks, Part part) {
  MarkedPoints marked;
  for (std::size_t f = 0; f < blocks.face_origin.size(); ++f) {
    const auto face = static_cast<Index>(f);
    const FaceOrigin& origin = blocks.origins[blocks.face_origin[f]];
    if (origin.kind == FaceOrigin::Kind::joint) continue;
    const std::vector<Vec3> list = part(origin, corners(blocks, face));
    if (!list.empty()) marked.add(mean(list), blocks.face_normal[f]);
  }
  return marked;
}

struct RegionPoints {
  const BlockArrays& blocks;
  bool cuts = false;  ///< whether a box takes parts of faces, as it does for what acts on them

  MarkedPoints operator()(const FaceRegion& region) const {
    const auto kind =
        region.of_excavation ? FaceOrigin::Kind::excavation : FaceOrigin::Kind::solid_face;
    return on_faces(blocks, [&](const FaceOrigin& origin, std::vector<Vec3> face) {
      const bool holds = origin.kind == kind && origin.solid == region.solid &&
                         std::find(region.faces.begin(), region.faces.end(), origin.solid_face) !=
                             region.faces.end();
      return holds ? std::move(face) : std::vector<Vec3>{};
    });
  }
  MarkedPoints operator()(const BoxRegion& box) const {
    if (!cuts) return in_space(box);
    return on_faces(blocks, [&](const FaceOrigin&, std::vector<Vec3> face) {
      return part_in(box, std::move(face));
    });
  }
  MarkedPoints operator()(const PlaneRegion& plane) const { return in_space(plane); }
  MarkedPoints operator()(const PointRegion& region) const { return {{region.point}, {Vec3{}}}; }
  MarkedPoints operator()(const BlockRegion& region) const { return {{region.point}, {Vec3{}}}; }

 private:
  /// Faces that lie in the region as a whole; where there are none, corners.
  template <typename Space>
  MarkedPoints in_space(const Space& space) const {
    const auto holds = [&](const Vec3& p) { return inside(space, p); };
    MarkedPoints marked = on_faces(blocks, [&](const FaceOrigin&, std::vector<Vec3> face) {
      return std::all_of(face.begin(), face.end(), holds) ? std::move(face) : std::vector<Vec3>{};
    });
    if (marked.point.empty())
      for (const Vec3& p : blocks.vertex)
        if (holds(p)) marked.add(p, {});
    return marked;
  }
};

/// Evenly chosen from the list, as many as can be drawn.
Json chosen(const std::vector<Vec3>& all) {
  Json list = Json::array();
  const std::size_t stride = (all.size() + most_points - 1) / most_points;
  for (std::size_t i = 0; i < all.size(); i += stride) list.push_back(all[i]);
  return list;
}

Vec3 direction(const Vec3& v) {
  const Real length = norm(v);
  return length > 0 ? (1 / length) * v : Vec3{};
}

/// A force that changes in time points where it is largest.
Vec3 largest_of(const TimeTable& table, const Vec3& constant) {
  Vec3 largest = constant;
  if (!table.value.empty()) largest = {};
  for (const Vec3& v : table.value)
    if (norm(v) > norm(largest)) largest = v;
  return largest;
}

Json mark(const char* kind, std::string name, const std::vector<Vec3>& points,
          const std::vector<Vec3>& directions = {}) {
  return {{"kind", kind},
          {"name", std::move(name)},
          {"points", chosen(points)},
          {"directions", chosen(directions)}};
}

void add_fixed(const Model& model, const RegionPoints& points, Json& list) {
  for (std::size_t n = 0; n < model.fixed.size(); ++n) {
    std::string name = fmt::format("fixed {} (", n + 1);
    for (int d = 0; d < 3; ++d)
      if (model.fixed[n].components[d]) name += "xyz"[d];
    list.push_back(mark("fixed", name + ")", std::visit(points, model.fixed[n].where).point));
  }
}

void add_loads(const Model& model, const RegionPoints& points, Json& list) {
  for (std::size_t n = 0; n < model.tractions.size(); ++n) {
    const Traction& traction = model.tractions[n];
    const MarkedPoints at = std::visit(points, traction.where);
    const Vec3 value = largest_of(traction.table, traction.value);
    std::vector<Vec3> way;
    for (const Vec3& normal : at.normal)
      way.push_back(traction.pressure ? (value[0] < 0 ? 1.0 : -1.0) * normal : direction(value));
    list.push_back(mark("load", fmt::format("traction {}", n + 1), at.point, way));
  }
  for (std::size_t n = 0; n < model.point_loads.size(); ++n) {
    const PointLoad& load = model.point_loads[n];
    list.push_back(mark("load", fmt::format("point load {}", n + 1), {load.point},
                        {direction(largest_of(load.table, load.force))}));
  }
}

void add_water(const Model& model, Json& list) {
  const Vec3 up = direction(-model.gravity);
  for (const Water& water : model.waters) {
    if (const auto* table = std::get_if<WaterTable>(&water.level))
      list.push_back(mark("water", "water table", {table->point}, {table->normal}));
    if (const auto* head = std::get_if<WaterHead>(&water.level))
      list.push_back(mark("water", "water level", {head->elevation * up}, {up}));
  }
}

}  // namespace

Json marks_json(const Model& model, const BlockArrays& blocks) {
  const RegionPoints points{blocks}, loaded{blocks, true};
  Json list = Json::array();
  add_fixed(model, points, list);
  add_loads(model, loaded, list);
  for (const QuietBoundary& quiet : model.quiet_boundaries)
    list.push_back(mark("quiet", "quiet boundary", std::visit(loaded, quiet.where).point));
  for (const Monitor& monitor : model.monitors)
    list.push_back(mark("monitor", monitor.name, {monitor.point}));
  add_water(model, list);
  return list;
}

}  // namespace rockfold
