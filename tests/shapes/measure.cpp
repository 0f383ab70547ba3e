#include "tests/shapes/measure.hpp"

#include <utility>

#include "host/cut/cells/convex_cell.hpp"

namespace rockfold::test {

namespace {

PlaneTable table_about(const std::vector<Vec3>& corners) {
  Vec3 min = corners.front(), max = min;
  for (const Vec3& p : corners)
    for (int d = 0; d < 3; ++d) {
      min[d] = std::min(min[d], p[d]);
      max[d] = std::max(max[d], p[d]);
    }
  return {0.5 * (min + max), norm(max - min)};
}

std::vector<HalfSpaceId> half_spaces(const ConvexPart& part, PlaneTable& planes) {
  std::vector<HalfSpaceId> inside;
  for (const FacePlane& f : part.faces) {
    const HalfSpaceId up = planes.find_or_add(f.plane);
    inside.push_back(f.inside_above ? up : up ^ 1);
  }
  return inside;
}

Vec3 area_vector(const std::vector<Vec3>& polygon) {
  Vec3 area{};
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    area += 0.5 * cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  return area;
}

void add_faces(const ConvexCell& cell, const std::vector<HalfSpaceId>& inside,
               const ConvexPart& part, Measured& measured) {
  for (const auto& f : cell.faces) {
    std::vector<Vec3> polygon;
    for (std::int32_t k = 0; k < f.count; ++k)
      polygon.push_back(cell.vertices[cell.corners[f.begin + k].vertex].x);
    const auto found = std::find(inside.begin(), inside.end(), f.inside);
    ASSERT_NE(found, inside.end()) << "the part is not bounded";
    const Index face = part.faces[found - inside.begin()].face;
    measured.area[face] += norm(area_vector(polygon));
    if (face != none) measured.boundary += area_vector(polygon);
  }
}

std::vector<std::vector<Vec3>> polygons_of(const ClosedSurface& surface) {
  std::vector<std::vector<Vec3>> polygons;
  for (std::size_t p = 0; p + 1 < surface.polygon_begin.size(); ++p) {
    auto& polygon = polygons.emplace_back();
    for (Index c = surface.polygon_begin[p]; c < surface.polygon_begin[p + 1]; ++c)
      polygon.push_back(surface.vertices[surface.corner[c]]);
  }
  return polygons;
}

}  // namespace

Measured measure_parts(const ShapeGeometry& geometry) {
  PlaneTable planes = table_about(geometry.corners);
  const Real reach = 2 * planes.model_size();
  std::vector<std::vector<HalfSpaceId>> inside;
  for (const ConvexPart& part : geometry.parts) inside.push_back(half_spaces(part, planes));
  Measured measured;
  for (std::size_t p = 0; p < inside.size(); ++p) {
    const ConvexCell cell = clip_cube(planes, reach, inside[p]);
    if (cell.faces.empty()) {
      ++measured.empty_parts;
      continue;
    }
    measured.volume += cell_moments(cell, planes).volume;
    add_faces(cell, inside[p], geometry.parts[p], measured);
    for (std::size_t q = 0; q < p; ++q) {
      auto both = inside[p];
      both.insert(both.end(), inside[q].begin(), inside[q].end());
      const ConvexCell common = clip_cube(planes, reach, both);
      if (!common.faces.empty()) measured.overlap += cell_moments(common, planes).volume;
    }
  }
  return measured;
}

Measured measure_surface(const ClosedSurface& surface) {
  Measured measured;
  const Vec3 o = surface.vertices.front();
  const auto polygons = polygons_of(surface);
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const Vec3 area = area_vector(polygons[p]);
    measured.area[surface.face[p]] += norm(area);
    measured.boundary += area;
    measured.volume += dot(polygons[p].front() - o, area) / 3;
  }
  return measured;
}

std::size_t open_edges(const ClosedSurface& surface) {
  std::map<std::pair<Index, Index>, int> uses;  // +1 ascending, −1 descending
  for (std::size_t p = 0; p + 1 < surface.polygon_begin.size(); ++p) {
    const Index begin = surface.polygon_begin[p], end = surface.polygon_begin[p + 1];
    for (Index c = begin; c < end; ++c) {
      const Index a = surface.corner[c], b = surface.corner[c + 1 < end ? c + 1 : begin];
      uses[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return static_cast<std::size_t>(
      std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 0; }));
}

bool polygons_are_convex(const ClosedSurface& surface, Real tolerance) {
  for (const auto& polygon : polygons_of(surface)) {
    const std::size_t n = polygon.size();
    const Vec3 normal = normalized(area_vector(polygon));
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 edge = polygon[(k + 1) % n] - polygon[k];
      const Vec3 next = polygon[(k + 2) % n] - polygon[(k + 1) % n];
      if (std::abs(dot(normal, edge)) > tolerance) return false;
      if (dot(normal, cross(edge, next)) < -tolerance * norm(edge)) return false;
    }
  }
  return true;
}

}  // namespace rockfold::test
