#include "host/cut/surfaces.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "host/cut/joint_planes_exact.hpp"
#include "host/exact/orientation.hpp"
#include "host/exact/plane_exact.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real unbounded_reach = 1e12;  // m: coordinates are limited to 1e9 when the model is read

struct FacePlane {
  ExactPlane plane;
  bool inside_above;
};

// A solid in the order of face_names(): the exact plane of each face and the side that holds the solid.
std::vector<FacePlane> face_planes(const BoxShape& box) {
  std::vector<FacePlane> faces;
  for (int d = 0; d < 3; ++d) {
    Vec3 n{};
    n[d] = 1;
    faces.push_back({plane_through(n, box.min), true});
    faces.push_back({plane_through(n, box.max), false});
  }
  return faces;
}

std::vector<FacePlane> face_planes(const HalfspacesShape& shape) {
  std::vector<FacePlane> faces;
  for (const HalfSpace& h : shape.planes)
    faces.push_back({plane_through(normal_of(h.plane.orientation), h.plane.point), h.keep_above});
  return faces;
}

bool above(const ExactPlane& plane, const ExactVec3& x) {
  return dot(plane.n, x) > plane.d;
}

std::vector<FacePlane> face_planes(const PrismShape& prism) {
  const std::size_t n = prism.base.size();
  const ExactVec3 e = exact(prism.extrude);
  const auto shifted = [](const ExactVec3& a, const ExactVec3& b) {
    return ExactVec3{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  };
  const auto difference = [](const ExactVec3& a, const ExactVec3& b) {
    return ExactVec3{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  // The corner that makes the largest triangle with corner 0 defines the base plane best.
  std::size_t widest = 1;
  Real largest = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Real area = norm(cross(prism.base[i] - prism.base[0], prism.base[i + 1] - prism.base[0]));
    if (area > largest) largest = area, widest = i;
  }
  ExactVec3 middle{0, 0, 0};
  for (const Vec3& p : prism.base) middle = shifted(middle, exact(p));
  for (int d = 0; d < 3; ++d) middle[d] = middle[d] / Exact(static_cast<int>(n)) + e[d] / 2;

  std::vector<FacePlane> faces;
  for (std::size_t i = 0; i < n; ++i) {
    const ExactVec3 a = exact(prism.base[i]), b = exact(prism.base[(i + 1) % n]);
    faces.push_back({plane_along(a, difference(b, a), e), false});
  }
  const ExactVec3 o = exact(prism.base[0]);
  const ExactVec3 u = difference(exact(prism.base[widest]), o);
  const ExactVec3 v = difference(exact(prism.base[widest + 1]), o);
  faces.push_back({plane_along(o, u, v), false});
  faces.push_back({plane_along(shifted(o, e), u, v), false});
  for (FacePlane& f : faces) f.inside_above = above(f.plane, middle);
  return faces;
}

std::string solid_key(const Model& model, std::size_t solid) {
  return fmt::format("solid[{}] \"{}\"", solid + 1, model.solids[solid].name);
}

// Corners of a '+' solid in the model's coordinates, to bound the model and to place joint sets.
std::vector<Vec3> corners_of(const Model& model, std::size_t s,
                             const std::vector<FacePlane>& faces) {
  const Shape& shape = model.solids[s].shape;
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    std::vector<Vec3> corners;
    for (int c = 0; c < 8; ++c)
      corners.push_back({(c & 1 ? box->max : box->min)[0], (c & 2 ? box->max : box->min)[1],
                         (c & 4 ? box->max : box->min)[2]});
    return corners;
  }
  if (const auto* prism = std::get_if<PrismShape>(&shape)) {
    std::vector<Vec3> corners = prism->base;
    for (const Vec3& p : prism->base) corners.push_back(p + prism->extrude);
    return corners;
  }
  const auto& planes = std::get<HalfspacesShape>(shape).planes;
  Vec3 centre{};
  for (const HalfSpace& h : planes)
    centre += (1.0 / static_cast<Real>(planes.size())) * h.plane.point;
  Real size = 0;
  for (const HalfSpace& h : planes) size = std::max(size, norm(h.plane.point - centre));
  PlaneTable table(centre, size > 0 ? size : 1);
  std::vector<HalfSpaceId> inside;
  for (const FacePlane& f : faces) inside.push_back(half_space(table.add(f.plane), f.inside_above));
  const ConvexCell cell = clip_cube(table, unbounded_reach, inside);
  if (cell.faces.empty())
    refuse(model.solids[s].place, solid_key(model, s),
           "the half-spaces have no point in common; found nothing to add");
  std::vector<Vec3> corners;
  for (const Vertex& v : cell.vertices) {
    if (norm(v.x) > unbounded_reach / 10)
      refuse(model.solids[s].place, solid_key(model, s),
             "the half-spaces enclose no bounded volume; a solid that is added needs planes on all "
             "sides");
    corners.push_back(v.x + centre);
  }
  return corners;
}

struct Corners {
  std::vector<Vec3> all;
  Vec3 min{}, max{};
};

Corners model_corners(const Model& model, const std::vector<std::vector<FacePlane>>& faces) {
  Corners corners;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    if (!model.solids[s].add) continue;
    const auto more = corners_of(model, s, faces[s]);
    corners.all.insert(corners.all.end(), more.begin(), more.end());
  }
  if (corners.all.empty())
    refuse({model.path, 0, 0, {}}, "solid", "no solid is added: there is no rock to cut");
  corners.min = corners.max = corners.all.front();
  for (const Vec3& p : corners.all)
    for (int d = 0; d < 3; ++d) {
      corners.min[d] = std::min(corners.min[d], p[d]);
      corners.max[d] = std::max(corners.max[d], p[d]);
    }
  return corners;
}

void add_origins(const Model& model, Complex& complex) {
  const auto add_joint = [&](const std::string& name, Index material) {
    FaceOrigin origin;
    origin.name = name;
    origin.joint_material = material;
    complex.origins.push_back(origin);
  };
  for (const JointSet& set : model.joint_sets) add_joint(set.name, set.material);
  for (const Joint& joint : model.joints) add_joint(joint.name, joint.material);
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    const Solid& solid = model.solids[s];
    complex.bodies.push_back({{}, static_cast<Index>(complex.origins.size())});
    const auto names = face_names(solid.shape);
    for (std::size_t f = 0; f < names.size(); ++f) {
      FaceOrigin origin;
      origin.kind = FaceOrigin::Kind::solid_face;
      origin.name = solid.name + "." + names[f];
      origin.solid = static_cast<Index>(s);
      origin.solid_face = static_cast<Index>(f);
      origin.continues = f < solid.continues.size() && solid.continues[f];
      complex.origins.push_back(origin);
    }
  }
}

HalfSpaceId find_or_add(PlaneTable& planes, const ExactPlane& plane) {
  const HalfSpaceId found = planes.find(plane);
  return found != none ? found : half_space(planes.add(plane), true);
}

void add_solids(const std::vector<std::vector<FacePlane>>& faces, CuttingInput& input) {
  Complex& complex = input.complex;
  for (std::size_t s = 0; s < faces.size(); ++s) {
    auto& inside = complex.bodies[s].inside;
    for (const FacePlane& f : faces[s]) {
      const HalfSpaceId up = find_or_add(complex.planes, f.plane);
      inside.push_back(f.inside_above ? up : up ^ 1);
    }
    for (const HalfSpaceId h : inside) {
      CuttingSurface surface{plane_of(h), {}};
      for (const HalfSpaceId edge : inside)
        if (plane_of(edge) != plane_of(h)) surface.edges.push_back(edge);
      input.solid_faces.push_back(std::move(surface));
    }
  }
}

// 0, n/2, n/4, 3n/4, …: parallel planes next to each other in the list halve what is left.
std::vector<Index> bisecting_order(Index n) {
  std::vector<Index> order;
  order.reserve(n);
  const auto bits = static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(n)));
  for (std::uint32_t i = 0; i < (1u << bits); ++i) {
    std::uint32_t reversed = 0;
    for (unsigned b = 0; b < bits; ++b) reversed |= (i >> b & 1u) << (bits - 1 - b);
    if (reversed < static_cast<std::uint32_t>(n)) order.push_back(static_cast<Index>(reversed));
  }
  return order;
}

void add_joints(const std::vector<JointPlane>& joints, CuttingInput& input) {
  Complex& complex = input.complex;
  std::vector<Index> planes;  // each once
  for (const JointPlane& joint : joints) {
    const HalfSpaceId found = complex.planes.find(joint.plane);
    if (found != none) ++input.planes_identified;
    const Index plane = found != none ? plane_of(found) : complex.planes.add(joint.plane);
    complex.joint_of_plane.resize(complex.planes.size(), none);
    Index& origin = complex.joint_of_plane[plane];
    if (origin == none) planes.push_back(plane);
    if (origin == none || joint.origin < origin) origin = joint.origin;
  }
  complex.joint_of_plane.resize(complex.planes.size(), none);
  for (const Index i : bisecting_order(static_cast<Index>(planes.size())))
    input.joints.push_back({planes[i], {}});
}

}  // namespace

CuttingInput make_surfaces(const Model& model) {
  std::vector<std::vector<FacePlane>> faces;
  for (const Solid& solid : model.solids)
    faces.push_back(std::visit([](const auto& shape) { return face_planes(shape); }, solid.shape));
  const Corners corners = model_corners(model, faces);
  const Vec3 centre = 0.5 * (corners.min + corners.max);

  CuttingInput input{Complex(PlaneTable(centre, norm(corners.max - corners.min))),
                     corners.min - centre,
                     corners.max - centre,
                     {},
                     {},
                     0};
  add_origins(model, input.complex);
  add_solids(faces, input);
  add_joints(joint_planes(model, corners.all, centre), input);
  return input;
}

}  // namespace rockfold
