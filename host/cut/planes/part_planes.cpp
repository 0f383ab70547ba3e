#include <algorithm>
#include <tuple>

#include "host/cut/cells/convex_cell.hpp"
#include "host/cut/cells/patch.hpp"
#include "host/cut/cells/polygon.hpp"
#include "host/cut/planes/part_planes_exact.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

struct PartFace {
  std::size_t part, face;
  Real size = 0;  // m, diagonal of its box; 0 for a plane that bounds nothing
  Vec3 normal;
  Real offset;
};

// Faces of one part, cut by its own planes alone.
void add_faces(const ConvexPart& part, std::size_t number, const Vec3& reach,
               const PlaneTable& planes, std::vector<PartFace>& faces) {
  PlaneTable own(planes.centre(), planes.model_size());
  const ConvexCell box = make_box(own, -reach, reach);
  std::vector<HalfSpaceId> inside;
  for (const FacePlane& f : part.faces) {
    const HalfSpaceId up = own.identify_or_add(f.plane);
    inside.push_back(f.inside_above ? up : up ^ 1);
  }
  const ConvexCell cell = clip(own, box, inside);
  for (std::size_t f = 0; f < inside.size(); ++f) {
    const Index plane = plane_of(inside[f]);
    faces.push_back({number, f, 0, own.normal(plane), own.offset(plane)});
    for (const auto& face : cell.faces) {
      if (face.inside != inside[f]) continue;
      Box extent;
      for (const Vertex& v : face_polygon(cell, face).corner) extent.add(v.x);
      faces.back().size = norm(extent.high - extent.low);
    }
  }
}

}  // namespace

std::vector<std::vector<HalfSpaceId>> part_half_spaces(const std::vector<const ConvexPart*>& parts,
                                                       const Vec3& reach, PlaneTable& planes) {
  std::vector<PartFace> faces;
  std::vector<std::vector<HalfSpaceId>> half_spaces;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    add_faces(*parts[p], p, reach, planes, faces);
    half_spaces.emplace_back(parts[p]->faces.size());
  }
  std::stable_sort(faces.begin(), faces.end(), [](const PartFace& a, const PartFace& b) {
    return std::tie(b.size, a.normal, a.offset) < std::tie(a.size, b.normal, b.offset);
  });
  for (const PartFace& f : faces) {
    const FacePlane& given = parts[f.part]->faces[f.face];
    const HalfSpaceId up = planes.identify_or_add(given.plane);
    half_spaces[f.part][f.face] = given.inside_above ? up : up ^ 1;
  }
  return half_spaces;
}

}  // namespace rockfold
