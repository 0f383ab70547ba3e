#include "host/flatten/plain_cell.hpp"

#include <algorithm>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// The area of face_polygon(), without making it: seen from above its plane, the loop of a face below the cell begins at
// the last corner and runs backwards.
Real area_from_above(const CellView& cell, const ConvexCell::Face& face) {
  const auto corner = [&](std::int32_t k) -> const Vec3& {
    const std::int32_t i = is_above(face.inside) ? face.count - 1 - k : k;
    return cell.vertices[cell.corners[face.begin + i].vertex].x;
  };
  const Vec3& o = corner(0);
  Real area = 0;
  for (std::int32_t k = 1; k + 1 < face.count; ++k)
    area += norm(cross(corner(k) - o, corner(k + 1) - o)) / 2;
  return area;
}

}  // namespace

bool is_plain_cell(const Complex& complex, const std::vector<BoundaryArea>& areas,
                   std::vector<Index>& origin) {
  const CellView cell = complex.cells[areas.front().cell];
  origin.assign(cell.faces.size(), none);
  for (const BoundaryArea& a : areas) {
    if (a.cell != areas.front().cell || (origin[a.face] != none && origin[a.face] != a.origin))
      return false;
    origin[a.face] = a.origin;
  }
  // A face thinner than rounding may have no area of its own.
  for (std::size_t f = 0; f < origin.size(); ++f) {
    if (origin[f] != none) continue;
    const auto joints = complex.joints_by_plane.on(plane_of(cell.faces[f].inside));
    if (joints.empty()) return false;
    origin[f] = complex.joints[joints.front()].origin;
  }
  return std::find(origin.begin(), origin.end(), none) == origin.end();
}

void write_cell_surface(const Complex& complex, const std::vector<BoundaryArea>& areas,
                        const std::vector<Index>& origin, BlockSurface& surface) {
  const CellView cell = complex.cells[areas.front().cell];
  surface.clear();
  for (std::size_t f = 0; f < cell.faces.size(); ++f) {
    const auto& face = cell.faces[f];
    surface.faces.push_back({face.inside, origin[f], area_from_above(cell, face)});
    for (const auto& corner : cell.corners.subspan(face.begin, face.count))
      surface.corner_vertex.push_back(corner.vertex);
    surface.corner_begin.push_back(static_cast<Index>(surface.corner_vertex.size()));
    surface.loop_begin.push_back(static_cast<Index>(f) + 1);
  }
  for (const Vertex& v : cell.vertices) surface.vertices.push_back(v.x);
  for (const BoundaryArea& a : areas) surface.face_of_area.push_back(a.face);
  surface.edge_count = static_cast<Index>(cell.corners.size() / 2);
  surface.shell_count = 1;
}

}  // namespace rockfold
