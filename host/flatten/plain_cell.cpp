#include "host/flatten/plain_cell.hpp"

#include "src/base/vector.hpp"

namespace rockfold {

bool is_plain_cell(const Complex& complex, const std::vector<BoundaryArea>& areas,
                   std::vector<Index>& workspace) {
  const CellView cell = complex.cells[areas.front().cell];
  std::vector<Index>& origin = workspace;  // of each face
  origin.assign(cell.faces.size(), none);
  for (const BoundaryArea& a : areas) {
    if (a.cell != areas.front().cell || (origin[a.face] != none && origin[a.face] != a.origin))
      return false;
    origin[a.face] = a.origin;
  }
  for (std::size_t f = 0; f < origin.size(); ++f)
    if (origin[f] == none && origin_of_thin_face(complex, cell.faces[f]) == none) return false;
  return true;
}

Index origin_of_thin_face(const Complex& complex, const ConvexCell::Face& face) {
  const auto joints = complex.joints_by_plane.on(plane_of(face.inside));
  return joints.empty() ? none : complex.joints[joints.front()].origin;
}

// Seen from above its plane, the loop of a face below the cell begins at the last corner and runs backwards.
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

}  // namespace rockfold
